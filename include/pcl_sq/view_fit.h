// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/tangent_plane.h"

#include <optional>
#include <string>
#include <vector>

namespace pcl_sq {

/** \brief What is known of a body besides points on its visible side. */
struct PCL_SQ_EXPORTS ViewEvidence {
  std::vector<TangentPlane> silhouette; ///< tangent planes with a common dilation
  double dilation_sigma = 0.0; ///< its standard deviation [m], 0: the planes are exact
  std::vector<TangentPlane> tangents; ///< further planes it touches, such as the table
  std::vector<TangentPlane> limits;   ///< half-spaces that hold it
  std::optional<Eigen::Vector3d> viewpoint; ///< the camera's place [m]
  std::optional<Eigen::Vector3d> up;        ///< normal of the table, unit length
};

/** \brief Families of superquadrics, from many parameters to few. */
enum class ShapeClass {
  GENERIC,    ///< all of the paper's eleven parameters
  ROTATIONAL, ///< solid of revolution about z: a1 = a2, e2 = 1
  BOX,        ///< e1 = e2 = 0.2
  ELLIPSOID,  ///< e1 = e2 = 1
  TAPERED,    ///< one of the above whose section grows along z
  BENT,       ///< a rod bent to an arc of a circle, e2 = 1: banana, handle
  VESSEL      ///< a tapered solid of revolution with a rim and a wall: bowl, cup, plate
};

/** \brief The value's name, as it stands in the JSON. */
PCL_SQ_EXPORTS const char* toString(ShapeClass shape);

/** \brief One family's best fit. */
struct ShapeCandidate {
  ShapeClass shape = ShapeClass::GENERIC;
  bool upright = false; ///< an axis is held parallel to the table's normal
  bool on_axis = false; ///< the axis of revolution is another part's
  /** \brief cost / c + parameters * ln(observations); c is 1 unless the best family's
   * cost exceeds the observations, and that ratio where it does. */
  double bic = 0.0;
  double cost = 0.0;   ///< cost / sigma^2, points and planes
  int parameters = 11; ///< free ones
  Superquadric model;
  ShapeClass before = ShapeClass::GENERIC; ///< a TAPERED one's family before tapering
};

/** \brief Settings of fitView(). */
struct PCL_SQ_EXPORTS ViewFitOptions {
  double noise = 0.0; ///< standard deviation of the points [m]; 0: estimated
  /** \brief Variance of the noise over that of each point; empty: all one. */
  std::vector<float> precision;
  /** \brief Points that carry as much information as all of them, for neighbours in a
   * disparity image share their errors; 0: as many as there are. */
  double effective_points = 0.0;
  double max_semi_axis = 0.0; ///< [m]; 0: from the points' extent
  double min_epsilon = 0.05, max_epsilon = 2.0;
  bool choose_shape = true; ///< compare the families; otherwise GENERIC
  /** \brief Starts of the search, the more the surer, [1, 24]; 0: all. */
  int starts = 0;
  std::optional<Superquadric> start; ///< no search but this start
  /** \brief An axis of revolution of another part that this part may share. */
  std::optional<Superquadric> coaxial;
  /** \brief Whether the chosen family's fit ends with all points instead of a sample:
   * its cost can then be compared with that of other parts of the same points. */
  bool all_points = false;
  /** \brief Whether TAPERED is among the families. */
  bool taper = true;
  /** \brief Whether BENT is among the families. */
  bool bend = true;
  /** \brief Whether VESSEL is among the families. */
  bool vessel = true;
  bool robust = true;       ///< some points may be outliers
  unsigned int threads = 1; ///< 0: one per core; the result is the same for any number

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief Result of fitView(). */
struct ViewFit {
  FitSummary fit; ///< of the chosen family
  ShapeCandidate chosen;
  double margin = 0.0; ///< BIC of the best other family minus that of the chosen one
  std::vector<ShapeCandidate> candidates; ///< all families tried
  double noise = 0.0;                     ///< sigma used for the comparison [m]

  /** \brief The best candidate with neither taper, bend nor rim: where another search
   * goes on from. */
  const ShapeCandidate& straight() const;
};

/** \brief Fits one superquadric to points and to what its silhouette and its support
 * say of the side that the points do not show.
 *
 * Several starts, least squares on the radial distance, refined with the distance to
 * the foot point; then the families are fitted from there and the one with the smallest
 * Bayesian information criterion is taken.
 * \param[in] points 3 x N in the cloud's frame [m]; non-finite columns are left out */
PCL_SQ_EXPORTS ViewFit fitView(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                               const ViewEvidence& evidence,
                               const ViewFitOptions& options = {});

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/fit_options.h"
#include "pcl_sq/superquadric.h"

namespace pcl_sq {

/** \brief Why a fit ended. */
enum class Termination {
  NOT_RUN,               ///< no fit was made
  COST_CHANGE_TOO_SMALL, ///< (old cost - new cost) < tolerance * old cost
  STEP_TOO_SMALL,        ///< no parameter moved by more than its tolerance
  GRADIENT_TOO_SMALL,    ///< the free parameters' gradient vanished
  MAX_ITERATIONS,        ///< the iteration limit was reached
  DAMPING_TOO_LARGE,     ///< no step lowered the cost any more
  GIVEN_UP,              ///< another fit of the same points was far better already
  TOO_FEW_POINTS,        ///< fewer finite points than the model needs
  DEGENERATE,            ///< the points span no volume (one point, a line)
  INVALID_OPTIONS        ///< an option is outside its range
};

/** \brief The value's name, as it stands in the JSON. */
PCL_SQ_EXPORTS const char* toString(Termination termination);

/** \brief Result of a fit.
 *
 * The full fit takes \a distortion and \a rms_distance of clouds of more than 65,536
 * points from a representative 16,384 of them, as it does its other figures. */
struct PCL_SQ_EXPORTS FitSummary {
  Superquadric model;
  Termination termination = Termination::NOT_RUN;
  std::size_t points = 0;    ///< finite points used
  int iterations = 0;        ///< of Levenberg-Marquardt, all starts together
  double distortion = 0.0;   ///< D, Eq. (7), semi-axes in metres
  double rms_distance = 0.0; ///< of the foot-point distance [m]
  /** \brief Estimated noise of the points on the surface [m]; full fit only. */
  double sigma = 0.0;
  /** \brief Estimated share of points that belong elsewhere; full fit only. */
  double outlier_share = 0.0;
  /** \brief Covariance of the parameters, in the order and units of
   * Superquadric::logGaugeJacobian(): t along the own axes [m], w [rad], ln a, e1, e2;
   * zero in fixed directions and at bounds. Empty (zero) after the paper's fit. */
  Eigen::Matrix<double, 11, 11, Eigen::DontAlign> covariance =
      Eigen::Matrix<double, 11, 11, Eigen::DontAlign>::Zero();

  /** \brief Whether \a model is usable. */
  [[nodiscard]] bool ok() const;
};

/** \brief Principal axes of the points as a right-handed rotation (III-B; E11).
 *
 * The columns are ordered and signed so that they lie as close as possible to the axes
 * of the cloud's frame: the first to x, the second to y, the third to z (the depth). */
PCL_SQ_EXPORTS Eigen::Matrix3d
principalAxes(const Eigen::Ref<const Eigen::Matrix3Xd>& points);
PCL_SQ_EXPORTS Eigen::Matrix3d principalAxes(const CloudPoints& points);

/** \brief The paper's start for one region (III-B): centre and rotation as given, a1
 * and a2 from the points' extents around the centre, a3 half the region's depth,
 * exponents one. */
PCL_SQ_EXPORTS Superquadric
initialSuperquadric(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                    const Eigen::Vector3d& center,
                    const Eigen::Matrix3d& rotation,
                    double depth,
                    const PaperFitOptions& options = {});

/** \brief The paper's fit (III-B, Eqs. 4-7): epsilon1, epsilon2 and a3 by
 * Levenberg-Marquardt; the pose, a1 and a2 of \a initial are kept.
 * \param[in] points 3 x N in the cloud's frame [m]; non-finite columns are left out */
PCL_SQ_EXPORTS FitSummary
fitSuperquadricPaper(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                     const Superquadric& initial,
                     const PaperFitOptions& options = {});

/** \brief The full fit: all eleven parameters from bare points, whatever their unit,
 * place, orientation and order.
 *
 * Several starts by least squares on the radial distance (Gross & Boult 1988), the best
 * refined, its axes and exponents exchanged where that fits better (Liu et al. 2022),
 * then the distance to the foot point over all points, weighted by a mixture of a
 * Gaussian and a uniform distribution whose width and share are estimated.
 * \param[in] points 3 x N in the cloud's frame [m]; non-finite columns are left out */
PCL_SQ_EXPORTS FitSummary fitSuperquadric(
    const Eigen::Ref<const Eigen::Matrix3Xd>& points, const FitOptions& options = {});

/** \brief The full fit of a cloud's points where they are: nothing of their number is
 * copied of clouds of more than 65,536. */
PCL_SQ_EXPORTS FitSummary fitSuperquadric(const CloudPoints& points,
                                          const FitOptions& options = {});

/** \brief The full fit from a start, without a search for others.
 *
 * A start a million times farther away than the points are wide is refused
 * (Termination::INVALID_OPTIONS). */
PCL_SQ_EXPORTS FitSummary
fitSuperquadric(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                const Superquadric& initial,
                const FitOptions& options = {});

/** \brief The full fit of a cloud's points where they are, from a start. */
PCL_SQ_EXPORTS FitSummary fitSuperquadric(const CloudPoints& points,
                                          const Superquadric& initial,
                                          const FitOptions& options = {});

/** \brief Superquadric::footPointDistance() of many points at once, to seven digits of
 * the superquadric's size [m]; infinite where a coordinate is not finite. */
PCL_SQ_EXPORTS Eigen::VectorXd
surfaceDistances(const Superquadric& superquadric,
                 const Eigen::Ref<const Eigen::Matrix3Xd>& points);
PCL_SQ_EXPORTS Eigen::VectorXd surfaceDistances(const Superquadric& superquadric,
                                                const CloudPoints& points);

/** \brief Whether the finite points lie neither in one place nor on a line or plane. */
PCL_SQ_EXPORTS bool spansVolume(const Eigen::Ref<const Eigen::Matrix3Xd>& points);
PCL_SQ_EXPORTS bool spansVolume(const CloudPoints& points);

} // namespace pcl_sq

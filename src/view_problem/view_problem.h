// SPDX-License-Identifier: BSD-3-Clause
// Private. Points and planes in the frame the solver works in, and the fits over them.
#pragma once

#include "pcl_sq/view_fit.h"
#include "view_problem/plane_cost.h"

namespace pcl_sq::detail {

/** \brief A superquadric on its way through the stages. */
struct Trial {
  Superquadric model;
  double sigma = 0.1;  ///< of the points
  double cost = 1e300; ///< of points and planes over sigma^2
  int iterations = 0;
  Termination termination = Termination::NOT_RUN;
};

/** \brief Everything in unit lengths. */
class ViewProblem {
public:
  /** \brief \return false for too few or degenerate points */
  bool prepare(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
               const ViewEvidence& evidence,
               const ViewFitOptions& options);

  /** \brief Least squares from a start on the first \a count points with every
   * \a stride-th silhouette plane. The points' sigma is that of the start.
   * \param[in] hopeless its cost is as that of a Trial */
  Trial minimise(const Trial& start,
                 const UnitPoints& points,
                 kernels::Residual residual,
                 int iterations,
                 const ParameterSpace& space = {},
                 bool few_planes = false,
                 const Hopeless& hopeless = {}) const;
  /** \brief The points' sigma at a trial; the given noise where it is known. */
  double sigmaOf(const Trial& trial, const UnitPoints& points) const;

  /** \brief Bounds and mixture of a fit whose points have the given sigma. */
  LmOptions limits(double sigma) const;
  /** \brief The planes' cost beside that of \a points of the given sigma.
   * \param[in] few whether some of the outline's will do */
  PlaneCost planes(double sigma, const UnitPoints& points, bool few = false) const;

  /** \brief What a residual of one sigma costs, see PlaneCost::unit. */
  double unitOf(double sigma, const UnitPoints& points) const;

  const Normalisation& frame() const { return frame_; }
  const UnitPoints& all() const { return all_; }
  const UnitPoints& medium() const { return medium_; }
  const UnitPoints& coarse() const { return coarse_; }
  bool hasUp() const { return has_up_; }
  bool hasView() const { return has_view_; }
  const Eigen::Vector3d& up() const { return up_; }
  const Eigen::Vector3d& view() const { return view_; }
  const std::optional<Eigen::Vector3d>& eye() const { return eye_; }
  const std::vector<TangentPlane>& tangents() const { return cost_.tangents; }
  double noise() const { return noise_; }
  double observations() const;
  const ViewFitOptions& options() const { return options_; }

private:
  ViewFitOptions options_;
  Normalisation frame_;
  UnitPoints all_, medium_, coarse_;
  PlaneCost cost_, few_;
  Eigen::Vector3d up_ = Eigen::Vector3d::UnitZ();   ///< unit length
  Eigen::Vector3d view_ = Eigen::Vector3d::UnitZ(); ///< away from the camera
  std::optional<Eigen::Vector3d> eye_;              ///< the camera's place
  bool has_up_ = false, has_view_ = false;
  double noise_ = 0.0;
  double max_axis_ = 20.0;
};

/** \brief Starts of the search. */
std::vector<Superquadric> viewStarts(const ViewProblem& problem);

} // namespace pcl_sq::detail

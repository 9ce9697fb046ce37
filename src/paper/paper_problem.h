// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/normalisation.h"
#include "pcl_sq/fit_options.h"
#include "pcl_sq/superquadric.h"

namespace pcl_sq::detail {

/** \brief Least-squares problem of the paper's fit over x = (e1, e2, ln a_free);
 * lengths are in units of the start's frame. */
class PaperProblem {
public:
  /** \brief Cost and normal equations at one x. */
  struct Normal {
    double cost = 0.0;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero(); ///< J^T r
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();  ///< J^T J
  };

  /** \param[in] points in the frame in which \a start is given
   * \param[in] start pose and known semi-axes
   * \param[in] free_axis semi-axis that is estimated */
  PaperProblem(const UnitPoints& points,
               const Superquadric& start,
               int free_axis,
               const PaperFitOptions& options);

  Eigen::Vector3d parametersOf(const Superquadric& s) const;
  Superquadric superquadricAt(const Eigen::Vector3d& x) const;
  Eigen::Vector3d clamp(const Eigen::Vector3d& x) const;
  /** \brief Whether descent would leave the bound at which parameter k stands. */
  bool pushesOutwards(const Eigen::Vector3d& x,
                      const Eigen::Vector3d& gradient,
                      int k) const;
  Normal linearise(const Eigen::Vector3d& x) const;

private:
  const UnitPoints& points_;
  Superquadric start_;
  int free_axis_;
  bool keep_front_;
  Cost cost_;
  Eigen::Vector3d lower_, upper_;
};

} // namespace pcl_sq::detail

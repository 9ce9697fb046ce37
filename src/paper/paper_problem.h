// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/normalisation.h"
#include "pcl_sq/fit_options.h"
#include "pcl_sq/superquadric.h"

namespace pcl_sq::detail {

/** \brief Least-squares problem of the paper's fit over x = (e1, e2, ln a_free), as
 * minimiseSquares() wants it; lengths are in units of the start's frame. */
class PaperProblem {
public:
  static constexpr int N = 3;
  using Model = Eigen::Vector3d; ///< x
  /** \brief Cost and normal equations at one x. */
  struct Equations {
    double cost = 0.0, points_cost = 0.0;
    Eigen::Vector3d jtr = Eigen::Vector3d::Zero(); ///< J^T r
    Eigen::Matrix3d jtj = Eigen::Matrix3d::Zero(); ///< J^T J
  };

  /** \param[in] points in the frame in which \a start is given
   * \param[in] start pose and known semi-axes
   * \param[in] free_axis semi-axis that is estimated */
  PaperProblem(const UnitPoints& points,
               const Superquadric& start,
               int free_axis,
               const PaperFitOptions& options);

  Model parametersOf(const Superquadric& s) const;
  Superquadric superquadricAt(const Model& x) const;
  Model clamp(const Model& x) const;
  Equations evaluate(const Model& x) const;
  Model moved(const Model& x, const Eigen::Vector3d& step, bool& limited) const;
  bool isActiveBound(const Model& x, const Eigen::Vector3d& direction) const;
  double rounding() const { return 0.0; } // see LmLimits::cost_rounding

private:
  const UnitPoints& points_;
  Superquadric start_;
  int free_axis_;
  bool keep_front_;
  Cost cost_;
  Eigen::Vector3d lower_, upper_;
};

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// Private. The sums of a PlaneCost for a superquadric, by the kernels.
#pragma once

#include "view_fit/plane_cost.h"

namespace pcl_sq::detail {

/** \brief A PlaneCost as the kernels want it: what addPlaneCost() says, all planes
 * at once and in single precision. A contributor of levenbergMarquardt(). */
class PlaneSums {
public:
  explicit PlaneSums(const PlaneCost& cost);

  /** \brief Adds cost and derivatives. */
  void operator()(const Superquadric& body, NormalEquations& equations) const;

private:
  enum Array { X, Y, Z, OFFSET, WEIGHT, LEAST, SHARED, ARRAYS };

  void add(const TangentPlane& plane, double unit, float least, double shared);
  kernels::Planes view() const;

  std::size_t count_ = 0;
  std::vector<float> arrays_[ARRAYS]; ///< padded with zeros
  double precision_ = 0.0;            ///< of the common dilation; 0: there is none
  Eigen::Vector3d view_;
  double half_width_, unit_;
};

} // namespace pcl_sq::detail

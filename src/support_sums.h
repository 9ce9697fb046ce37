// SPDX-License-Identifier: BSD-3-Clause
// Private. The sums of a SupportCost for a superquadric, by the kernels.
#pragma once

#include "support_cost.h"

namespace pcl_sq::detail {

/** \brief A SupportCost as the kernels want it: what addSupportCost() says, all planes
 * at once and in single precision. A contributor of levenbergMarquardt(). */
class SupportSums {
public:
  explicit SupportSums(const SupportCost& cost);

  /** \brief Adds cost and derivatives. */
  void operator()(const Superquadric& body, NormalEquations& equations) const;

private:
  enum Array { X, Y, Z, OFFSET, WEIGHT, LEAST, SHARED, ARRAYS };

  void add(const SupportPlane& plane, double unit, float least, double shared);
  kernels::Planes view() const;

  std::size_t count_ = 0;
  std::vector<float> arrays_[ARRAYS]; ///< padded with zeros
  double precision_ = 0.0;            ///< of the common dilation; 0: there is none
  Eigen::Vector3d view_;
  double half_width_, unit_;
};

} // namespace pcl_sq::detail

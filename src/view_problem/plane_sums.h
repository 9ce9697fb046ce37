// SPDX-License-Identifier: BSD-3-Clause
// Private. The sums of a PlaneCost for a superquadric, by the kernels.
#pragma once

#include "view_problem/plane_cost.h"

namespace pcl_sq::detail {

/** \brief A PlaneCost as the kernels want it: all planes at once and in single
 * precision. A contributor to fits of bodies with a taper and without. */
class PlaneSums {
public:
  explicit PlaneSums(const PlaneCost& cost);

  /** \brief Adds cost and derivatives. */
  void operator()(const Superquadric& body, SquareSums<11>& equations) const;
  void operator()(const Superquadric& body, SquareSums<13>& equations) const;

private:
  enum Array { X, Y, Z, OFFSET, WEIGHT, LEAST, SHARED, ARRAYS };

  void set(std::size_t i, const TangentPlane& plane, float least, double shared);
  /** \brief Planes from one of them on. */
  kernels::Planes planes(std::size_t begin, std::size_t count) const;
  template <int N, int R>
  void addPlanes(const kernels::PlaneSumsOf<R>& sums, SquareSums<N>& equations) const;
  template <int N>
  void addDepthPrior(const Eigen::Matrix<double, N, 1>& derivatives,
                     double half_depth,
                     SquareSums<N>& equations) const;

  std::size_t count_ = 0; ///< of planes
  std::size_t ends_ = 0;  ///< behind them: before and behind the body, for its depth
  std::vector<float> arrays_[ARRAYS]; ///< padded with zeros
  double precision_ = 0.0;            ///< of the common dilation; 0: there is none
  Eigen::Vector3d view_;
  double half_width_, unit_;
};

} // namespace pcl_sq::detail

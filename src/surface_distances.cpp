// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_superquadric.h"
#include "point_set.h"
#include "unit_frame.h"

#include <limits>

namespace pcl_sq {

Eigen::VectorXd surfaceDistances(const Superquadric& superquadric,
                                 const Eigen::Ref<const Eigen::Matrix3Xd>& points) {
  detail::UnitFrame frame;
  frame.origin = superquadric.center;
  frame.scale = superquadric.semi_axes.maxCoeff();
  constexpr double FAR = 1e6; // in sizes; keeps squares within single precision
  detail::UnitPoints unit;
  unit.reserve(static_cast<std::size_t>(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::Vector3d p = frame.toUnit(points.col(i));
    p = p.allFinite() ? p.cwiseMax(-FAR).cwiseMin(FAR) : Eigen::Vector3d::Zero().eval();
    unit.add(
        static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]));
  }
  std::vector<float> residuals(unit.size());
  kernels::kernels().residuals(unit.view(),
                               detail::toShape(frame.toUnit(superquadric)),
                               kernels::Residual::FOOT_POINT,
                               residuals.data());
  Eigen::VectorXd distances(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    distances[i] = points.col(i).allFinite()
                       ? frame.scale * double(residuals[static_cast<std::size_t>(i)])
                       : std::numeric_limits<double>::infinity();
  return distances;
}

bool spansVolume(const Eigen::Ref<const Eigen::Matrix3Xd>& points) {
  return detail::spannedDimensions(points) == 3;
}

} // namespace pcl_sq

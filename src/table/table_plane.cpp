// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/table_plane.h"

#include <cmath>

namespace pcl_sq {

std::vector<float> TablePlane::toCoefficients() const {
  const Eigen::Vector4f all =
      (Eigen::Vector4d() << normal, offset).finished().cast<float>();
  return {all.data(), all.data() + all.size()};
}

std::optional<TablePlane>
TablePlane::fromCoefficients(const Eigen::VectorXf& coefficients,
                             const Eigen::Vector3d& viewpoint) {
  if (coefficients.size() != 4 || !coefficients.allFinite())
    return std::nullopt;
  TablePlane plane;
  plane.normal = coefficients.head<3>().cast<double>();
  plane.offset = double(coefficients[3]);
  const double length = plane.normal.norm();
  if (!(length > 0.0))
    return std::nullopt;
  plane.normal /= length;
  plane.offset /= length;
  if (plane.signedDistance(viewpoint) < 0.0) {
    plane.normal = -plane.normal;
    plane.offset = -plane.offset;
  }
  return plane;
}

std::optional<TablePlane>
TablePlane::fromCoefficients(const std::vector<float>& coefficients,
                             const Eigen::Vector3d& viewpoint) {
  return fromCoefficients(
      Eigen::VectorXf::Map(coefficients.data(),
                           static_cast<Eigen::Index>(coefficients.size()))
          .eval(),
      viewpoint);
}

} // namespace pcl_sq

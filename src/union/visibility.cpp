// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/visibility.h"

#include "pcl_sq/line_intersection.h"

#include <algorithm>

namespace pcl_sq {

bool isHidden(const MultiSuperquadric& model,
              const Eigen::Vector3d& point,
              const Eigen::Vector3d& eye,
              double slack) {
  const Eigen::Vector3d sight = point - eye;
  const double length = sight.norm();
  const auto covers = [&](const Superquadric& part) {
    double hit; // an eye within a part sees its walls from inside
    return firstHit(part, eye, sight, hit) && hit * length < length - slack;
  };
  return std::any_of(model.parts.begin(), model.parts.end(), covers);
}

} // namespace pcl_sq

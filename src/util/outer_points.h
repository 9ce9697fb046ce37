// SPDX-License-Identifier: BSD-3-Clause
// Private. What may be a corner of a convex hull.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pcl_sq::detail {

/** \brief Leaves out what lies within the octagon of the farthest points of a plane,
 * most of them, so that sorting the others is quick (Akl & Toussaint 1978).
 * \param[in] at the place of an item, an Eigen::Vector2d */
template <typename Item, typename At>
void keepOuter(std::vector<Item>& items, const At& at) {
  std::array<Eigen::Vector2d, 8> corners; // counter-clockwise
  corners.fill(Eigen::Vector2d::Zero());
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const double angle = M_PI_4 * double(k);
    const Eigen::Vector2d towards(std::cos(angle), std::sin(angle));
    double farthest = -1e300;
    for (const Item& item : items)
      if (const double reach = towards.dot(at(item)); reach > farthest) {
        farthest = reach;
        corners[k] = at(item);
      }
  }
  const auto isInner = [&](const Item& item) {
    bool inner = false; // of a single corner nothing is
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Eigen::Vector2d side = corners[(k + 1) % corners.size()] - corners[k],
                            to = at(item) - corners[k];
      if (side.isZero(0.0))
        continue;
      if (!(side.x() * to.y() - side.y() * to.x() > 0.0))
        return false;
      inner = true;
    }
    return inner;
  };
  std::vector<Item> outer;
  std::remove_copy_if(items.begin(), items.end(), std::back_inserter(outer), isInner);
  items = std::move(outer);
}

} // namespace pcl_sq::detail

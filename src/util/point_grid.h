// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/oriented_box.h"

#include <vector>

namespace pcl_sq::detail {

/** \brief Points sorted into the cells of a regular grid, for "is one near?" questions
 * where a search tree would cost more to build than it saves. */
class PointGrid {
public:
  PointGrid() = default;
  /** \param[in] cell side of a cell [m]; made larger where the grid would be huge */
  PointGrid(std::vector<Eigen::Vector3d> points, double cell);

  bool empty() const { return points_.empty(); }
  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  /** \brief Which of the points it was made of the k-th of points() is. */
  std::size_t given(std::size_t k) const { return given_[k]; }
  double cell() const { return cell_; }
  /** \brief Calls a function with the place in points() of each point in the cells that
   * meet \a region, until it says true; whether it did. */
  template <typename Function>
  bool any(const Eigen::AlignedBox3d& region, const Function& function) const {
    if (empty() || !bounds_.intersects(region))
      return false;
    const Eigen::Vector3i low = cellOf(region.min()), high = cellOf(region.max());
    for (int z = low.z(); z <= high.z(); ++z)
      for (int y = low.y(); y <= high.y(); ++y)
        for (std::size_t i = begins_[index(low.x(), y, z)];
             i < begins_[index(high.x(), y, z) + 1];
             ++i)
          if (function(i))
            return true;
    return false;
  }
  /** \brief Whether a point lies in the box grown by \a margin. */
  bool anyIn(const OrientedBox& box, double margin) const;
  /** \brief Whether a point lies within \a radius of \a center. */
  bool anyNear(const Eigen::Vector3d& center, double radius) const;
  /** \brief Calls a function with the first and one past the last place in points() of
   * each cell that has any. */
  template <typename Function>
  void eachCell(const Function& function) const {
    for (std::size_t c = 0; c + 1 < begins_.size(); ++c)
      if (begins_[c] < begins_[c + 1])
        function(begins_[c], begins_[c + 1]);
  }
  /** \brief One point, the mean, per cell with at least \a least points. */
  std::vector<Eigen::Vector3d> means(int least) const;

private:
  Eigen::Vector3i cellOf(const Eigen::Vector3d& point) const;
  std::size_t index(int x, int y, int z) const {
    return (std::size_t(z) * std::size_t(size_.y()) + std::size_t(y)) *
               std::size_t(size_.x()) +
           std::size_t(x);
  }

  std::vector<Eigen::Vector3d> points_; ///< sorted by cell
  std::vector<std::size_t> given_;      ///< their places before
  std::vector<std::size_t> begins_;     ///< first point of each cell, and the end
  Eigen::AlignedBox3d bounds_;
  Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
  double cell_ = 1.0;
};

} // namespace pcl_sq::detail

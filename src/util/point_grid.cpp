// SPDX-License-Identifier: BSD-3-Clause
#include "util/point_grid.h"

namespace pcl_sq::detail {

namespace {
constexpr double MAX_CELLS = 2e6;
}

PointGrid::PointGrid(std::vector<Eigen::Vector3d> points, double cell) : cell_(cell) {
  if (points.empty())
    return;
  for (const Eigen::Vector3d& p : points)
    bounds_.extend(p);
  const Eigen::Vector3d extent = bounds_.sizes();
  while (((extent / cell_).array() + 1.0).prod() > MAX_CELLS)
    cell_ *= 2.0;
  size_ = (extent / cell_).cast<int>() + Eigen::Vector3i::Ones();
  const std::size_t cells =
      std::size_t(size_.x()) * std::size_t(size_.y()) * std::size_t(size_.z());
  // counting sort: stable, so that the result does not depend on anything but the input
  begins_.assign(cells + 1, 0);
  std::vector<std::size_t> cell_of(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3i c = cellOf(points[i]);
    cell_of[i] = index(c.x(), c.y(), c.z());
    ++begins_[cell_of[i] + 1];
  }
  for (std::size_t i = 0; i < cells; ++i)
    begins_[i + 1] += begins_[i];
  points_.resize(points.size());
  given_.resize(points.size());
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t place = next[cell_of[i]]++;
    points_[place] = points[i];
    given_[place] = i;
  }
}

Eigen::Vector3i PointGrid::cellOf(const Eigen::Vector3d& point) const {
  return ((point - bounds_.min()) / cell_)
      .cwiseMax(0.0)
      .cwiseMin((size_ - Eigen::Vector3i::Ones()).cast<double>())
      .cast<int>();
}

bool PointGrid::anyIn(const OrientedBox& box, double margin) const {
  Eigen::AlignedBox3d region = box.boundingBox();
  region.min().array() -= 2.0 * margin;
  region.max().array() += 2.0 * margin;
  return any(region, [&](std::size_t k) { return box.contains(points_[k], margin); });
}

bool PointGrid::anyNear(const Eigen::Vector3d& center, double radius) const {
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius);
  return any({center - reach, center + reach}, [&](std::size_t k) {
    return (points_[k] - center).squaredNorm() <= radius * radius;
  });
}

std::vector<Eigen::Vector3d> PointGrid::means(int least) const {
  std::vector<Eigen::Vector3d> all;
  for (std::size_t c = 0; c + 1 < begins_.size(); ++c) {
    const std::size_t count = begins_[c + 1] - begins_[c];
    if (count == 0 || count < std::size_t(least))
      continue;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = begins_[c]; i < begins_[c + 1]; ++i)
      sum += points_[i];
    all.push_back(sum / double(count));
  }
  return all;
}

} // namespace pcl_sq::detail

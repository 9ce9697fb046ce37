// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/voxel_layout.h"

#include "util/option_check.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace pcl_sq {
namespace {

/** Farther away than this lies no scene, only outliers of broken sensors and files. */
constexpr double MAX_COORDINATE = 1e7; // [m]

double divisionsAlong(int axis, double side, const VoxelOptions& options) {
  if (!(side > 0.0))
    return 1.0;
  switch (options.rule) {
  case VoxelRule::PERCENT:
    return std::max(1.0, std::round(100.0 / options.percent[axis]));
  case VoxelRule::TARGET_SIZE_CLAMPED: {
    // 220 mm are 22 voxels of 10 mm, although 0.22f / 0.01 may round to above 22
    const double cells = std::ceil(side / options.target_size * (1.0 - 1e-6));
    return std::clamp(cells,
                      static_cast<double>(options.min_divisions),
                      static_cast<double>(options.max_divisions));
  }
  case VoxelRule::DIVISIONS:
    break;
  }
  return options.divisions[axis];
}

} // namespace

bool VoxelOptions::isValid(std::string* why) const {
  if (!((percent.array() > 0.0).all() && (percent.array() <= 100.0).all()))
    return detail::refuse(why, "percent must be in (0, 100]");
  if (!(target_size > 0.0 && std::isfinite(target_size)))
    return detail::refuse(why, "target_size must be positive");
  if (min_divisions < 1 || max_divisions < min_divisions)
    return detail::refuse(why, "min_divisions must be in [1, max_divisions]");
  if ((divisions.array() < 1).any())
    return detail::refuse(why, "divisions must be at least 1");
  if (max_cells < 1)
    return detail::refuse(why, "max_cells must be at least 1");
  return true;
}

Eigen::Vector3d VoxelLayout::cellSizes() const {
  return region.sizes().cwiseQuotient(divisions.cwiseMax(1).cast<double>());
}

std::size_t VoxelLayout::validCount() const {
  return static_cast<std::size_t>(
      std::count_if(counts.begin(), counts.end(), [this](std::uint32_t count) {
        return count >= min_points;
      }));
}

CellMask VoxelLayout::validColumns() const {
  CellMask mask(divisions[0], divisions[1]);
  const std::size_t columns = mask.cells.size();
  for (std::size_t layer = 0; layer < counts.size(); layer += columns)
    for (std::size_t c = 0; c < columns; ++c)
      mask.cells[c] |= counts[layer + c] >= min_points;
  return mask;
}

std::vector<std::uint32_t> VoxelLayout::columnCounts() const {
  std::vector<std::uint32_t> columns(static_cast<std::size_t>(divisions[0]) *
                                     static_cast<std::size_t>(divisions[1]));
  for (std::size_t layer = 0; layer < counts.size(); layer += columns.size())
    for (std::size_t c = 0; c < columns.size(); ++c)
      columns[c] += counts[layer + c] >= min_points ? counts[layer + c] : 0;
  return columns;
}

RoiBox VoxelLayout::boxOf(const CellRect& cells) const {
  const Eigen::Vector3d size = cellSizes();
  RoiBox box = region;
  box.min.x() = region.min.x() + cells.x * size.x();
  box.max.x() = region.min.x() + (cells.x + cells.width) * size.x();
  box.min.y() = region.min.y() + cells.y * size.y();
  box.max.y() = region.min.y() + (cells.y + cells.height) * size.y();
  return box;
}

bool makeVoxelLayout(const RoiBox& region,
                     const VoxelOptions& options,
                     VoxelLayout& layout,
                     std::string* why) {
  layout = VoxelLayout();
  if (!options.isValid(why))
    return false;
  const Eigen::Vector3d sides = region.sizes();
  if (!((region.min.array().abs() <= MAX_COORDINATE).all() &&
        (region.max.array().abs() <= MAX_COORDINATE).all()))
    return detail::refuse(
        why,
        "the region reaches farther than 1e7 m; remove the outliers or set a "
        "region");
  if ((sides.array() < 0.0).any())
    return detail::refuse(why, "the region's min is above its max; exchange them");
  Eigen::Vector3d wanted;
  for (int axis = 0; axis < 3; ++axis)
    wanted[axis] = divisionsAlong(axis, sides[axis], options);
  if (wanted.prod() > options.max_cells) {
    std::ostringstream sentence;
    sentence << wanted[0] << " x " << wanted[1] << " x " << wanted[2]
             << " voxels exceed the limit of " << options.max_cells
             << "; ask for fewer divisions";
    return detail::refuse(why, sentence.str());
  }
  layout.region = region;
  layout.divisions = wanted.cast<int>();
  for (int axis = 0; axis < 3; ++axis)
    if (sides[axis] > 0.0)
      layout.cells_per_meter[axis] =
          std::min(wanted[axis] / sides[axis], std::numeric_limits<double>::max());
  layout.counts.assign(static_cast<std::size_t>(wanted.prod()), 0);
  return true;
}

std::uint32_t validityThreshold(const std::vector<std::uint32_t>& counts) {
  std::vector<std::uint32_t> occupied;
  std::copy_if(counts.begin(),
               counts.end(),
               std::back_inserter(occupied),
               [](std::uint32_t count) { return count > 0; });
  constexpr std::uint32_t FLOOR = 3;
  if (std::accumulate(occupied.begin(), occupied.end(), std::uint64_t{0}) < FLOOR)
    return FLOOR;
  const auto middle =
      occupied.begin() + static_cast<std::ptrdiff_t>(occupied.size() / 2);
  std::nth_element(occupied.begin(), middle, occupied.end());
  const std::uint32_t median = *middle;
  return std::max({1u, std::min(FLOOR, median / 2), (median + 10) / 20});
}

} // namespace pcl_sq

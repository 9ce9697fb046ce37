// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/cell_mask.h"
#include "pcl_sq/exports.h"
#include "pcl_sq/roi.h"

#include <string>

namespace pcl_sq {

/** \brief How the numbers of divisions follow from the region's sides. */
enum class VoxelRule {
  PERCENT,             ///< each voxel side is a percentage of the region's side (III-C)
  TARGET_SIZE_CLAMPED, ///< voxels of one size, the divisions clamped to a range: gives
                       ///< the paper's 22 x 31 x 10 for its book
  DIVISIONS            ///< the numbers themselves
};

/** \brief Settings of the adaptive voxel grid (III-C, Fig. 3). */
struct PCL_SQ_EXPORTS VoxelOptions {
  VoxelRule rule = VoxelRule::PERCENT;
  Eigen::Vector3d percent{5.0, 5.0, 10.0}; ///< PERCENT: of the side, (0, 100]
  double target_size = 0.010;              ///< TARGET_SIZE_CLAMPED: voxel side [m], > 0
  int min_divisions = 10; ///< TARGET_SIZE_CLAMPED: per axis, [1, max_divisions]
  int max_divisions = 31; ///< TARGET_SIZE_CLAMPED: per axis, >= min_divisions
  Eigen::Vector3i divisions{20, 20, 10}; ///< DIVISIONS: per axis, >= 1
  unsigned int min_points = 0; ///< points that make a voxel valid; 0: from the data
  int max_cells = 1 << 24;     ///< more voxels are refused, [1, 2^31 - 1]

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief Finds the voxel of a point: what of a VoxelLayout a loop over points needs,
 * as a copy that the compiler can keep in registers. */
struct VoxelLocator {
  double min[3], max[3], cells_per_meter[3];
  int divisions[3];

  /** \brief As VoxelLayout::indexOf(). */
  std::int32_t operator()(double x, double y, double z) const {
    // one branch for all six sides; negated, so that NaN counts as outside
    const bool inside = (x >= min[0]) & (x <= max[0]) & (y >= min[1]) & (y <= max[1]) &
                        (z >= min[2]) & (z <= max[2]);
    if (!inside)
      return -1;
    return cellAlong(0, x) +
           divisions[0] * (cellAlong(1, y) + divisions[1] * cellAlong(2, z));
  }

private:
  int cellAlong(int axis, double value) const {
    const int cell = static_cast<int>((value - min[axis]) * cells_per_meter[axis]);
    return std::min(cell, divisions[axis] - 1);
  }
};

/** \brief A grid that divides a region exactly, and the points counted in it.
 *
 * Voxel (i, j, k) has the index i + nx (j + ny k); j grows with y, which points down in
 * a camera frame, so that row 0 is the top row of the image.
 */
struct PCL_SQ_EXPORTS VoxelLayout {
  RoiBox region;                                  ///< [m]
  Eigen::Vector3i divisions{0, 0, 0};             ///< nx, ny, nz
  Eigen::Vector3d cells_per_meter{0.0, 0.0, 0.0}; ///< [1/m], 0 along a flat side
  std::vector<std::uint32_t> counts;              ///< points per voxel
  std::uint32_t min_points = 1;                   ///< points that make a voxel valid

  bool empty() const { return counts.empty(); }
  /** \brief Sides of a voxel [m]. */
  Eigen::Vector3d cellSizes() const;
  /** \brief Index of the voxel that holds a point; -1 outside of the region and for
   * coordinates that are not finite. The region's far sides belong to the last voxels.
   */
  std::int32_t indexOf(double x, double y, double z) const {
    return locator()(x, y, z);
  }
  /** \brief indexOf() for loops. */
  VoxelLocator locator() const {
    const auto &a = region.min, &b = region.max, &c = cells_per_meter;
    return {{a[0], a[1], a[2]},
            {b[0], b[1], b[2]},
            {c[0], c[1], c[2]},
            {divisions[0], divisions[1], divisions[2]}};
  }
  /** \brief Index of the column of voxels along z that holds a point, i + nx j. */
  std::int32_t columnOf(std::int32_t index) const {
    return index % (divisions[0] * divisions[1]);
  }
  /** \brief Whether a voxel holds enough points. \pre 0 <= index < counts.size() */
  bool isValid(std::int32_t index) const {
    return counts[static_cast<std::size_t>(index)] >= min_points;
  }
  /** \brief Number of valid voxels. */
  std::size_t validCount() const;
  /** \brief The grid seen along z: a cell is set where any voxel behind it is valid. */
  CellMask validColumns() const;
  /** \brief Points in the valid voxels behind each cell of validColumns(). */
  std::vector<std::uint32_t> columnCounts() const;
  /** \brief The part of the region behind a rectangle of cells; keeps its depth. */
  RoiBox boxOf(const CellRect& cells) const;
};

/** \brief An empty grid over a region.
 *
 * A side of no length gets one division, whatever the rule.
 * \param[out] layout set to the grid with all counts zero; emptied on failure
 * \param[out] why what is wrong and what to do, on failure
 * \return false if the options or the region are not valid or the voxels too many */
[[nodiscard]] PCL_SQ_EXPORTS bool makeVoxelLayout(const RoiBox& region,
                                                  const VoxelOptions& options,
                                                  VoxelLayout& layout,
                                                  std::string* why = nullptr);

/** \brief Points that make a voxel valid, from the counts of all voxels.
 *
 * 5 % of the median count of the voxels that are not empty, but at least 3; where the
 * median is below 6, at least half of it, or a sparse cloud would lose its object.
 * Fewer than 3 points in all are noise. */
PCL_SQ_EXPORTS std::uint32_t
validityThreshold(const std::vector<std::uint32_t>& counts);

} // namespace pcl_sq

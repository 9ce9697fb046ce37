// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/voxel_layout.h"

namespace pcl_sq {

/** \brief How far a prism extends down from the row that gave its width. The paper's
 * pseudo-code (Fig. 4, lines 11-16) can be read in three ways. */
enum class PrismRun {
  CROSS, ///< as the run of the seed's own column: the figure's simplest meaning
  MIN,   ///< as the shortest run below the row: all cells of the rectangle are valid
  MAX    ///< as the longest run below the row
};

/** \brief Settings of the fusion of voxels to prisms (III-C, Fig. 4). */
struct PCL_SQ_EXPORTS PrismOptions {
  PrismRun run = PrismRun::CROSS;
  /** \brief Passes over the cells, >= 0, 0: as many as are needed. In the paper's
   * pseudo-code read literally a second pass finds nothing: the same as 1. */
  int max_passes = 0;
  double max_uncovered = 0.02; ///< share of valid cells that may stay uncovered, [0, 1]
  bool merge = true;           ///< fuse prisms that are nearly the same
  double merge_overlap = 0.8;  ///< common cells over those of the smaller, (0, 1]
  double merge_width_ratio = 0.75; ///< narrower over wider of a pair, (0, 1]
  /** \brief A prism whose own cells, covered by no other, are fewer than this share of
   * the valid cells is dropped; [0, 1). */
  double min_exclusive = 0.03;
  int min_points = 30; ///< a prism with fewer points is dropped, >= 0

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief A rectangular prism of connected voxels. */
struct Prism {
  CellRect cells; ///< in the grid seen along z
  RoiBox box;     ///< [m]; its depth is that of the whole region
};

/** \brief Fuses the valid cells of a mask to rectangles (III-C, Fig. 4).
 *
 * A seed is a valid cell whose left and upper neighbours are not; the prism takes the
 * run of valid cells to its right as width and a run downwards as height (PrismRun).
 * "Parsed" cells are those that a prism covers: later passes see only the uncovered
 * ones, until hardly any is left. Nearly equal prisms are then merged and those that
 * add little are dropped.
 *
 * \param[in] points points behind each cell of the mask; if empty, min_points is not
 * applied
 * \return rectangles in the order of their discovery; none for options that are not
 * valid */
PCL_SQ_EXPORTS std::vector<CellRect>
scanPrisms(const CellMask& mask,
           const PrismOptions& options = PrismOptions(),
           const std::vector<std::uint32_t>& points = {});

/** \brief Fuses the valid voxels of a grid to prisms. */
PCL_SQ_EXPORTS std::vector<Prism>
scanPrisms(const VoxelLayout& layout, const PrismOptions& options = PrismOptions());

/** \brief Number of set cells that no rectangle covers. */
PCL_SQ_EXPORTS int uncoveredCells(const CellMask& mask,
                                  const std::vector<CellRect>& rects);

/** \brief Which prisms hold a column of voxels. */
class PCL_SQ_EXPORTS PrismMembership {
public:
  /** \brief The prisms of one column, as indices. */
  struct Range {
    const std::uint32_t *first, *last;
    const std::uint32_t* begin() const { return first; }
    const std::uint32_t* end() const { return last; }
  };

  /** \param[in] exclusive whether only the smallest prism (the first of equals) holds a
   * column that lies in several */
  PrismMembership(const VoxelLayout& layout,
                  const std::vector<Prism>& prisms,
                  bool exclusive);

  /** \param[in] column as VoxelLayout::columnOf() gives it */
  Range prismsOf(std::int32_t column) const {
    const auto c = static_cast<std::size_t>(column);
    return {prisms_.data() + starts_[c], prisms_.data() + starts_[c + 1]};
  }

private:
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> prisms_;
};

} // namespace pcl_sq

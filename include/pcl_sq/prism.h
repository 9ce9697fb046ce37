// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/voxel_layout.h"

namespace pcl_sq {

/** \brief How voxels are fused to prisms. */
enum class PrismMethod {
  /** \brief The rectangle with the largest surplus of valid over missing cells, again
   * and again; what they leave over is fused by connection. Ragged borders, which start
   * and stop the runs of FIGURE_4, do not matter, and prisms hardly overlap. */
  RECTANGLES,
  /** \brief The paper's scan: a valid cell without a valid left or upper neighbour is a
   * seed; the run of valid cells to its right is the width, a run downwards the height.
   * Prisms run through each other: a neck reaches the bottom of its bottle. */
  FIGURE_4
};

/** \brief How far a prism of FIGURE_4 extends down from the row that gave its width.
 * The paper's pseudo-code (lines 11-16) can be read in three ways. */
enum class PrismRun {
  CROSS, ///< as the run of the seed's own column: the figure's simplest meaning
  MIN,   ///< as the shortest run below the row: all cells of the rectangle are valid
  MAX    ///< as the longest run below the row
};

/** \brief Settings of the fusion of voxels to prisms (III-C, Fig. 4). */
struct PCL_SQ_EXPORTS PrismOptions {
  PrismMethod method = PrismMethod::RECTANGLES;
  /** \brief Smallest share of the valid cells that a prism must have for itself,
   * covered by no other; [0, 1). */
  double min_exclusive = 0.03;
  int min_points = 30; ///< a prism with fewer points is dropped, >= 0

  /** \brief RECTANGLES: share of the valid cells below which a rectangle is no part but
   * a piece of one, such as a handle's grip; pieces are fused by connection; [0, 1). */
  double min_rectangle = 0.10;

  PrismRun run = PrismRun::CROSS; ///< FIGURE_4: height of a prism
  /** \brief FIGURE_4: passes over the cells, >= 0; 0: as many as are needed. The
   * pseudo-code as printed flags all valid cells in the first pass: the same as 1. */
  int max_passes = 0;
  /** \brief FIGURE_4: share of valid cells that may stay uncovered, [0, 1]. */
  double max_uncovered = 0.02;
  bool merge = true;          ///< FIGURE_4: fuse prisms that are nearly the same
  double merge_overlap = 0.8; ///< FIGURE_4: common cells over the smaller's, (0, 1]
  double merge_width_ratio = 0.75; ///< FIGURE_4: narrower over wider, (0, 1]

  /** \brief The pseudo-code of Fig. 4 as it is printed: one pass, prisms neither merged
   * nor dropped. */
  static PrismOptions literal();
  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief A rectangular prism of connected voxels. */
struct Prism {
  CellRect cells; ///< in the grid seen along z
  RoiBox box;     ///< [m]; its depth is that of the whole region
};

/** \brief Most cells along the shorter side of a mask; RECTANGLES takes time with its
 * square. */
constexpr int MAX_PRISM_CELLS = 512;

/** \brief Fuses the valid cells of a mask to rectangles (III-C, Fig. 4).
 *
 * FIGURE_4 in its meaningful reading: "parsed" cells are those that a prism covers;
 * passes after the first see only the uncovered ones, until hardly any is left. Nearly
 * equal prisms are then merged and those that add little are dropped.
 *
 * \param[in] points points behind each cell of the mask; if empty, min_points is not
 * applied
 * \return rectangles in the order of their discovery; none for options that are not
 * valid or a mask of more than MAX_PRISM_CELLS cells along both sides */
PCL_SQ_EXPORTS std::vector<CellRect>
scanPrisms(const CellMask& mask,
           const PrismOptions& options = PrismOptions(),
           const std::vector<std::uint32_t>& points = {});

/** \brief Fuses the valid voxels of a grid, seen along z, to prisms. */
PCL_SQ_EXPORTS std::vector<Prism>
scanPrisms(const VoxelLayout& layout, const PrismOptions& options = PrismOptions());

/** \brief Number of set cells that no rectangle covers. */
PCL_SQ_EXPORTS int uncoveredCells(const CellMask& mask,
                                  const std::vector<CellRect>& rects);

/** \brief Which prisms hold a voxel. */
class PCL_SQ_EXPORTS PrismMembership {
public:
  /** \brief The prisms of one voxel, as indices. */
  struct Range {
    const std::uint32_t *first, *last;
    const std::uint32_t* begin() const { return first; }
    const std::uint32_t* end() const { return last; }
  };

  /** \param[in] exclusive whether only the smallest prism (the first of equals) holds a
   * voxel that lies in several */
  PrismMembership(const VoxelLayout& layout,
                  const std::vector<Prism>& prisms,
                  bool exclusive);

  /** \brief The prisms of a voxel; none if it is not valid.
   * \param[in] voxel as VoxelLayout::indexOf() gives it, not negative */
  Range prismsOf(std::int32_t voxel) const {
    // nearly all voxels lie in one prism: one look-up for these
    const std::uint32_t& only = only_[static_cast<std::size_t>(voxel)];
    if (only < SEVERAL)
      return {&only, &only + 1};
    return only == NONE ? Range{nullptr, nullptr} : severalOf(voxel);
  }
  /** \brief Points of the grid in each prism. */
  const std::vector<std::size_t>& pointsPerPrism() const { return points_; }

private:
  static constexpr std::uint32_t NONE = 0xffffffff, SEVERAL = 0xfffffffe;

  Range severalOf(std::int32_t voxel) const;

  std::vector<std::uint32_t> only_; // of each voxel: its prism, NONE or SEVERAL
  std::vector<std::uint32_t> column_starts_; // of each column's list in of_columns_
  std::vector<std::uint32_t> of_columns_;
  std::vector<std::size_t> points_;
};

} // namespace pcl_sq

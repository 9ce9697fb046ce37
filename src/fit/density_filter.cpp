// SPDX-License-Identifier: BSD-3-Clause
#include "fit/density_filter.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t LOOKED_AT = 4096;
constexpr int CELLS = 32;      ///< per edge of the grid
constexpr float EXTENT = 3.5F; ///< half the grid, in standard deviations
constexpr double DENSE = 0.3;  ///< of the well-populated neighbourhoods' count
constexpr int STRIDE_Y = CELLS, STRIDE_Z = CELLS * CELLS;
using Grid = std::vector<std::uint16_t>;

/** \brief Adds to each cell its two neighbours along one direction; cells at the rim
 * stay empty by construction of the grid. */
void addNeighbours(Grid& grid, int stride) {
  const Grid before = grid;
  const auto size = static_cast<int>(grid.size());
  for (int i = stride; i < size - stride; ++i)
    grid[i] =
        static_cast<std::uint16_t>(before[i - stride] + before[i] + before[i + stride]);
}

/** \brief Cell of a point, -1 outside of the inner cells. */
int cellOf(const Eigen::Vector3f& p, const Eigen::Vector3f& half) {
  int index = 0;
  for (int k = 2; k >= 0; --k) {
    const float c = (p[k] / half[k] + 1.0F) * (0.5F * CELLS);
    if (!(c >= 1.0F && c < CELLS - 1.0F))
      return -1;
    index = index * CELLS + static_cast<int>(c);
  }
  return index;
}

} // namespace

UnitPoints densePoints(const UnitPoints& all) {
  const UnitPoints points = subset(all, LOOKED_AT);
  const std::size_t n = points.size();
  // cubic cells: the same half-width along all axes, as small as the points allow
  float reach = 0.0F;
  for (std::size_t i = 0; i < n; ++i)
    reach = std::max(reach, points[i].cwiseAbs().maxCoeff());
  const Eigen::Vector3f half =
      Eigen::Vector3f::Constant(std::min(1.08F * reach, EXTENT) + 1e-6F);
  Grid grid(std::size_t(CELLS) * CELLS * CELLS, 0);
  std::vector<int> cell(n);
  for (std::size_t i = 0; i < n; ++i) {
    cell[i] = cellOf(points[i], half);
    if (cell[i] >= 0 && grid[cell[i]] < 2000)
      ++grid[cell[i]];
  }
  addNeighbours(grid, 1);
  addNeighbours(grid, STRIDE_Y);
  addNeighbours(grid, STRIDE_Z);
  std::vector<std::uint16_t> counts;
  counts.reserve(n);
  for (const int c : cell)
    if (c >= 0)
      counts.push_back(grid[c]);
  UnitPoints dense;
  dense.reserve(n);
  if (counts.empty())
    return points;
  const auto upper =
      counts.begin() + static_cast<std::ptrdiff_t>(counts.size() * 3 / 4);
  std::nth_element(counts.begin(), upper, counts.end());
  const auto enough = static_cast<std::uint16_t>(DENSE * *upper);
  for (std::size_t i = 0; i < n; ++i)
    if (cell[i] >= 0 && grid[cell[i]] >= enough) {
      const Eigen::Vector3f p = points[i];
      dense.add(p[0], p[1], p[2]);
    }
  return dense;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "paper/prism_search.h"

#include <numeric>

namespace pcl_sq {
namespace {

std::uint64_t pointsBehind(const CellMask& mask,
                           const CellRect& rect,
                           const std::vector<std::uint32_t>& points) {
  std::uint64_t sum = 0;
  for (int y = rect.y; y < rect.y + rect.height; ++y)
    for (int x = rect.x; x < rect.x + rect.width; ++x)
      sum += points[mask.indexOf(x, y)];
  return sum;
}

} // namespace

PrismOptions PrismOptions::literal() {
  PrismOptions options;
  options.method = PrismMethod::FIGURE_4;
  options.merge = false;
  options.max_passes = 1;
  options.min_exclusive = 0.0;
  options.min_points = 0;
  return options;
}

bool PrismOptions::isValid(std::string* why) const {
  const char* wrong = nullptr;
  if (!(min_exclusive >= 0.0 && min_exclusive < 1.0))
    wrong = "min_exclusive must be in [0, 1)";
  else if (min_points < 0)
    wrong = "min_points must not be negative";
  else if (!(min_rectangle >= 0.0 && min_rectangle < 1.0))
    wrong = "min_rectangle must be in [0, 1)";
  else if (max_passes < 0)
    wrong = "max_passes must not be negative";
  else if (!(max_uncovered >= 0.0 && max_uncovered <= 1.0))
    wrong = "max_uncovered must be in [0, 1]";
  else if (!(merge_overlap > 0.0 && merge_overlap <= 1.0))
    wrong = "merge_overlap must be in (0, 1]";
  else if (!(merge_width_ratio > 0.0 && merge_width_ratio <= 1.0))
    wrong = "merge_width_ratio must be in (0, 1]";
  if (wrong && why)
    *why = wrong;
  return !wrong;
}

std::vector<CellRect> scanPrisms(const CellMask& mask,
                                 const PrismOptions& options,
                                 const std::vector<std::uint32_t>& points) {
  if (!options.isValid() || std::min(mask.width, mask.height) > MAX_PRISM_CELLS)
    return {};
  std::vector<CellRect> rects;
  if (options.method == PrismMethod::RECTANGLES) {
    rects = findRectangles(mask, options);
  } else {
    rects = scanFigure4(mask, options);
    if (options.merge || options.min_exclusive > 0.0)
      keepLargest(rects);
    if (options.merge)
      mergePrisms(rects, options);
    if (options.min_exclusive > 0.0)
      dropPrisms(mask, rects, options.min_exclusive * mask.count());
  }
  if (points.size() == mask.cells.size())
    rects.erase(std::remove_if(rects.begin(),
                               rects.end(),
                               [&](const CellRect& rect) {
                                 return pointsBehind(mask, rect, points) <
                                        static_cast<std::uint64_t>(options.min_points);
                               }),
                rects.end());
  return rects;
}

std::vector<Prism> scanPrisms(const VoxelLayout& layout, const PrismOptions& options) {
  std::vector<Prism> prisms;
  for (const CellRect& cells :
       scanPrisms(layout.validColumns(), options, layout.columnCounts()))
    prisms.push_back({cells, layout.boxOf(cells)});
  return prisms;
}

int uncoveredCells(const CellMask& mask, const std::vector<CellRect>& rects) {
  CellMask uncovered = mask;
  for (const CellRect& rect : rects)
    clearCells(uncovered, rect);
  return uncovered.count();
}

PrismMembership::PrismMembership(const VoxelLayout& layout,
                                 const std::vector<Prism>& prisms,
                                 bool exclusive) {
  std::vector<std::uint32_t> order(prisms.size());
  std::iota(order.begin(), order.end(), 0u);
  if (exclusive)
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return prisms[a].cells.area() < prisms[b].cells.area();
    });
  // all voxels of a column lie in the same prisms
  column_starts_.push_back(0);
  for (int y = 0; y < layout.divisions[1]; ++y)
    for (int x = 0; x < layout.divisions[0]; ++x) {
      for (const std::uint32_t prism : order)
        if (prisms[prism].cells.contains(x, y)) {
          of_columns_.push_back(prism);
          if (exclusive)
            break;
        }
      column_starts_.push_back(static_cast<std::uint32_t>(of_columns_.size()));
    }
  points_.assign(prisms.size(), 0);
  only_.assign(layout.counts.size(), NONE);
  const std::size_t columns = column_starts_.size() - 1;
  for (std::size_t column = 0; column < columns; ++column) {
    const std::uint32_t first = column_starts_[column],
                        end = column_starts_[column + 1];
    if (first == end)
      continue;
    const std::uint32_t only = end - first == 1 ? of_columns_[first] : SEVERAL;
    std::size_t count = 0;
    for (std::size_t v = column; v < only_.size(); v += columns)
      if (layout.counts[v] >= layout.min_points) {
        only_[v] = only;
        count += layout.counts[v];
      }
    for (std::uint32_t c = first; c < end; ++c)
      points_[of_columns_[c]] += count;
  }
}

PrismMembership::Range PrismMembership::severalOf(std::int32_t voxel) const {
  const std::size_t column =
      static_cast<std::size_t>(voxel) % (column_starts_.size() - 1);
  return {of_columns_.data() + column_starts_[column],
          of_columns_.data() + column_starts_[column + 1]};
}

} // namespace pcl_sq

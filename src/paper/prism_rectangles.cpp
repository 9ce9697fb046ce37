// SPDX-License-Identifier: BSD-3-Clause
#include "paper/prism_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_sq {
namespace {

/** How far a prism's rim reaches, what is nearer belongs to it [cells]: the round sides
 * of a disc, for example, are no parts of their own. */
int rimOf(const CellMask& mask) {
  return std::max(
      2, static_cast<int>(std::lround(0.1 * std::min(mask.width, mask.height))));
}

/** Missing cells that outweigh a valid one. With 1, a neck half as wide as its bottle
 * costs nothing and stays in the body's prism; with 2 a row must be two thirds full. */
constexpr int MISSING_WEIGHT = 2;

/** The rectangle with the largest sum of weights, the smallest of equals: all pairs of
 * rows, Kadane's scan along each. */
CellRect heaviestRect(const std::vector<int>& weights, int width, int height) {
  CellRect best;
  int best_sum = 0;
  std::vector<int> columns(static_cast<std::size_t>(width));
  for (int top = 0; top < height; ++top) {
    std::fill(columns.begin(), columns.end(), 0);
    for (int bottom = top; bottom < height; ++bottom) {
      const int* row = weights.data() + static_cast<std::ptrdiff_t>(bottom) * width;
      int sum = 0, left = 0;
      for (int x = 0; x < width; ++x) {
        int& column = columns[static_cast<std::size_t>(x)];
        column += row[x];
        if (sum <= 0) {
          sum = 0;
          left = x;
        }
        sum += column;
        const CellRect rect{left, top, x - left + 1, bottom - top + 1};
        if (sum > best_sum || (sum == best_sum && rect.area() < best.area())) {
          best_sum = sum;
          best = rect;
        }
      }
    }
  }
  return best;
}

/** Bounds of the set cells of a part of a mask. */
CellRect boundsOf(const CellMask& mask, const CellRect& within) {
  CellRect bounds;
  for (int y = within.y; y < within.y + within.height; ++y)
    for (int x = within.x; x < within.x + within.width; ++x)
      if (mask(x, y))
        bounds = bounds.area() == 0 ? CellRect{x, y, 1, 1}
                                    : boundingRect(bounds, {x, y, 1, 1});
  return bounds;
}

/** Large rectangles, taken out of \a rest; a cell that one has covered is missing for
 * the next, or it would join what sticks out of the first on opposite sides. */
std::vector<CellRect> takeRectangles(CellMask& rest, double least) {
  std::vector<int> weights(rest.cells.size());
  std::vector<CellRect> rects;
  while (rest.count() >= std::max(1.0, least)) {
    for (std::size_t c = 0; c < weights.size(); ++c)
      weights[c] = rest.cells[c] ? 1 : -MISSING_WEIGHT;
    const CellRect rect = heaviestRect(weights, rest.width, rest.height);
    if (countCells(rest, rect) < least)
      break;
    rects.push_back(rect);
    clearCells(rest, rect);
  }
  return rects;
}

/** Cells from a cell to a rectangle, diagonals as one; 0 within. */
int cellsBetween(const CellRect& rect, int x, int y) {
  return std::max({0,
                   rect.x - x,
                   x - (rect.x + rect.width - 1),
                   rect.y - y,
                   y - (rect.y + rect.height - 1)});
}

/** Whether no cell of \a inner is farther than \a reach from \a outer. */
bool isWithin(const CellRect& inner, const CellRect& outer, int reach) {
  return cellsBetween(outer, inner.x, inner.y) <= reach &&
         cellsBetween(outer, inner.x + inner.width - 1, inner.y + inner.height - 1) <=
             reach;
}

bool isInBlock(const CellMask& mask, int x, int y) {
  for (int top = y - 1; top <= y; ++top)
    for (int left = x - 1; left <= x; ++left)
      if (mask(left, top) && mask(left + 1, top) && mask(left, top + 1) &&
          mask(left + 1, top + 1))
        return true;
  return false;
}

/** The mask without the lines, one cell thick, that lie along a rectangle: they are its
 * rounded border and would tie together what sticks out of it on different sides. */
CellMask withoutBorders(const CellMask& mask, const std::vector<CellRect>& rects) {
  CellMask thick = mask;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (mask(x, y) && !isInBlock(mask, x, y) &&
          std::any_of(rects.begin(), rects.end(), [&](const CellRect& rect) {
            return cellsBetween(rect, x, y) == 1;
          }))
        thick.set(x, y, false);
  return thick;
}

/** Takes the set cells connected with one out of the mask; a gap of one cell, a line
 * that the sensor missed, does not part them. */
CellMask takeRegion(CellMask& mask, int x, int y) {
  constexpr int REACH = 2;
  CellMask region(mask.width, mask.height);
  std::vector<std::pair<int, int>> todo{{x, y}};
  mask.set(x, y, false);
  while (!todo.empty()) {
    const auto [cx, cy] = todo.back();
    todo.pop_back();
    region.set(cx, cy);
    for (int ny = cy - REACH; ny <= cy + REACH; ++ny)
      for (int nx = cx - REACH; nx <= cx + REACH; ++nx)
        if (mask(nx, ny)) {
          mask.set(nx, ny, false);
          todo.emplace_back(nx, ny);
        }
  }
  return region;
}

/** Bounds of the connected regions that are large enough and do not surround a
 * rectangle. */
std::vector<CellRect>
takeRegions(CellMask rest, const std::vector<CellRect>& rects, double least) {
  std::vector<CellRect> regions;
  for (int y = 0; y < rest.height; ++y)
    for (int x = 0; x < rest.width; ++x) {
      if (!rest(x, y))
        continue;
      const CellMask region = takeRegion(rest, x, y);
      const CellRect bounds = boundsOf(region, {0, 0, rest.width, rest.height});
      const bool surrounds =
          std::any_of(rects.begin(), rects.end(), [&](const CellRect& rect) {
            return 2 * intersection(bounds, rect).area() > bounds.area();
          });
      const bool is_rim =
          std::any_of(rects.begin(), rects.end(), [&](const CellRect& rect) {
            return isWithin(bounds, rect, rimOf(rest));
          });
      if (!surrounds && !is_rim && region.count() >= least)
        regions.push_back(bounds);
    }
  return regions;
}

/** Extends each prism to the uncovered cells that are close to it and to no other. */
void takeFringe(const CellMask& mask, std::vector<CellRect>& rects) {
  const std::vector<CellRect> cores = rects;
  const int rim = rimOf(mask);
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      if (!mask(x, y))
        continue;
      int nearest = rim + 1;
      std::size_t prism = 0;
      for (std::size_t r = 0; r < cores.size(); ++r) {
        const int cells = cellsBetween(cores[r], x, y);
        if (cells < nearest ||
            (cells == nearest && cores[r].area() > cores[prism].area())) {
          nearest = cells;
          prism = r;
        }
      }
      if (nearest > 0 && nearest <= rim)
        rects[prism] = boundingRect(rects[prism], {x, y, 1, 1});
    }
}

} // namespace

std::vector<CellRect> findRectangles(const CellMask& mask,
                                     const PrismOptions& options) {
  const int valid = mask.count();
  CellMask rest = mask;
  std::vector<CellRect> rects = takeRectangles(
      rest, std::max(options.min_rectangle, options.min_exclusive) * valid);
  const std::vector<CellRect> regions = takeRegions(
      withoutBorders(rest, rects), rects, std::max(1.0, options.min_exclusive * valid));
  rects.insert(rects.end(), regions.begin(), regions.end());
  takeFringe(mask, rects);
  return rects;
}

} // namespace pcl_sq

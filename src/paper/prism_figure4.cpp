// SPDX-License-Identifier: BSD-3-Clause
#include "paper/prism_search.h"

namespace pcl_sq {
namespace {

/** More prisms than this come from noise; merging them takes time with their
 * square. */
constexpr std::size_t MAX_FUSED = 256;

/** Length of the run of set cells from (x, y) on, to the right or downwards. */
int runRight(const CellMask& mask, int x, int y) {
  int length = 0;
  while (mask(x + length, y))
    ++length;
  return length;
}

int runDown(const CellMask& mask, int x, int y) {
  int length = 0;
  while (mask(x, y + length))
    ++length;
  return length;
}

CellRect growPrism(const CellMask& mask, int x, int y, PrismRun run) {
  const int width = runRight(mask, x, y);
  int height = runDown(mask, x, y);
  if (run != PrismRun::CROSS)
    for (int column = x + 1; column < x + width; ++column) {
      const int other = runDown(mask, column, y);
      height = run == PrismRun::MIN ? std::min(height, other) : std::max(height, other);
    }
  return {x, y, width, height};
}

bool isSeed(const CellMask& mask, int x, int y) {
  return mask(x, y) && !mask(x - 1, y) && !mask(x, y - 1);
}

/** Valid cells that only this prism covers, for each prism. */
std::vector<int> exclusiveCells(const CellMask& mask,
                                const std::vector<CellRect>& rects) {
  constexpr int NONE = -1, SEVERAL = -2;
  std::vector<int> owner(mask.cells.size(), NONE);
  for (std::size_t r = 0; r < rects.size(); ++r)
    for (int y = rects[r].y; y < rects[r].y + rects[r].height; ++y)
      for (int x = rects[r].x; x < rects[r].x + rects[r].width; ++x) {
        int& cell = owner[mask.indexOf(x, y)];
        cell = cell == NONE ? static_cast<int>(r) : SEVERAL;
      }
  std::vector<int> exclusive(rects.size(), 0);
  for (std::size_t c = 0; c < owner.size(); ++c)
    if (mask.cells[c] && owner[c] >= 0)
      ++exclusive[static_cast<std::size_t>(owner[c])];
  return exclusive;
}

} // namespace

// In the first pass prisms run through each other; in later ones they stay on cells
// that no earlier prism covers.
std::vector<CellRect> scanFigure4(const CellMask& mask, const PrismOptions& options) {
  std::vector<CellRect> rects;
  CellMask uncovered = mask;
  const int allowed = static_cast<int>(options.max_uncovered * mask.count());
  for (int pass = 1; options.max_passes == 0 || pass <= options.max_passes; ++pass) {
    if (uncovered.count() <= (pass == 1 ? 0 : allowed))
      break;
    const CellMask& seen = pass == 1 ? mask : uncovered;
    for (int y = 0; y < mask.height; ++y)
      for (int x = 0; x < mask.width; ++x)
        if (isSeed(seen, x, y)) {
          rects.push_back(growPrism(seen, x, y, options.run));
          clearCells(uncovered, rects.back());
        }
  }
  return rects;
}

void keepLargest(std::vector<CellRect>& rects) {
  if (rects.size() <= MAX_FUSED)
    return;
  std::stable_sort(rects.begin(), rects.end(), [](const auto& a, const auto& b) {
    return a.area() > b.area();
  });
  rects.resize(MAX_FUSED);
}

// The most alike pair first, again and again, so that a chain of slowly widening prisms
// does not collapse into one.
void mergePrisms(std::vector<CellRect>& rects, const PrismOptions& options) {
  for (;;) {
    double best = 0.0;
    std::size_t first = 0, second = 0;
    for (std::size_t a = 0; a < rects.size(); ++a)
      for (std::size_t b = a + 1; b < rects.size(); ++b) {
        const CellRect &p = rects[a], &q = rects[b];
        const double overlap = static_cast<double>(intersection(p, q).area()) /
                               std::min(p.area(), q.area());
        const double ratio = static_cast<double>(std::min(p.width, q.width)) /
                             std::max(p.width, q.width);
        if (overlap >= options.merge_overlap && ratio >= options.merge_width_ratio &&
            overlap * ratio > best) {
          best = overlap * ratio;
          first = a;
          second = b;
        }
      }
    if (best == 0.0)
      return;
    rects[first] = boundingRect(rects[first], rects[second]);
    rects.erase(rects.begin() + static_cast<std::ptrdiff_t>(second));
  }
}

// The least useful first, again and again: each prism that goes leaves its neighbours
// more cells of their own.
void dropPrisms(const CellMask& mask, std::vector<CellRect>& rects, double least) {
  while (rects.size() > 1) {
    const std::vector<int> exclusive = exclusiveCells(mask, rects);
    const auto worst = std::min_element(exclusive.begin(), exclusive.end());
    if (*worst >= least)
      return;
    rects.erase(rects.begin() + (worst - exclusive.begin()));
  }
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/prism.h"

#include <limits>
#include <numeric>

namespace pcl_sq {
namespace {

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

void clear(CellMask& mask, const CellRect& rect) {
  for (int y = rect.y; y < rect.y + rect.height; ++y)
    for (int x = rect.x; x < rect.x + rect.width; ++x)
      mask.set(x, y, false);
}

/** Fig. 4: in the first pass prisms run through each other, in later ones they stay on
 * cells that no earlier prism covers. */
std::vector<CellRect> scan(const CellMask& mask, const PrismOptions& options) {
  std::vector<CellRect> rects;
  CellMask uncovered = mask;
  const int allowed = static_cast<int>(options.max_uncovered * mask.count());
  for (int pass = 1; options.max_passes == 0 || pass <= options.max_passes; ++pass) {
    if (pass > 1 && uncovered.count() <= allowed)
      break;
    const std::size_t before = rects.size();
    const CellMask& seen = pass == 1 ? mask : uncovered;
    for (int y = 0; y < mask.height; ++y)
      for (int x = 0; x < mask.width; ++x)
        if (isSeed(seen, x, y)) {
          rects.push_back(growPrism(seen, x, y, options.run));
          clear(uncovered, rects.back());
        }
    if (rects.size() == before)
      break;
  }
  return rects;
}

/** Fuses the most alike pair again and again, so that a chain of slowly widening prisms
 * does not collapse into one. */
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

std::uint64_t pointsBehind(const CellMask& mask,
                           const CellRect& rect,
                           const std::vector<std::uint32_t>& points) {
  std::uint64_t sum = 0;
  for (int y = rect.y; y < rect.y + rect.height; ++y)
    for (int x = rect.x; x < rect.x + rect.width; ++x)
      sum += points[mask.indexOf(x, y)];
  return sum;
}

/** Drops the least useful prism again and again: each that goes leaves its neighbours
 * more cells of their own. */
void dropPrisms(const CellMask& mask,
                std::vector<CellRect>& rects,
                const PrismOptions& options,
                const std::vector<std::uint32_t>& points) {
  if (!points.empty())
    rects.erase(std::remove_if(rects.begin(),
                               rects.end(),
                               [&](const CellRect& rect) {
                                 return pointsBehind(mask, rect, points) <
                                        static_cast<std::uint64_t>(options.min_points);
                               }),
                rects.end());
  const double least = options.min_exclusive * mask.count();
  while (rects.size() > 1) {
    const std::vector<int> exclusive = exclusiveCells(mask, rects);
    const auto worst = std::min_element(exclusive.begin(), exclusive.end());
    if (*worst >= least)
      return;
    rects.erase(rects.begin() + (worst - exclusive.begin()));
  }
}

} // namespace

bool PrismOptions::isValid(std::string* why) const {
  const char* wrong = nullptr;
  if (max_passes < 0)
    wrong = "max_passes must not be negative";
  else if (!(max_uncovered >= 0.0 && max_uncovered <= 1.0))
    wrong = "max_uncovered must be in [0, 1]";
  else if (!(merge_overlap > 0.0 && merge_overlap <= 1.0))
    wrong = "merge_overlap must be in (0, 1]";
  else if (!(merge_width_ratio > 0.0 && merge_width_ratio <= 1.0))
    wrong = "merge_width_ratio must be in (0, 1]";
  else if (!(min_exclusive >= 0.0 && min_exclusive < 1.0))
    wrong = "min_exclusive must be in [0, 1)";
  else if (min_points < 0)
    wrong = "min_points must not be negative";
  if (wrong && why)
    *why = wrong;
  return !wrong;
}

std::vector<CellRect> scanPrisms(const CellMask& mask,
                                 const PrismOptions& options,
                                 const std::vector<std::uint32_t>& points) {
  if (!options.isValid())
    return {};
  std::vector<CellRect> rects = scan(mask, options);
  if (options.merge)
    mergePrisms(rects, options);
  dropPrisms(mask, rects, options, points);
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
    clear(uncovered, rect);
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
  starts_.push_back(0);
  for (int y = 0; y < layout.divisions[1]; ++y)
    for (int x = 0; x < layout.divisions[0]; ++x) {
      for (const std::uint32_t prism : order)
        if (prisms[prism].cells.contains(x, y)) {
          prisms_.push_back(prism);
          if (exclusive)
            break;
        }
      starts_.push_back(prisms_.size());
    }
}

} // namespace pcl_sq

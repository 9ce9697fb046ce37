// SPDX-License-Identifier: BSD-3-Clause
// Whether the pixels of a depth image err each by itself. Matching over windows makes
// neighbours err alike and fattens outlines; where errors are independent, no window
// was wider than a pixel and the outline is as sharp as the image.
#include "sensor/depth_patch.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int SIDE_BY_SIDE = 1, FAR_APART = 3;  ///< pixels apart
constexpr std::size_t FEWEST_DIFFERENCES = 200; ///< differences of each that tell
constexpr std::size_t WANTED = 20000;           ///< more tell nothing new
/** \brief Of independent errors both differences vary alike; where windows are three
 * pixels wide, each shares two thirds with the next, and the near ones have a third of
 * the far ones' variance. The middle, as a ratio of deviations. */
const double ALIKE = 0.5 * (1.0 + std::sqrt(1.0 / 3.0));

constexpr int WIDEST = 10;               ///< edge that is looked for [px]
constexpr std::size_t FEWEST_EDGES = 50; ///< places on an outline that tell
constexpr double JUMP = 0.02; ///< from an object to what is behind it, over the depth

double medianOf(std::vector<double>& values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace

bool errorsAreIndependent(const Observation& o, const TableModel& plane) {
  // on a plane the inverse depth is linear in the pixels: second differences are error
  const auto onTable = [&](int x, int y) {
    const int c = y * o.width + x;
    return o.finite(c) && !o.out.pixels(x, y) &&
           std::abs(plane.height(o.at(c))) <
               standingHeight(plane, double(o.points(2, c)));
  };
  const auto inverse = [&](int x, int y) {
    return 1.0 / double(o.points(2, y * o.width + x));
  };
  std::array<std::vector<double>, 2> off;
  const int step = std::max(1, int(std::sqrt(double(o.width) * o.height / WANTED)));
  for (int y = 0; y < o.height; y += step)
    for (int x = FAR_APART; x + FAR_APART < o.width; x += step) {
      bool all = true;
      for (const int d : {-FAR_APART, -SIDE_BY_SIDE, 0, SIDE_BY_SIDE, FAR_APART})
        all = all && onTable(x + d, y);
      if (!all)
        continue;
      const double middle = 2.0 * inverse(x, y);
      off[0].push_back(std::abs(inverse(x - SIDE_BY_SIDE, y) +
                                inverse(x + SIDE_BY_SIDE, y) - middle));
      off[1].push_back(
          std::abs(inverse(x - FAR_APART, y) + inverse(x + FAR_APART, y) - middle));
    }
  return off[0].size() >= FEWEST_DIFFERENCES &&
         medianOf(off[0]) > ALIKE * medianOf(off[1]);
}

double missingEdge(const Observation& o) {
  const CellMask& object = o.out.pixels;
  const CellRect box = boundingRect(object);
  std::vector<double> widths;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) {
      if (!object(x, y) || !o.finite(y * o.width + x))
        continue;
      const double own = double(o.points(2, y * o.width + x));
      for (const auto& [dx, dy] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        for (int k = 1; k <= WIDEST; ++k) {
          const int u = x + k * dx, v = y + k * dy;
          if (u < 0 || v < 0 || u >= o.width || v >= o.height || object(u, v))
            break;
          if (!o.finite(v * o.width + u))
            continue;
          if (double(o.points(2, v * o.width + u)) - own > JUMP * own)
            widths.push_back(double(k - 1));
          break;
        }
    }
  return widths.size() >= FEWEST_EDGES ? medianOf(widths) : 0.0;
}

} // namespace pcl_sq::detail

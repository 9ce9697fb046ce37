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

constexpr int NEAR = 1, FAR = 3;      ///< pixels apart
constexpr std::size_t FEWEST = 200;   ///< differences of each that tell
constexpr std::size_t WANTED = 20000; ///< more tell nothing new
/** \brief Of independent errors both differences vary alike; where windows are three
 * pixels wide, each shares two thirds with the next, and the near ones have a third of
 * the far ones' variance. The middle, as a ratio of deviations. */
const double ALIKE = 0.5 * (1.0 + std::sqrt(1.0 / 3.0));

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
    for (int x = FAR; x + FAR < o.width; x += step) {
      bool all = true;
      for (const int d : {-FAR, -NEAR, 0, NEAR, FAR})
        all = all && onTable(x + d, y);
      if (!all)
        continue;
      const double middle = 2.0 * inverse(x, y);
      off[0].push_back(std::abs(inverse(x - NEAR, y) + inverse(x + NEAR, y) - middle));
      off[1].push_back(std::abs(inverse(x - FAR, y) + inverse(x + FAR, y) - middle));
    }
  return off[0].size() >= FEWEST && medianOf(off[0]) > ALIKE * medianOf(off[1]);
}

} // namespace pcl_sq::detail

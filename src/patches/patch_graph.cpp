// SPDX-License-Identifier: BSD-3-Clause
#include "patches/patch_graph.h"

#include "sensor/observation.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int LEAST_BORDER = 3; ///< pairs of pixels that make a contact
constexpr double WIDE = 0.5;    ///< of a patch's width, where its surface goes on
constexpr double STANDS = 3.0;  ///< standing heights: lower, and it reaches the table
/** \brief Of a carrying thing's pixels, that show the face on which another stands, and
 * standing heights within which that is level. */
constexpr double LEDGE = 0.15, LEVEL = 2.0;
constexpr double AS_LARGE = 0.5; ///< over the carrying thing's pixels
constexpr double NEAR = 0.5;     ///< of the larger thing's size: belongs to it
/** \brief Of the larger footprint's radius, and of the larger width: a thing that is
 * set down anywhere on another is so near its axis once in sixteen times, and so nearly
 * as wide once in four. */
constexpr double IN_LINE = 0.25;

} // namespace

bool PatchGraph::stands(const Patch& p) const {
  return p.low < STANDS * standingHeight(view_.table, p.sums.mean().z());
}

bool PatchGraph::touches(const Border& border) {
  return border.pairs >= LEAST_BORDER && border.jumps < JUMPS * border.pairs;
}

void PatchGraph::join(int from, int into) {
  Patch& a = list_[std::size_t(into)];
  Patch& b = list_[std::size_t(from)];
  a.pixels.insert(a.pixels.end(), b.pixels.begin(), b.pixels.end());
  a.sums.add(b.sums);
  a.low = std::min(a.low, b.low);
  a.high = std::max(a.high, b.high);
  b.pixels.clear();
  std::map<std::pair<int, int>, Border> borders;
  for (const auto& [pair, border] : borders_) {
    const int i = pair.first == from ? into : pair.first;
    const int j = pair.second == from ? into : pair.second;
    if (i == j)
      continue;
    borders[std::minmax(i, j)].add(border);
  }
  borders_.swap(borders);
}

bool PatchGraph::sameColor(int a, int b, double limit) const {
  return colorDistance(list_[std::size_t(a)].sums, list_[std::size_t(b)].sums) < limit;
}

double PatchGraph::offset(int a, int b) const {
  const Footprint fa = footprintOf(view_.table, list_[std::size_t(a)]);
  const Footprint fb = footprintOf(view_.table, list_[std::size_t(b)]);
  return (fa.middle - fb.middle).norm() / std::max(fa.radius, fb.radius);
}

bool PatchGraph::isWide(std::pair<int, int> pair, int pixels) const {
  const std::size_t least = std::min(list_[std::size_t(pair.first)].pixels.size(),
                                     list_[std::size_t(pair.second)].pixels.size());
  return double(pixels) > WIDE * std::sqrt(double(least));
}

bool PatchGraph::isStep(std::pair<int, int> pair) const {
  const auto border = borders_.find(pair);
  return border != borders_.end() && !touches(border->second) &&
         isWide(pair, border->second.jumps);
}

double PatchGraph::flush(std::pair<int, int> pair) const {
  const auto found = borders_.find(pair);
  if (found == borders_.end())
    return 0.0;
  const Border& border = found->second;
  if (!touches(border) || !isWide(pair, border.pairs - border.jumps) ||
      border.meanFold() >= CREASE)
    return 0.0;
  return 2.0 * std::log(0.5 * M_PI / CREASE) * (border.pairs - border.jumps) /
         CORRELATION;
}

double PatchGraph::width(int a) const {
  const PieceSums& sums = list_[std::size_t(a)].sums;
  const Eigen::Vector3d middle = sums.mean();
  const Eigen::Vector3d across = middle.cross(view_.table.normal).normalized();
  return std::sqrt(across.dot(sums.square * across) / sums.count -
                   std::pow(across.dot(middle), 2));
}

bool PatchGraph::goesOnIn(int upper, int lower) const {
  const std::pair<int, int> pair = std::minmax(upper, lower);
  const auto border = borders_.find(pair);
  if (border == borders_.end() || !touches(border->second) ||
      !isWide(pair, border->second.pairs - border->second.jumps) ||
      border->second.meanFold() >= FOLD ||
      list_[std::size_t(lower)].low >= list_[std::size_t(upper)].low)
    return false;
  const double ratio = width(upper) / width(lower);
  return offset(upper, lower) < IN_LINE && std::min(ratio, 1.0 / ratio) > 1.0 - IN_LINE;
}

bool PatchGraph::mayShareRim(int a, int b) const {
  const auto border = borders_.find(std::minmax(a, b));
  if (border == borders_.end() || border->second.pairs < LEAST_BORDER ||
      touches(border->second))
    return false;
  const Patch& one = list_[std::size_t(a)];
  const Patch& other = list_[std::size_t(b)];
  const double z = std::max(one.sums.mean().z(), other.sums.mean().z());
  return (stands(one) || stands(other)) &&
         std::abs(one.high - other.high) < LEVEL * standingHeight(view_.table, z);
}

bool PatchGraph::isCarried(int a) const {
  const Patch& thing = list_[std::size_t(a)];
  if (thing.pixels.size() < SCRAP || isThin(thing.pixels, view_.width, view_.height))
    return false;
  const double slack = LEVEL * standingHeight(view_.table, thing.sums.mean().z());
  for (int b = 0; b < int(list_.size()); ++b) {
    const auto border = borders_.find(std::minmax(a, b));
    if (b == a || !alive(b) || border == borders_.end() || !touches(border->second) ||
        sameColor(a, b))
      continue;
    const std::vector<int>& pixels = list_[std::size_t(b)].pixels;
    const auto level = std::count_if(pixels.begin(), pixels.end(), [&](int c) {
      return std::abs(view_.table.height(view_.at(c)) - thing.low) < slack;
    });
    if (double(level) > std::max(double(SCRAP), LEDGE * double(pixels.size())) ||
        double(thing.pixels.size()) > AS_LARGE * double(pixels.size()))
      return true;
  }
  return false;
}

bool PatchGraph::isHiddenBelow(int a) const {
  const Patch& thing = list_[std::size_t(a)];
  for (const auto& [pair, border] : borders_) {
    if ((pair.first != a && pair.second != a) || touches(border) ||
        border.pairs < LEAST_BORDER || thing.pixels.size() < SCRAP)
      continue;
    const int b = pair.first == a ? pair.second : pair.first;
    const Patch& other = list_[std::size_t(b)];
    if (alive(b) && stands(other) && !sameColor(a, b) &&
        other.sums.mean().z() < thing.sums.mean().z())
      return true;
  }
  return false;
}

double PatchGraph::apart(int a, int b) const {
  const auto border = borders_.find(std::minmax(a, b));
  const double color =
      colorDistance(list_[std::size_t(a)].sums, list_[std::size_t(b)].sums);
  if (border != borders_.end() && touches(border->second))
    return 0.1 * color / double(border->second.pairs);
  const double gap = offset(a, b);
  if (color > SAME_COLOR || gap > 1.0 + NEAR)
    return 1e300;
  return 1.0 + gap + color;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "table/depth_regions.h"

#include "sensor/observation.h"
#include "util/voxel_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_sq::detail {

namespace {

constexpr int MIN_PIXELS = 100;
constexpr int MIN_PIECE = 10;  ///< pixels of a further piece of a thing
constexpr float REACH = 0.25F; ///< of a thing's size: between the depths of its pieces
constexpr double GAIN = 0.05;  ///< of the overlap, by a further piece
constexpr double MIN_OVERLAP = 0.3; ///< of a thing's box with the one drawn around it
constexpr double JUMP =
    0.025; ///< of the depth: neighbours further apart are two things

/** \brief Regions of pixels that are set, connected without a jump in depth. */
class Regions {
public:
  Regions(const CloudPoints& points, CellMask above)
      : points_(points), left_(std::move(above)) {}

  /** \brief The next region; empty when there is none left. */
  Region next() {
    Region region;
    while (at_ < left_.cells.size() && !left_.cells[at_])
      ++at_;
    if (at_ == left_.cells.size())
      return region;
    visit(static_cast<int>(at_), region);
    for (std::size_t i = 0; i < region.pixels.size(); ++i)
      grow(region.pixels[i], region);
    return region;
  }

private:
  void visit(int c, Region& region) {
    left_.cells[std::size_t(c)] = 0;
    region.pixels.push_back(c);
  }
  void grow(int c, Region& region) {
    const int x = c % left_.width, y = c / left_.width;
    region.sides |= int(x == 0) | int(y == 0) << 1 | int(x == left_.width - 1) << 2 |
                    int(y == left_.height - 1) << 3;
    const float depth = points_(2, c);
    // two pixels far, across missing ones
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) {
        if (!left_(x + dx, y + dy))
          continue;
        const int d = c + dy * left_.width + dx;
        if (std::abs(points_(2, d) - depth) < JUMP * std::abs(depth))
          visit(d, region);
      }
  }

  const CloudPoints& points_;
  CellMask left_;
  std::size_t at_ = 0;
};

CellRect boxOf(const std::vector<int>& pixels, int width) {
  CellRect box;
  int x1 = 0, y1 = 0;
  box.x = box.y = std::numeric_limits<int>::max();
  for (const int c : pixels) {
    box.x = std::min(box.x, c % width);
    box.y = std::min(box.y, c / width);
    x1 = std::max(x1, c % width + 1);
    y1 = std::max(y1, c / width + 1);
  }
  box.width = x1 - box.x;
  box.height = y1 - box.y;
  return box;
}

double overlap(const CellRect& a, const CellRect& b) {
  const double w = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const double h = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  const double both = std::max(0.0, w) * std::max(0.0, h);
  return both / (a.area() + b.area() - both);
}

/** \brief The value that a share of others does not exceed. */
double quantile(std::vector<double>& values, double share) {
  const auto place = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/** \brief Whether pixels float: a thing on a table is seen from its top down to its
 * foot or to what hides that, and not in its upper half alone. */
bool floats(const CloudPoints& points,
            const TableModel& table,
            const std::vector<int>& pixels) {
  constexpr double STRAYS = 0.05, LOWEST = 0.5;
  std::vector<double> heights, depths;
  for (const int c : pixels) {
    heights.push_back(table.height(points.col(c).cast<double>()));
    depths.push_back(double(points(2, c)));
  }
  // what is lower counts as the table
  const double lowest = standingHeight(table, quantile(depths, 0.5));
  const double high = quantile(heights, 1.0 - STRAYS);
  return quantile(heights, STRAYS) > lowest + LOWEST * high;
}

/** \brief Where a thing stands: the circle on the table that its width spans behind its
 * front. No other thing stands in it. */
class Footprint {
public:
  Footprint(const CloudPoints& points,
            const std::vector<int>& pixels,
            const TableModel& table)
      : points_(points), table_(table) {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int c : pixels)
      middle += points.col(c).cast<double>() / double(pixels.size());
    along_ = middle - table.normal * table.normal.dot(middle);
    along_.normalize(); // away from the camera
    across_ = table.normal.cross(along_);
    std::vector<double> across, along, height;
    for (const int c : pixels) {
      const Eigen::Vector3d p = points.col(c).cast<double>();
      across.push_back(across_.dot(p));
      along.push_back(along_.dot(p));
      height.push_back(table.height(p));
    }
    const double left = quantile(across, STRAY), right = quantile(across, 1.0 - STRAY);
    radius_ = 0.5 * (right - left);
    middle_ = {0.5 * (left + right), quantile(along, STRAY) + radius_};
    top_ = *std::max_element(height.begin(), height.end());
  }
  /** \brief Whether most of some pixels lie over it, and not above the thing. */
  bool holds(const std::vector<int>& pixels) const {
    std::size_t inside = 0;
    for (const int c : pixels) {
      const Eigen::Vector3d p = points_.col(c).cast<double>();
      const Eigen::Vector2d at(across_.dot(p), along_.dot(p));
      inside += (at - middle_).norm() <= (1.0 + MARGIN) * radius_ &&
                table_.height(p) <= top_ + MARGIN * radius_;
    }
    return double(inside) >= MOST * double(pixels.size());
  }

private:
  static constexpr double STRAY = 0.01; ///< of pixels
  static constexpr double MARGIN = 0.1; ///< over the radius: few things are round
  static constexpr double MOST = 0.8;   ///< of a piece's pixels

  const CloudPoints& points_;
  const TableModel& table_;
  Eigen::Vector3d along_, across_;
  Eigen::Vector2d middle_; ///< across, along
  double radius_ = 0.0, top_ = 0.0;
};

/** \brief Adds to a thing the pieces of it behind its own rim, such as a cup's inside:
 * above no more than itself in the image; in space they hang together with it, or stand
 * where it stands. */
void addPieces(const std::vector<Region>& all,
               const CloudPoints& points,
               int width,
               const TableModel& table,
               Region& thing) {
  const CellRect box = boxOf(thing.pixels, width);
  const int beside = std::max(2, box.width / 10); // rims are wider than what they crown
  std::vector<int> columns = thing.pixels;
  std::vector<const Region*> pieces;
  for (const Region& r : all) {
    const CellRect at = boxOf(r.pixels, width);
    if (r.cut() || at.x < box.x - beside ||
        at.x + at.width > box.x + box.width + beside || at == box)
      continue;
    pieces.push_back(&r);
    columns.insert(columns.end(), r.pixels.begin(), r.pixels.end());
  }
  if (pieces.empty())
    return;
  double depth = 0.0;
  for (const int c : thing.pixels)
    depth += double(points(2, c)) / double(thing.pixels.size());
  // cells that touch are up to twice their side apart
  std::vector<int> cluster_of(std::size_t(points.cols()), -1);
  int number = 0;
  for (const std::vector<int>& cluster :
       clustersOf(points, columns, 0.5 * JUMP * depth)) {
    for (const int c : cluster)
      cluster_of[std::size_t(c)] = number;
    ++number;
  }
  std::vector<std::size_t> own(std::size_t(number), 0);
  for (const int c : thing.pixels)
    ++own[std::size_t(cluster_of[std::size_t(c)])];
  const auto main = std::max_element(own.begin(), own.end()) - own.begin();
  const Footprint footprint(points, thing.pixels, table);
  for (const Region* r : pieces)
    if (cluster_of[std::size_t(r->pixels[r->pixels.size() / 2])] == main ||
        footprint.holds(r->pixels))
      thing.pixels.insert(thing.pixels.end(), r->pixels.begin(), r->pixels.end());
}

struct DepthRange {
  float near = std::numeric_limits<float>::max(), far = 0.0F;
};

DepthRange depthsOf(const std::vector<int>& pixels, const CloudPoints& points) {
  DepthRange range;
  for (const int c : pixels) {
    range.near = std::min(range.near, points(2, c));
    range.far = std::max(range.far, points(2, c));
  }
  return range;
}

} // namespace

std::vector<Region> regionsOf(const CloudPoints& points, const CellMask& above) {
  Regions regions(points, above);
  std::vector<Region> all;
  for (Region r = regions.next(); !r.pixels.empty(); r = regions.next())
    if (r.pixels.size() >= std::size_t(MIN_PIECE))
      all.push_back(std::move(r));
  return all;
}

Region largestThing(const CloudPoints& points,
                    const CellMask& above,
                    const TableModel& table) {
  const std::vector<Region> all = regionsOf(points, above);
  Region best;
  for (const Region& r : all) {
    const bool better = r.cut() == best.cut() ? r.pixels.size() > best.pixels.size()
                                              : best.cut() || best.pixels.empty();
    if (r.pixels.size() >= std::size_t(MIN_PIXELS) && r.cutOnce() && better &&
        !floats(points, table, r.pixels))
      best = r;
  }
  if (!best.pixels.empty())
    addPieces(all, points, above.width, table, best);
  return best;
}

std::vector<int> thingOfBox(const CloudPoints& points,
                            const CellMask& above,
                            const CellRect& box,
                            float size) {
  const int width = above.width;
  std::vector<Region> all = regionsOf(points, above);
  std::vector<int> thing;
  double fit = MIN_OVERLAP;
  const auto merged = [&](const Region& r) {
    std::vector<int> both = thing;
    both.insert(both.end(), r.pixels.begin(), r.pixels.end());
    return both;
  };
  for (bool first = true; true; first = false) {
    auto best = all.end();
    double least = fit + (first ? 0.0 : GAIN);
    const DepthRange own = depthsOf(thing, points);
    const float reach = REACH * 0.5F * (own.near + own.far) * size;
    for (auto r = all.begin(); r != all.end(); ++r) {
      const DepthRange depths = depthsOf(r->pixels, points);
      const bool beside =
          first || (depths.near < own.far + reach && depths.far > own.near - reach);
      const double o = overlap(boxOf(merged(*r), width), box);
      if (beside && o > least &&
          (!first || r->pixels.size() >= std::size_t(MIN_PIXELS))) {
        least = o;
        best = r;
      }
    }
    if (best == all.end())
      break;
    fit = least;
    thing = merged(*best);
    all.erase(best);
  }
  if (thing.empty())
    return thing;
  const DepthRange own = depthsOf(thing, points);
  for (const Region& r : all) {
    const CellRect at = boxOf(r.pixels, width);
    const bool whole = at.x > box.x && at.y > box.y &&
                       at.x + at.width < box.x + box.width &&
                       at.y + at.height < box.y + box.height;
    const DepthRange depths = depthsOf(r.pixels, points);
    if (whole && depths.near >= own.near && depths.far <= own.far)
      thing.insert(thing.end(), r.pixels.begin(), r.pixels.end());
  }
  return thing;
}

} // namespace pcl_sq::detail

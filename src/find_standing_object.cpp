// SPDX-License-Identifier: BSD-3-Clause
#include "observe_parts.h"
#include "table_search.h"

#include <cmath>
#include <limits>

namespace pcl_sq {

namespace {

constexpr int MIN_PIXELS = 100;
constexpr int MIN_PIECE = 10;  ///< pixels of a further piece of a thing
constexpr float REACH = 0.25F; ///< of a thing's size: between the depths of its pieces
constexpr double GAIN = 0.05;  ///< of the overlap, by a further piece
constexpr double MIN_OVERLAP = 0.3; ///< of a thing's box with the one drawn around it
constexpr double JUMP =
    0.025; ///< of the depth: neighbours further apart are two things
constexpr std::size_t VOTERS = 6000; ///< points in which the table is looked for

struct Region {
  std::vector<int> pixels;
  int sides = 0; ///< of the image that cut it, one bit each
  bool cut() const { return sides != 0; }
  /** \brief Cut by one side, as things are at whose edge a picture ends; what goes from
   * side to side is a wall or a floor. */
  bool cutOnce() const { return (sides & (sides - 1)) == 0; }
};

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

/** \brief The largest region that the image border does not cut; if there is none, the
 * largest that but one of its sides cuts. */
Region largest(Regions regions) {
  Region best;
  for (Region r = regions.next(); !r.pixels.empty(); r = regions.next()) {
    const bool better = r.cut() == best.cut() ? r.pixels.size() > best.pixels.size()
                                              : best.cut() || best.pixels.empty();
    if (r.pixels.size() >= std::size_t(MIN_PIXELS) && r.cutOnce() && better)
      best = std::move(r);
  }
  return best;
}

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

/** \brief The pixels of the thing whose box is the given one. It may be in pieces: a
 * bowl's wall and its inside, a handle beyond its own shadow. A piece belongs to it
 * where it lies at its depth, and the box does not cut it or it makes the whole fit the
 * box better. */
std::vector<int> fitting(Regions regions,
                         const CloudPoints& points,
                         const CellRect& box,
                         int width,
                         float size) {
  std::vector<Region> all;
  for (Region r = regions.next(); !r.pixels.empty(); r = regions.next())
    if (r.pixels.size() >= std::size_t(MIN_PIECE))
      all.push_back(std::move(r));
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

/** \brief Pixels that lie above a table, among all or some. */
CellMask pixelsAbove(const TableModel& table,
                     const CloudPoints& points,
                     int width,
                     int height,
                     const std::vector<int>* within) {
  CellMask above(width, height);
  const auto look = [&](std::size_t i) {
    const Eigen::Vector3f p = points.col(Eigen::Index(i));
    const auto standing =
        static_cast<float>(detail::standingHeight(table, double(p.z())));
    above.cells[i] = table.normal.cast<float>().dot(p) + float(table.offset) > standing;
  };
  if (within)
    for (const int c : *within)
      look(std::size_t(c));
  else
    for (std::size_t i = 0; i < above.cells.size(); ++i)
      look(i);
  return above;
}

} // namespace

bool findStandingObject(const CloudPoints& points,
                        int width,
                        int height,
                        std::optional<TableModel>& table,
                        CellMask& object) {
  ViewOptions view;
  view.table = table;
  const detail::Standing found = detail::findInImage(points, width, height, view);
  object = CellMask(width, height);
  for (const int c : found.thing)
    object.cells[std::size_t(c)] = 1;
  if (!found.thing.empty())
    table = found.table;
  return !found.thing.empty();
}

namespace detail {

Standing findInImage(const CloudPoints& points,
                     int width,
                     int height,
                     const ViewOptions& view,
                     const CellMask* region,
                     float size) {
  TableSearch search;
  const auto total = static_cast<std::size_t>(points.cols());
  double depth = 0.0;
  for (std::size_t i = 0; i < total; i += evenStep(total, width, VOTERS))
    if (points.col(Eigen::Index(i)).allFinite()) {
      search.voters.push_back(points.col(Eigen::Index(i)).cast<double>());
      depth += search.voters.back().z();
    }
  if (search.voters.size() < 100)
    return {};
  depth = std::abs(depth) / double(search.voters.size());
  search.points_a_voter = double(evenStep(total, width, VOTERS));
  search.distance = 0.008 * depth;
  search.viewpoint = Eigen::Vector3d::Zero();
  search.up = view.up;
  search.table = view.table;
  search.nested = !region; // a box names the thing
  search.at = [&points](int c) {
    return Eigen::Vector3d(points.col(c).cast<double>());
  };
  std::vector<int> inside;
  CellRect box;
  if (region) {
    box = boundingRect(*region);
    for (std::size_t i = 0; i < region->cells.size(); ++i)
      if (region->cells[i])
        inside.push_back(int(i));
  }
  search.choose = [&](const TableModel& table, const std::vector<int>* within) {
    Standing found;
    found.table = table;
    Regions regions(
        points, pixelsAbove(table, points, width, height, region ? &inside : within));
    if (region)
      found.thing = fitting(std::move(regions), points, box, width, size);
    else {
      Region best = largest(std::move(regions));
      found.thing = std::move(best.pixels);
      found.cut = best.cut();
    }
    return found;
  };
  return search.run();
}

Standing findInRegion(const Observation& o, const CellMask& region) {
  const CellRect box = boundingRect(region);
  const auto size = static_cast<float>(
      std::sqrt(box.area() / (o.out.camera.fx * o.out.camera.fy))); // over the depth
  return findInImage(o.points, o.width, o.height, o.view, &region, size);
}

} // namespace detail

} // namespace pcl_sq

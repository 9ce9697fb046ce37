// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_table.h"

#include "table/depth_regions.h"
#include "table/table_search.h"
#include "util/outer_points.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int PLANES = 6;          ///< among which the table is
constexpr int COLUMNS = 160;       ///< of the thinned image in which planes are judged
constexpr double DISTANCE = 0.008; ///< of the depth: of a plane's points to it, at most
constexpr double PART_OF_IT = 0.1; ///< of a table's largest piece: another one
constexpr double BEYOND = 0.5;     ///< of the image, by which a table goes on
constexpr PlaneDemand DEMAND = {0.1, 4600}; ///< see table_search.cpp
const double LEVEL = std::sqrt(0.5);        ///< see table_search.cpp
constexpr double MORE_UPRIGHT = 0.5;        ///< the same
constexpr double PARALLEL = 0.95;           ///< cosine of two levels' normals
constexpr double MOSTLY = 0.5;  ///< of a thing's pixels that are its top: a table's
constexpr double SMALL = 0.125; ///< of that top: the largest thing on it
constexpr double SCRAP = 0.01;  ///< of that top: what may be an error
constexpr double LARGE = 0.1;   ///< of the floor's pixels, at least that top's

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/** \brief Convex hull, counter-clockwise (Andrew's monotone chain). */
std::vector<Eigen::Vector2d> hullOf(std::vector<Eigen::Vector2d> points) {
  keepOuter(points, [](const Eigen::Vector2d& p) { return p; });
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  std::vector<Eigen::Vector2d> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Eigen::Vector2d& p : points) {
      while (hull.size() >= first + 2 &&
             cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(p);
    }
    if (!hull.empty())
      hull.pop_back(); // the other side begins with it
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/** \brief An organized cloud with fewer rows and columns. */
struct Thinned {
  Eigen::Matrix3Xf points;
  int width, height;
  PinholeCamera camera;

  Thinned(const CloudPoints& all, int w, int h, const PinholeCamera& of) : camera(of) {
    const int step = std::max(1, w / COLUMNS);
    width = (w + step - 1) / step;
    height = (h + step - 1) / step;
    points.resize(3, Eigen::Index(width) * height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        points.col(Eigen::Index(y) * width + x) =
            all.col(Eigen::Index(y) * step * w + Eigen::Index(x) * step);
    camera.fx /= step;
    camera.fy /= step;
    camera.cx /= step;
    camera.cy /= step;
  }
};

/** \brief A plane and what stands on it. */
struct Level {
  TableModel plane;
  double upright = 0.0;
  int pixels = 0;            ///< of the plane
  std::vector<Region> whole; ///< things that the image does not cut
  std::size_t standing = 0;  ///< their pixels
  std::size_t cut = 0;       ///< those of what the image cuts
};

Level judge(const TableModel& plane, const Thinned& image) {
  Level level;
  level.plane = plane;
  const CloudPoints points(image.points);
  const TableArea area(plane, points, image.width, image.height, image.camera);
  level.pixels = area.pixels();
  if (area.empty())
    return level;
  CellMask over = pixelsAbove(plane, points, image.width, image.height);
  for (std::size_t i = 0; i < over.cells.size(); ++i)
    if (over.cells[i])
      over.cells[i] = area.isOver(points.col(Eigen::Index(i)).cast<double>());
  for (Region& region : regionsOf(points, over)) {
    if (!region.cut()) {
      level.standing += region.pixels.size();
      level.whole.push_back(std::move(region));
    } else
      level.cut += region.pixels.size();
  }
  return level;
}

/** \brief Whether one plane is the table before a wall that the other is: nearer to
 * what is square to that than to the wall itself. */
bool isBefore(const Level& table, const Level& wall) {
  const double square = std::sqrt(std::max(0.0, 1.0 - wall.upright * wall.upright));
  return table.upright > wall.upright + MORE_UPRIGHT &&
         table.upright > 0.5 * (wall.upright + square);
}

/** \brief Whether a level is the top of a table that stands on another level. */
bool isTableOn(const Level& top, const Level& floor, const Thinned& image) {
  if (top.whole.empty() || top.plane.normal.dot(floor.plane.normal) < PARALLEL)
    return false;
  for (const Region& thing : floor.whole) {
    std::size_t on_top = 0;
    for (const int c : thing.pixels)
      on_top += std::abs(top.plane.height(image.points.col(c).cast<double>())) <=
                DISTANCE * double(image.points(2, c));
    if (double(on_top) < MOSTLY * double(thing.pixels.size()) ||
        double(on_top) < LARGE * double(floor.pixels))
      continue;
    std::size_t largest = 0;
    int count = 0;
    for (const Region& upper : top.whole) {
      largest = std::max(largest, upper.pixels.size());
      count += double(upper.pixels.size()) > SCRAP * double(on_top);
    }
    return count > 1 || double(largest) < SMALL * double(on_top);
  }
  return false;
}

} // namespace

TableArea::TableArea(const TableModel& table,
                     const CloudPoints& points,
                     int width,
                     int height,
                     const PinholeCamera& camera)
    : u_(table.normal.unitOrthogonal()), v_(table.normal.cross(u_)) {
  CellMask level(width, height);
  for (std::size_t i = 0; i < level.cells.size(); ++i) {
    const Eigen::Vector3d p = points.col(Eigen::Index(i)).cast<double>();
    level.cells[i] = std::abs(table.height(p)) <= standingHeight(table, p.z());
  }
  std::vector<Region> pieces = regionsOf(points, level);
  std::size_t largest = 0;
  for (const Region& piece : pieces)
    largest = std::max(largest, piece.pixels.size());
  std::vector<Eigen::Vector2d> places;
  for (const Region& piece : pieces) {
    if (double(piece.pixels.size()) < PART_OF_IT * double(largest))
      continue;
    pixels_ += int(piece.pixels.size());
    for (const int c : piece.pixels) {
      const int x = c % width, y = c / width;
      places.push_back(onPlane(points.col(c).cast<double>()));
      Eigen::Vector2d beyond{double(x), double(y)};
      if (x == 0 || x == width - 1)
        beyond.x() += (x == 0 ? -BEYOND : BEYOND) * width;
      if (y == 0 || y == height - 1)
        beyond.y() += (y == 0 ? -BEYOND : BEYOND) * height;
      if (beyond.x() == double(x) && beyond.y() == double(y))
        continue;
      const Eigen::Vector3d ray = camera.ray(beyond);
      const double towards = -table.normal.dot(ray);
      if (towards > 0.0)
        places.push_back(onPlane(table.offset / towards * ray));
    }
  }
  hull_ = hullOf(std::move(places));
}

bool TableArea::isOver(const Eigen::Vector3d& point) const {
  const Eigen::Vector2d at = onPlane(point);
  for (std::size_t i = 0; i < hull_.size(); ++i)
    if (cross(hull_[(i + 1) % hull_.size()] - hull_[i], at - hull_[i]) < 0.0)
      return false;
  return true;
}

SceneTable findSceneTable(const CloudPoints& points,
                          int width,
                          int height,
                          const PinholeCamera& camera,
                          const std::optional<Eigen::Vector3d>& up) {
  const Thinned image(points, width, height, camera);
  std::vector<Eigen::Vector3d> rest;
  std::vector<double> depths;
  for (Eigen::Index i = 0; i < image.points.cols(); ++i)
    if (image.points.col(i).allFinite()) {
      rest.push_back(image.points.col(i).cast<double>());
      depths.push_back(rest.back().z());
    }
  SceneTable result;
  if (rest.empty())
    return result;
  const auto middle = depths.begin() + std::ptrdiff_t(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  const double distance = DISTANCE * *middle;
  std::vector<Level> levels;
  for (int k = 0; k < PLANES; ++k) {
    TableModel plane;
    if (!findPlane(rest, distance, DEMAND, plane))
      break;
    if (plane.offset < 0.0)
      plane = flipped(plane);
    ++result.planes;
    const Eigen::Vector3d upward = up ? up->normalized() : -Eigen::Vector3d::UnitY();
    if (!up || plane.normal.dot(upward) > LEVEL) {
      levels.push_back(judge(plane, image));
      levels.back().upright = plane.normal.dot(upward);
    }
    const double clear = std::max(2.0 * distance, 6.0 * plane.noise);
    rest.erase(std::remove_if(rest.begin(),
                              rest.end(),
                              [&](const Eigen::Vector3d& p) {
                                return std::abs(plane.height(p)) <= clear;
                              }),
               rest.end());
  }
  const bool any_whole = std::any_of(
      levels.begin(), levels.end(), [](const Level& l) { return l.standing > 0; });
  const auto standing = [any_whole](const Level& l) {
    return double(any_whole ? l.standing : l.cut);
  };
  const auto use = [&](const Level& l) { return standing(l) * double(l.pixels); };
  const Level* best = nullptr; // the largest, unless another is clearly more upright
  for (const Level& level : levels)
    if (standing(level) > 0.0 && (!best || isBefore(level, *best)))
      best = &level;
  // a table and its floor are parallel: what stands on each tells which is which
  for (const Level& level : levels)
    if (best && use(level) > use(*best) &&
        level.plane.normal.dot(best->plane.normal) > PARALLEL)
      best = &level;
  for (const Level& level : levels)
    if (best && &level != best && isTableOn(level, *best, image))
      best = &level;
  if (best)
    result.table = best->plane;
  return result;
}

} // namespace pcl_sq::detail

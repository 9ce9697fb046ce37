// SPDX-License-Identifier: BSD-3-Clause
// The table under an object: a plane around it in its image that it can stand on,
// checked against its points.
#include "observe/observe_parts.h"
#include "table/table_search.h"
#include "tuning/observe_tuning.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::observe_table;
/** \brief A plane with a smaller share of what is left is found with as many trials as
 * make a miss unlikely: (1 - share^3)^n = 1 %. */
constexpr PlaneDemand SMALLER = {0.1, 4600};
constexpr double PARAMETERS = 3.0; ///< of a plane: as many independent points fit any

/** \brief Where a plane is, as seen from the object. */
enum class TableRelation { UNDER, ABOVE, FAR };

double quantile(std::vector<double> values, double share) {
  const auto place = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/** \brief Largest height at which the lowest visible points of what stands on a table
 * may be; bottoms are no rounder than a ball's. Seen from an angle a above the table,
 * the lowest point on a ball's limb is r (1 - cos a) high; a width d in the image
 * beside the limb is left out, whose inner edge lies sqrt(2 r d) nearer to the camera;
 * and a fiftieth of the disc's area at its lower edge is r / 10 high. */
double reachOf(const TableModel& table, const ObservedObject& observed) {
  const PinholeCamera& camera = observed.camera;
  const Eigen::Vector3d ray =
      (observed.points.rowwise().mean() - camera.center).normalized();
  const double sine = std::abs(table.normal.dot(ray));
  const double cosine = std::sqrt(std::max(0.0, 1.0 - sine * sine));
  const double r = observed.extent;
  const double d = RIM * observed.depth / std::sqrt(camera.fx * camera.fy);
  return r * (1.0 - cosine + FIFTIETH) + d * cosine + std::sqrt(2.0 * r * d) * sine +
         3.0 * std::hypot(table.sigma, table.noise);
}

/** \param[in] lowest, highest where most of the object, and its lowest points, may be
 */
TableRelation relationTo(const TableModel& table,
                         const ObservedObject& observed,
                         double lowest,
                         double highest) {
  std::vector<double> heights;
  for (Eigen::Index i = 0; i < observed.points.cols(); ++i)
    heights.push_back(table.height(observed.points.col(i)));
  if (quantile(heights, 0.2) < lowest)
    return TableRelation::ABOVE;
  return quantile(heights, 0.02) > highest ? TableRelation::FAR : TableRelation::UNDER;
}

/** \brief A point beside the object. */
struct Beside {
  Eigen::Vector3d point;
  Eigen::Vector2d pixel;
};

/** \brief Points around the object, and how they err. */
struct Surroundings {
  std::vector<Beside> points;
  double distance = 0.0; ///< of a plane's points to it, at most [m]
  double apart = 1.0;    ///< pixels between two of them
};

Surroundings lookAround(const Observation& o, const CellRect& box) {
  Surroundings s;
  const int margin = std::max(20, (box.width + box.height - 2) / 3);
  const int x0 = std::max(0, box.x - margin),
            x1 = std::min(o.width - 1, box.x + box.width - 1 + margin);
  const int y0 = std::max(0, box.y - margin / 3);
  const int y1 = std::min(o.height - 1, box.y + box.height - 1 + margin);
  const int step = std::max(
      1, static_cast<int>(std::sqrt(double(x1 - x0 + 1) * (y1 - y0 + 1) / 6000.0)));
  s.apart = step;
  std::vector<double> noise;
  for (int y = y0; y <= y1; y += step)
    for (int x = x0; x <= x1; x += step) {
      const int c = y * o.width + x;
      bool near = false; // the rim has the object's depth
      for (int d = -4; d <= 4 && !near; d += 2)
        near = o.out.pixels(x + d, y) || o.out.pixels(x, y + d);
      if (near || !o.finite(c))
        continue;
      s.points.push_back({o.at(c), Eigen::Vector2d(x, y)});
      if (o.view.noise.size() > 0)
        noise.push_back(double(o.view.noise[c]));
    }
  s.distance = noise.empty() ? NOISE * o.out.depth : 3.0 * quantile(noise, 0.5);
  return s;
}

/** \brief Whether a plane may be a table by its slope alone. */
bool mayBeLevel(const Observation& o, const TableModel& plane) {
  const Eigen::Vector3d normal = o.out.camera.rotation.transpose() * plane.normal;
  if (o.view.up)
    return plane.normal.dot(o.view.up->normalized()) > std::sqrt(0.5);
  return -normal.y() > std::max(UPRIGHT, std::abs(normal.x())) ||
         -normal.z() > FROM_ABOVE;
}

/** \brief An object's footprint on a plane: its points dropped to it, by direction. */
class Footprint {
public:
  static constexpr std::size_t SECTORS = 16;

  Footprint(const ObservedObject& out, const TableModel& plane)
      : u_(plane.normal.unitOrthogonal()), v_(plane.normal.cross(u_)) {
    const Eigen::Vector3d middle = out.points.rowwise().mean();
    centre = middle - plane.height(middle) * plane.normal;
    for (Eigen::Index i = 0; i < out.points.cols(); ++i) {
      const auto [sector, distance] = place(out.points.col(i));
      radius_[sector] = std::max(radius_[sector], distance);
    }
  }
  /** \brief Sector of a point of the plane, and how far it lies beyond the footprint.
   */
  std::pair<std::size_t, double> beyond(const Eigen::Vector3d& p) const {
    const auto [sector, distance] = place(p);
    return {sector, distance - radius_[sector]};
  }

  Eigen::Vector3d centre;

private:
  std::pair<std::size_t, double> place(const Eigen::Vector3d& p) const {
    const double x = u_.dot(p - centre), y = v_.dot(p - centre);
    const double turn = 0.5 + std::atan2(y, x) / (2.0 * M_PI);
    return {std::min(SECTORS - 1, std::size_t(turn * SECTORS)), std::hypot(x, y)};
  }
  Eigen::Vector3d u_, v_;
  std::array<double, SECTORS> radius_ = {};
};

/** \brief The points around the object's foot on a plane below it; none where the plane
 * does not go on around the foot, or where it is seen through beside it. A table may
 * end anywhere farther away, and other things may stand on it. */
std::vector<Eigen::Vector3d>
supportOf(const Observation& o, const Surroundings& around, const TableModel& plane) {
  const ObservedObject& out = o.out;
  const Footprint footprint(out, plane);
  const Eigen::Vector2d seen_foot = out.camera.project(footprint.centre);
  std::array<std::size_t, 4> sides = {0, 0, 0, 0}; // left, right, above, below
  struct Sector {
    std::size_t on = 0, through = 0;
  };
  std::array<Sector, Footprint::SECTORS> beside;
  std::vector<Eigen::Vector3d> on;
  for (const Beside& b : around.points) {
    const Eigen::Vector3d ray = out.camera.ray(b.pixel);
    const double towards = plane.normal.dot(ray);
    if (!(towards < 0.0))
      continue;
    const double there = -plane.height(out.camera.center) / towards;
    const auto [sector, beyond] = footprint.beyond(out.camera.center + there * ray);
    const double height = plane.height(b.point);
    const bool is_on = std::abs(height) <= around.distance;
    if (beyond > 2.0 * out.extent || (!is_on && height > 0.0))
      continue;
    if (is_on) {
      on.push_back(b.point);
      const Eigen::Vector2d d = b.pixel - seen_foot;
      ++sides[std::abs(d.x()) > std::abs(d.y()) ? (d.x() < 0.0 ? 0 : 1)
                                                : (d.y() < 0.0 ? 2 : 3)];
    }
    if (beyond < tuning::observe_table::BESIDE * out.extent)
      ++(is_on ? beside[sector].on : beside[sector].through);
  }
  std::size_t carried = 0, open = 0;
  for (const Sector& s : beside)
    if (s.on + s.through >= FEWEST_OF_SECTOR)
      ++(s.on > s.through ? carried : open);
  const auto told = std::count_if(sides.begin(), sides.end(), [](auto n) {
    return n >= tuning::observe_table::FEWEST;
  });
  const Eigen::Vector3d normal = out.camera.rotation.transpose() * plane.normal;
  const bool from_above = -normal.y() <= UPRIGHT && !o.view.up;
  if (told < (from_above ? 4 : 2))
    return {};
  if (double(carried) < CARRIED * double(carried + open))
    return {};
  return on;
}

/** \brief The plane of most of the points near one: what else lies near it, a step or
 * a cloth, is left out.
 * \param[in] noise of a point [m] */
void settle(const std::vector<Eigen::Vector3d>& points,
            double noise,
            TableModel& plane) {
  TableModel largest;
  if (findPlane(points, noise, {}, largest))
    plane = largest.normal.dot(plane.normal) < 0.0 ? flipped(largest) : largest;
  for (int round = 0; round < tuning::observe_table::ROUNDS; ++round) {
    std::vector<double> off;
    for (const Eigen::Vector3d& p : points)
      off.push_back(std::abs(plane.height(p)));
    TableModel next = plane;
    if (!refitPlane(points, SIGMAS * 1.4826 * quantile(off, 0.5), next))
      return;
    plane = next.normal.dot(plane.normal) < 0.0 ? flipped(next) : next;
  }
}

} // namespace

void findTable(Observation& o, const CellRect& box) {
  const Surroundings around = lookAround(o, box);
  std::vector<Eigen::Vector3d> rest;
  for (const Beside& b : around.points)
    rest.push_back(b.point);
  std::size_t best = 0;
  // until what is left could not hold more than the best one does
  for (int attempt = 0; attempt < PLANES && rest.size() > best; ++attempt) {
    TableModel plane;
    if (!findPlane(rest, around.distance, {}, plane) &&
        !findPlane(rest, around.distance, SMALLER, plane))
      break;
    if (plane.height(o.out.camera.center) < 0.0)
      plane = flipped(plane);
    std::vector<Eigen::Vector3d> left;
    for (const Eigen::Vector3d& p : rest)
      if (std::abs(plane.height(p)) > 2.0 * around.distance)
        left.push_back(p);
    // neighbours share their errors
    const double independent =
        double(rest.size() - left.size()) *
        std::min(1.0, std::pow(around.apart / o.view.correlation, 2));
    const auto sigmaOf = [&](const TableModel& of) {
      return std::max(3.0 * of.noise / std::sqrt(std::max(1.0, independent)),
                      0.1 * of.noise);
    };
    plane.sigma = sigmaOf(plane);
    rest.swap(left);
    const double lowest = -std::hypot(plane.sigma, around.distance / 3.0);
    if (independent < PARAMETERS || !mayBeLevel(o, plane) ||
        relationTo(plane, o.out, lowest, reachOf(plane, o.out)) != TableRelation::UNDER)
      continue;
    const std::vector<Eigen::Vector3d> support = supportOf(o, around, plane);
    if (support.size() > best) {
      best = support.size();
      settle(support, around.distance / 3.0, plane);
      plane.sigma = sigmaOf(plane);
      o.out.table = plane;
    }
  }
  if (!o.out.table)
    o.out.notes.push_back("no table was found under the object, so its lower end is "
                          "where its points end; give the table if there is one");
}

void checkTable(ObservedObject& observed) {
  if (!observed.table || observed.points.cols() == 0)
    return;
  const double lowest = -5.0 * observed.table->sigma - 0.1 * observed.extent;
  const TableRelation relation =
      relationTo(*observed.table, observed, lowest, observed.extent);
  if (relation == TableRelation::ABOVE)
    observed.notes.push_back(
        "the object lies below the table plane, which is left out; check the table and "
        "its sign");
  else if (relation == TableRelation::FAR && !observed.hidden_below)
    observed.notes.push_back(
        "the object does not stand on the table plane, which is left out; check the "
        "table");
  else
    return;
  observed.table.reset();
}

} // namespace pcl_sq::detail

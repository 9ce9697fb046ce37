// SPDX-License-Identifier: BSD-3-Clause
// Distances to bodies with a rim, by the outline of half a section.
#include "geometry/open_body.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int STEPS = 40;           ///< of a meridian's curve
constexpr int REFINEMENTS = 3;      ///< of the nearest chord
constexpr double SHORTER = 0.25;    ///< half of a refined chord, over the last one's
constexpr int FAR_REFINEMENTS = 7;  ///< for places farther than a chord is long: the
constexpr double FAR_SHORTER = 0.5; ///< curve turns their foot away from the chord's
constexpr double STRAIGHT = 1e-5;   ///< of the body's size that a chord may miss

/** \brief Where the line through two points comes nearest to a third: 0 at the first, 1
 * at the second. */
double footOnLine(const Eigen::Vector2d& p,
                  const Eigen::Vector2d& a,
                  const Eigen::Vector2d& b) {
  const Eigen::Vector2d side = b - a;
  return (p - a).dot(side) / std::max(side.squaredNorm(), 1e-300);
}

double toSegment(const Eigen::Vector2d& p,
                 const Eigen::Vector2d& a,
                 const Eigen::Vector2d& b) {
  const double t = std::clamp(footOnLine(p, a, b), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

bool inPolygon(const std::vector<Eigen::Vector2d>& polygon, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x())
      inside = !inside;
  }
  return inside;
}

} // namespace

Meridian::Meridian(const Superquadric& s, const Eigen::Vector2d& direction)
    : s_(s), direction_(direction.norm() > 0.0 ? direction.normalized()
                                               : Eigen::Vector2d::UnitX()) {
  const double rim = s.rimHeight();
  addCurve(0.0, -1.0, rim);
  if (s.isHollow())
    addCurve(s.wall, floorHeight(s), rim);
  for (const Eigen::Vector2d& p : curves_[0].points)
    polygon_.push_back(p);
  if (s.isHollow())
    polygon_.insert(
        polygon_.end(), curves_[1].points.rbegin(), curves_[1].points.rend());
  polygon_.emplace_back(0.0, polygon_.back().y());
}

Eigen::Vector2d Meridian::at(double s, double inset) const {
  const double larger = std::max(std::abs(s), 1.0 - std::abs(s));
  const double ratio = std::min(std::abs(s), 1.0 - std::abs(s)) / larger;
  const double norm =
      larger * std::pow(1.0 + std::pow(ratio, 2.0 / s_.epsilon1), 0.5 * s_.epsilon1);
  const double height = s / norm, scale = (1.0 - std::abs(s)) / norm;
  const double a = s_.semi_axes.x() * (1.0 + s_.kx * height) * scale - inset;
  const double b = s_.semi_axes.y() * (1.0 + s_.ky * height) * scale - inset;
  if (!(a > 0.0 && b > 0.0))
    return {0.0, height * s_.semi_axes.z()};
  if (s_.epsilon2 == 1.0 && a == b)
    return {a, height * s_.semi_axes.z()};
  const double u = std::abs(direction_.x()) / a, v = std::abs(direction_.y()) / b;
  const double most = std::max(u, v), least = std::min(u, v);
  const double reach = most * std::pow(1.0 + std::pow(least / most, 2.0 / s_.epsilon2),
                                       0.5 * s_.epsilon2);
  return {1.0 / reach, height * s_.semi_axes.z()};
}

void Meridian::addCurve(double inset, double low, double high) {
  Curve c;
  c.inset = inset;
  const double begin = latitudeOf(s_, low), end = latitudeOf(s_, high);
  for (int i = 0; i <= STEPS; ++i) {
    const double eta = begin + (end - begin) * i / STEPS;
    const double height = std::pow(std::abs(std::sin(eta)), s_.epsilon1);
    const double scale = std::pow(std::max(std::cos(eta), 0.0), s_.epsilon1);
    const bool pole = low == -1.0 && i == 0; // where a cosine is not quite zero
    c.places.push_back(pole ? -1.0 : std::copysign(height / (height + scale), eta));
    c.points.push_back(at(c.places.back(), inset));
  }
  for (std::size_t i = 0; i < STEPS; ++i) {
    double miss = 0.0;
    for (const double share : {0.1, 0.5, 0.9})
      miss = std::max(
          miss,
          toSegment(at((1.0 - share) * c.places[i] + share * c.places[i + 1], inset),
                    c.points[i],
                    c.points[i + 1]));
    c.miss = std::max(c.miss, miss);
    c.inverse_squares.push_back(
        1.0 / std::max((c.points[i + 1] - c.points[i]).squaredNorm(), 1e-300));
    c.straight.push_back(miss < STRAIGHT * s_.semi_axes.maxCoeff());
  }
  curves_.push_back(std::move(c));
}

double
Meridian::distanceTo(const Curve& c, const Eigen::Vector2d& p, double enough) const {
  double least = 1e300;
  std::size_t chord = 0;
  for (std::size_t i = 0; i < STEPS; ++i) {
    const Eigen::Vector2d to = p - c.points[i], side = c.points[i + 1] - c.points[i];
    const double t = std::clamp(to.dot(side) * c.inverse_squares[i], 0.0, 1.0);
    const double square = (to - t * side).squaredNorm();
    if (square < least) {
      least = square;
      chord = i;
    }
  }
  double nearest = std::sqrt(least);
  if (c.straight[chord] || nearest - 2.0 * c.miss > enough)
    return nearest;
  // a shorter chord about the foot misses the curve by the square of that less; its
  // ends may lie beyond those of the chord, for there may be the curve's foot
  const Eigen::Vector2d &a = c.points[chord], &b = c.points[chord + 1];
  double half = c.places[chord + 1] - c.places[chord];
  double foot = c.places[chord] + std::clamp(footOnLine(p, a, b), 0.0, 1.0) * half;
  const bool is_far = nearest > (b - a).norm();
  const int refinements = is_far ? FAR_REFINEMENTS : REFINEMENTS;
  nearest = std::min((p - a).norm(), (p - b).norm());
  for (int i = 0; i < refinements; ++i) {
    half *= is_far ? FAR_SHORTER : SHORTER;
    const double low = std::max(foot - half, c.places.front()),
                 high = std::min(foot + half, c.places.back());
    const Eigen::Vector2d from = at(low, c.inset), to = at(high, c.inset);
    if (i + 1 == refinements)
      return std::min(nearest, toSegment(p, from, to));
    foot =
        std::clamp(low + std::clamp(footOnLine(p, from, to), -1.0, 2.0) * (high - low),
                   c.places.front(),
                   c.places.back());
  }
  return nearest;
}

double Meridian::distance(double rho, double z) const {
  const Eigen::Vector2d p(rho, z);
  double nearest = 1e300;
  for (const Curve& c : curves_)
    nearest = std::min(nearest, distanceTo(c, p, nearest));
  const Eigen::Vector2d edge = curves_[0].points.back();
  const Eigen::Vector2d inner =
      s_.isHollow() ? curves_[1].points.back() : Eigen::Vector2d(0.0, edge.y());
  nearest = std::min(nearest, toSegment(p, inner, edge));
  if (s_.isHollow()) {
    const Eigen::Vector2d corner = curves_[1].points.front();
    nearest = std::min(nearest, toSegment(p, {0.0, corner.y()}, corner));
  }
  return inPolygon(polygon_, p) ? -nearest : nearest;
}

double meridianDistance(const Superquadric& s, const Eigen::Vector3d& local) {
  return Meridian(s, local.head<2>()).distance(local.head<2>().norm(), local.z());
}

void openResiduals(const Superquadric& s,
                   const UnitPoints& points,
                   kernels::Residual residual,
                   float* out) {
  const Meridian all_round(s, Eigen::Vector2d::UnitX());
  const double size = std::cbrt(s.semi_axes.prod());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d local = s.toLocal(points[i].cast<double>());
    double r = isRound(s) ? all_round.distance(local.head<2>().norm(), local.z())
                          : meridianDistance(s, local);
    if (residual == kernels::Residual::GAUGE)
      r /= size;
    else if (residual == kernels::Residual::SOLINA)
      r = std::pow(1.0 + r / size, 2) - 1.0;
    out[i] = static_cast<float>(r);
  }
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// Distances to bodies with a rim, by the outline of half a section.
#include "geometry/open_body.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int STEPS = kernels::Outline::STEPS; ///< of a meridian's curve
constexpr int CHORD_REFINEMENTS = 18; ///< golden sections about the nearest chord
constexpr double STRAIGHT = 1e-5;     ///< of the body's size that a chord may miss
/** \brief Chords in the place of one: half a circle in STEPS of them misses by 7.7e-4
 * of the radius, and the square of this less. */
constexpr std::size_t FINE = kernels::Outline::FINE;
/** \brief Points from which on refined curves are worth their making: a point costs a
 * CHORD_REFINEMENTS-th of a golden section's powers, a curve FINE x STEPS of them. */
constexpr std::size_t MANY = 2 * FINE * STEPS / CHORD_REFINEMENTS;

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

Meridian::Chord::Chord(const Eigen::Vector2d& from, const Eigen::Vector2d& to)
    : begin(from), side(to - from),
      inverse(1.0 / std::max(side.squaredNorm(), 1e-300)) {}

double Meridian::Chord::squareTo(const Eigen::Vector2d& p) const {
  const Eigen::Vector2d d = p - begin;
  const double t = std::clamp(d.dot(side) * inverse, 0.0, 1.0);
  return (d - t * side).squaredNorm();
}

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
    const Chord& chord = c.chords.emplace_back(c.points[i], c.points[i + 1]);
    double miss = 0.0;
    for (const double share : {0.1, 0.5, 0.9})
      miss =
          std::max(miss,
                   std::sqrt(chord.squareTo(at(
                       (1.0 - share) * c.places[i] + share * c.places[i + 1], inset))));
    c.miss = std::max(c.miss, miss);
    c.straight.push_back(miss < STRAIGHT * s_.semi_axes.maxCoeff());
  }
  curves_.push_back(std::move(c));
}

double
Meridian::distanceTo(const Curve& c, const Eigen::Vector2d& p, double enough) const {
  double square = 1e300;
  std::size_t chord = 0;
  for (std::size_t i = 0; i < STEPS; ++i)
    if (const double d = c.chords[i].squareTo(p); d < square) {
      square = d;
      chord = i;
    }
  const double nearest = std::sqrt(square);
  if (c.straight[chord] || nearest - 2.0 * c.miss > enough)
    return nearest;
  constexpr double GOLDEN = 0.6180339887498949;
  const auto squareAt = [&](double s) { return (p - at(s, c.inset)).squaredNorm(); };
  double low = c.places[chord], high = c.places[chord + 1];
  if (chord > 0) // the curve's foot may lie beside the chord's
    low = 0.5 * (low + c.places[chord - 1]);
  if (chord + 2 < c.places.size())
    high = 0.5 * (high + c.places[chord + 2]);
  double left = high - GOLDEN * (high - low), right = low + GOLDEN * (high - low);
  double at_left = squareAt(left), at_right = squareAt(right);
  for (int i = 0; i < CHORD_REFINEMENTS; ++i)
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      at_left = squareAt(left = high - GOLDEN * (high - low));
    } else {
      low = left;
      left = right;
      at_left = at_right;
      at_right = squareAt(right = low + GOLDEN * (high - low));
    }
  return std::sqrt(std::min({at_left,
                             at_right,
                             (p - c.points[chord]).squaredNorm(),
                             (p - c.points[chord + 1]).squaredNorm()}));
}

kernels::Outline Meridian::table(std::vector<float>& numbers) const {
  std::vector<Chord> chords;
  const auto begun = [&chords] { return chords.size(); };
  std::size_t coarse[2] = {}, fine[2] = {};
  for (std::size_t k = 0; k < curves_.size(); ++k) {
    const Curve& c = curves_[k];
    coarse[k] = begun();
    chords.insert(chords.end(), c.chords.begin(), c.chords.end());
    std::vector<Chord> pieces;
    Eigen::Vector2d from = c.points[0];
    for (std::size_t i = 0; i < STEPS; ++i)
      for (std::size_t part = 1; part <= FINE; ++part) {
        const double share = double(part) / double(FINE);
        const Eigen::Vector2d to =
            part == FINE
                ? c.points[i + 1]
                : at((1.0 - share) * c.places[i] + share * c.places[i + 1], c.inset);
        pieces.emplace_back(from, to);
        from = to;
      }
    fine[k] = begun();
    chords.insert(chords.end(), pieces.begin(), pieces.begin() + FINE);
    chords.insert(chords.end(), pieces.begin(), pieces.end());
    for (int twice = 0; twice < 2; ++twice)
      chords.insert(chords.end(), pieces.end() - FINE, pieces.end());
  }
  const std::size_t edge = begun();
  const std::vector<Chord> edges = straightSides();
  chords.insert(chords.end(), edges.begin(), edges.end());
  const std::size_t polygon = begun();
  for (std::size_t i = 0, j = polygon_.size() - 1; i < polygon_.size(); j = i++) {
    Chord side(polygon_[j], polygon_[i]);
    side.inverse = side.side.y() != 0.0 ? side.side.x() / side.side.y() : 0.0;
    chords.push_back(side);
  }
  const std::size_t n = chords.size();
  numbers.resize(5 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const Chord& c = chords[i];
    const double values[] = {
        c.begin.x(), c.begin.y(), c.side.x(), c.side.y(), c.inverse};
    for (std::size_t k = 0; k < 5; ++k)
      numbers[k * n + i] = static_cast<float>(values[k]);
  }
  const auto from = [&](std::size_t i) {
    const float* first = numbers.data() + i;
    return kernels::Sides{
        first, first + n, first + 2 * n, first + 3 * n, first + 4 * n};
  };
  return {int(curves_.size()),
          int(edges.size()),
          int(polygon_.size()),
          {from(coarse[0]), from(coarse[1])},
          {from(fine[0]), from(fine[1])},
          from(edge),
          from(polygon)};
}

std::vector<Meridian::Chord> Meridian::straightSides() const {
  const Eigen::Vector2d rim = curves_[0].points.back();
  if (!s_.isHollow())
    return {Chord({0.0, rim.y()}, rim)};
  const Eigen::Vector2d corner = curves_[1].points.front();
  return {Chord(curves_[1].points.back(), rim), Chord({0.0, corner.y()}, corner)};
}

double Meridian::distance(double rho, double z) const {
  const Eigen::Vector2d p(rho, z);
  double nearest = 1e300;
  for (const Curve& c : curves_)
    nearest = std::min(nearest, distanceTo(c, p, nearest));
  for (const Chord& side : straightSides())
    nearest = std::min(nearest, std::sqrt(side.squareTo(p)));
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
  const bool round = isRound(s);
  if (round && points.size() > MANY) {
    std::vector<float> numbers;
    kernels::kernels().outlineDistances(
        points.view(), toShape(s), all_round.table(numbers), out);
  } else
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d local = s.toLocal(points[i].cast<double>());
      out[i] = static_cast<float>(
          round ? all_round.distance(local.head<2>().norm(), local.z())
                : meridianDistance(s, local));
    }
  const auto size = static_cast<float>(std::cbrt(s.semi_axes.prod()));
  if (residual == kernels::Residual::GAUGE)
    std::transform(out, out + points.size(), out, [=](float r) { return r / size; });
  else if (residual == kernels::Residual::SOLINA)
    std::transform(out, out + points.size(), out, [=](float r) {
      return (1.0F + r / size) * (1.0F + r / size) - 1.0F;
    });
}

} // namespace pcl_sq::detail

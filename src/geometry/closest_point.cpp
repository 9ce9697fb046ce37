// SPDX-License-Identifier: BSD-3-Clause
// Exact closest point, by two nested bracketed minimisations over the surface's octant.
// The surface may be as good as a box or an octahedron, where descent along tangents
// stalls at an edge; a bracket does not.
#include "pcl_sq/superquadric.h"

#include "geometry/bend.h"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace pcl_sq {

namespace {

constexpr int COARSE_STEPS = 8;    ///< inside, each face may hold a minimum of its own
constexpr int MOST_FEET = 8;       ///< steps along tangent planes at the end
constexpr int PRECISION_BITS = 26; ///< of the argument; the minimum then has all 52

/** \brief Minimum of f over [0, 1]: the best of a coarse scan, refined by Brent's
 * method. \return argument and value */
template <typename Function>
std::pair<double, double> minimumOnUnitInterval(const Function& f) {
  int best = 0;
  double best_value = f(0.0);
  for (int i = 1; i <= COARSE_STEPS; ++i) {
    const double value = f(double(i) / COARSE_STEPS);
    if (value < best_value) {
      best_value = value;
      best = i;
    }
  }
  const double low = double(std::max(best - 1, 0)) / COARSE_STEPS;
  const double high = double(std::min(best + 1, COARSE_STEPS)) / COARSE_STEPS;
  const auto refined =
      boost::math::tools::brent_find_minima(f, low, high, PRECISION_BITS);
  if (refined.second < best_value)
    return refined;
  return {double(best) / COARSE_STEPS, best_value};
}

/** \brief Point (1 - s, s) of the first quadrant scaled onto ||.||_{2/epsilon} = 1. */
Eigen::Vector2d onUnitSuperellipse(double s, double epsilon) {
  const double larger = std::max(s, 1.0 - s);
  const double ratio = std::min(s, 1.0 - s) / larger;
  const double norm =
      larger * std::pow(1.0 + std::pow(ratio, 2.0 / epsilon), 0.5 * epsilon);
  return Eigen::Vector2d(1.0 - s, s) / norm;
}

/** \brief An interval of the parameter s of onUnitSuperellipse(). */
struct Arc {
  double begin = 0.0, end = 1.0;
};

/** \brief The arc of the meridian between two heights over a3 in the half of the body
 * on one side of z = 0, where heights are counted from there; empty (begin > end) where
 * it does not reach. */
Arc arcBetween(const Superquadric& s, double low, double high, double side) {
  const double from = side > 0.0 ? low : -high, to = side > 0.0 ? high : -low;
  const auto at = [&](double height) {
    const double scale =
        std::pow(1.0 - std::pow(height, 2.0 / s.epsilon1), 0.5 * s.epsilon1);
    return height / (height + scale);
  };
  if (to < 0.0)
    return {1.0, 0.0};
  return {at(std::clamp(from, 0.0, 1.0)), at(std::min(to, 1.0))};
}

/** \brief The point of a body's outside, or of the same shrunk by an inset, nearest to
 * a place with no negative coordinate, on an arc of the half of the body on one side of
 * z = 0, mirrored to z >= 0. */
Eigen::Vector3d closestInHalf(const Superquadric& body,
                              const Eigen::Vector3d& place,
                              double side,
                              double inset,
                              const Arc& arc) {
  const auto surfacePoint = [&](const Eigen::Vector2d& profile, double s) {
    const Eigen::Vector2d section = onUnitSuperellipse(s, body.epsilon2);
    const Eigen::Vector3d growth =
        detail::growth(body, side * profile[1] * body.semi_axes.z());
    if (inset > 0.0) {
      const Eigen::Vector2d sides =
          (profile[0] * body.semi_axes.head<2>().cwiseProduct(growth.head<2>()))
              .array() -
          inset;
      const Eigen::Vector2d p = sides.cwiseMax(0.0).cwiseProduct(section);
      return Eigen::Vector3d(p.x(), p.y(), profile[1] * body.semi_axes.z());
    }
    return Eigen::Vector3d(profile[0] * section[0], profile[0] * section[1], profile[1])
        .cwiseProduct(body.semi_axes)
        .cwiseProduct(growth)
        .eval();
  };
  const auto profileAt = [&](double t) {
    return onUnitSuperellipse(arc.begin + (arc.end - arc.begin) * t, body.epsilon1);
  };
  const auto bestOnSection = [&](double t) {
    const Eigen::Vector2d profile = profileAt(t);
    return minimumOnUnitInterval(
        [&](double u) { return (surfacePoint(profile, u) - place).squaredNorm(); });
  };
  const double t =
      minimumOnUnitInterval([&](double u) { return bestOnSection(u).second; }).first;
  return surfacePoint(profileAt(t), bestOnSection(t).first);
}

/** \brief Normal of a body's side, or of the same shrunk by an inset; own frame. */
Eigen::Vector3d
sideNormal(const Superquadric& s, const Eigen::Vector3d& at, double inset) {
  const double step = 1e-6 * s.semi_axes.z();
  const auto level = [&](double x, double y, double z) {
    const detail::Section c = detail::sectionAt(s, z / s.semi_axes.z(), inset);
    const double u = std::abs(x) / std::max(c.a, 1e-300),
                 v = std::abs(y) / std::max(c.b, 1e-300);
    const double larger = std::max(u, v);
    return larger > 0.0 ? larger * std::pow(std::pow(u / larger, 2.0 / s.epsilon2) +
                                                std::pow(v / larger, 2.0 / s.epsilon2),
                                            0.5 * s.epsilon2)
                        : 0.0;
  };
  Eigen::Vector3d normal;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d d = step * Eigen::Vector3d::Unit(k);
    const Eigen::Vector3d p = at + d, q = at - d;
    normal[k] = level(p.x(), p.y(), p.z()) - level(q.x(), q.y(), q.z());
  }
  return normal.stableNormalized();
}

/** \brief The place of the surface of a body with neither bend nor rim. */
Eigen::Vector3d nearestOnStraight(const Superquadric& s, const Eigen::Vector3d& local) {
  const Eigen::Vector3d folded = local.cwiseAbs();
  const double side = std::copysign(1.0, local.z());
  Eigen::Vector3d closest = closestInHalf(s, folded, side, 0.0, {});
  if (s.isTapered()) { // the larger half may be nearer though the point is not beside
                       // it
    const Eigen::Vector3d mirrored(folded.x(), folded.y(), -folded.z());
    Eigen::Vector3d other = closestInHalf(s, mirrored, -side, 0.0, {});
    other.z() = -other.z();
    if ((other - folded).squaredNorm() < (closest - folded).squaredNorm())
      closest = other;
  }
  for (int axis = 0; axis < 2; ++axis)
    closest[axis] = std::copysign(closest[axis], local[axis]);
  closest.z() *= side;
  return closest;
}

} // namespace

namespace detail {

SurfacePlace nearestPlace(const Superquadric& s, const Eigen::Vector3d& local) {
  const double rim = s.rimHeight(), a3 = s.semi_axes.z();
  SurfacePlace nearest;
  double least = std::numeric_limits<double>::infinity();
  const auto take = [&](const Eigen::Vector3d& at, const auto& normal) {
    const double distance = (at - local).squaredNorm();
    if (!(distance < least))
      return;
    least = distance;
    nearest = {at, normal(at)};
  };
  const auto takeSides = [&](double inset, double low, const auto& normal) {
    for (const double side : {1.0, -1.0}) {
      const Arc arc = arcBetween(s, low, rim, side);
      if (arc.begin > arc.end)
        continue;
      const Eigen::Vector3d folded(
          std::abs(local.x()), std::abs(local.y()), side * local.z());
      Eigen::Vector3d at = closestInHalf(s, folded, side, inset, arc);
      for (int axis = 0; axis < 2; ++axis)
        at[axis] = std::copysign(at[axis], local[axis]);
      at.z() *= side;
      take(at, normal);
    }
  };
  const auto takeFlat = [&](double height, bool outside_of_hollow) {
    const double x = local.x(), y = local.y();
    const bool on_it =
        outside_of_hollow
            ? contains(sectionAt(s, height), s.epsilon2, x, y) &&
                  !contains(sectionAt(s, height, s.wall), s.epsilon2, x, y)
            : contains(sectionAt(s, height, s.wall), s.epsilon2, x, y);
    if (on_it)
      take({x, y, height * a3},
           [](const Eigen::Vector3d&) { return Eigen::Vector3d::UnitZ().eval(); });
  };
  takeSides(0.0, -1.0, [&](const Eigen::Vector3d& at) {
    return logGradient(s, placeOf(s, at)).stableNormalized().eval();
  });
  takeFlat(rim, s.isHollow());
  if (s.isHollow()) {
    takeSides(s.wall, floorHeight(s), [&](const Eigen::Vector3d& at) {
      return (-sideNormal(s, at, s.wall)).eval();
    });
    takeFlat(floorHeight(s), false);
  }
  return nearest;
}

Eigen::Vector3d nearestOnBent(const Superquadric& s, const Eigen::Vector3d& local) {
  // the octants of the straight body: a grid tells in which the place may be
  constexpr int GRID = 12;
  constexpr double NEARLY = 1.1; ///< of the least distance
  const auto at = [&](int octant, double t, double u) -> Eigen::Vector3d {
    const Eigen::Vector3d sign(
        octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
    const Eigen::Vector2d profile = onUnitSuperellipse(t, s.epsilon1),
                          section = onUnitSuperellipse(u, s.epsilon2);
    return deformed(
        s,
        Eigen::Vector3d(profile[0] * section[0], profile[0] * section[1], profile[1])
            .cwiseProduct(s.semi_axes)
            .cwiseProduct(sign));
  };
  const auto distance = [&](int octant, double t, double u) {
    return (at(octant, t, u) - local).squaredNorm();
  };
  struct Cell {
    int octant;
    double t, square;
  };
  std::vector<Cell> cells;
  for (int octant = 0; octant < 8; ++octant) {
    Cell best{octant, 0.0, std::numeric_limits<double>::infinity()};
    for (int i = 0; i <= GRID; ++i)
      for (int k = 0; k <= GRID; ++k) {
        const double square = distance(octant, double(i) / GRID, double(k) / GRID);
        if (square < best.square)
          best = {octant, double(i) / GRID, square};
      }
    cells.push_back(best);
  }
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
    return a.square < b.square;
  });
  Eigen::Vector3d nearest = local;
  double least = std::numeric_limits<double>::infinity();
  const double spacing = 2.0 * s.semi_axes.maxCoeff() / GRID;
  for (const Cell& c : cells) {
    if (std::sqrt(c.square) > NEARLY * std::sqrt(cells.front().square) + spacing)
      break;
    const auto onSection = [&](double t) {
      return minimumOnUnitInterval([&](double u) { return distance(c.octant, t, u); });
    };
    const double t = boost::math::tools::brent_find_minima(
                         [&](double v) { return onSection(v).second; },
                         std::max(c.t - 1.0 / GRID, 0.0),
                         std::min(c.t + 1.0 / GRID, 1.0),
                         PRECISION_BITS)
                         .first;
    const Eigen::Vector3d place = at(c.octant, t, onSection(t).first);
    if ((place - local).squaredNorm() < least) {
      least = (place - local).squaredNorm();
      nearest = place;
    }
  }
  return nearest;
}

} // namespace detail

Eigen::Vector3d Superquadric::closestPoint(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d local = toLocal(point);
  if (isCut())
    return toWorld(detail::nearestPlace(*this, local).at);
  const Eigen::Vector3d closest =
      isBent() ? detail::nearestOnBent(*this, local) : nearestOnStraight(*this, local);
  // near the surface the radial projection may be nearer than the brackets' resolution,
  // and on a flat face, whose minimum may be narrower than a bracket, the tangent plane
  // tells where the foot is
  Eigen::Vector3d nearest = toWorld(closest);
  const auto isNearer = [&](const Eigen::Vector3d& other) {
    if (!((other - point).squaredNorm() < (nearest - point).squaredNorm()))
      return false;
    nearest = other;
    return true;
  };
  isNearer(radialProjection(point));
  for (int i = 0; i < MOST_FEET; ++i) {
    const Eigen::Vector3d n = normal(nearest);
    if (!isNearer(radialProjection(point - n.dot(point - nearest) * n)))
      break;
  }
  return nearest;
}

} // namespace pcl_sq

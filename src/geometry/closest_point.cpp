// SPDX-License-Identifier: BSD-3-Clause
// Exact closest point, by two nested bracketed minimisations over the surface's octant.
// The surface may be as good as a box or an octahedron, where descent along tangents
// stalls at an edge; a bracket does not.
#include "pcl_sq/superquadric.h"

#include "geometry/taper.h"

#include <boost/math/tools/minima.hpp>

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

} // namespace

Eigen::Vector3d Superquadric::closestPoint(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d local = toLocal(point);
  const Eigen::Vector3d folded = local.cwiseAbs();
  // the point of the surface nearest to a place with no negative coordinate, in the
  // half of the body on one side of z = 0, mirrored to z >= 0
  const auto closestInHalf = [this](const Eigen::Vector3d& place, double side) {
    const auto surfacePoint = [this, side](const Eigen::Vector2d& profile, double s) {
      const Eigen::Vector2d section = onUnitSuperellipse(s, epsilon2);
      return Eigen::Vector3d(
                 profile[0] * section[0], profile[0] * section[1], profile[1])
          .cwiseProduct(semi_axes)
          .cwiseProduct(detail::growth(*this, side * profile[1] * semi_axes.z()))
          .eval();
    };
    const auto bestOnSection = [&](double s) {
      const Eigen::Vector2d profile = onUnitSuperellipse(s, epsilon1);
      return minimumOnUnitInterval(
          [&](double t) { return (surfacePoint(profile, t) - place).squaredNorm(); });
    };
    const double s =
        minimumOnUnitInterval([&](double t) { return bestOnSection(t).second; }).first;
    return surfacePoint(onUnitSuperellipse(s, epsilon1), bestOnSection(s).first);
  };
  const double side = std::copysign(1.0, local.z());
  Eigen::Vector3d closest = closestInHalf(folded, side);
  if (isTapered()) { // the larger half may be nearer though the point is not beside it
    const Eigen::Vector3d mirrored(folded.x(), folded.y(), -folded.z());
    Eigen::Vector3d other = closestInHalf(mirrored, -side);
    other.z() = -other.z();
    if ((other - folded).squaredNorm() < (closest - folded).squaredNorm())
      closest = other;
  }
  for (int axis = 0; axis < 2; ++axis)
    closest[axis] = std::copysign(closest[axis], local[axis]);
  closest.z() *= side;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/display/display_surface.h"

#include "geometry/open_body.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq {
namespace {

/// Exponents below and above which a profile's corners are drawn as edges.
constexpr double SHARP_BELOW = 0.4, SHARP_ABOVE = 1.6;

/** \brief One point of a superellipse: position and normal, not normalised. */
struct ProfilePoint {
  double x, y, nx, ny;
};

/** \brief A quarter of the superellipse |x/a|^(2/e) + |y/b|^(2/e) = 1 from (a, 0) to
 * (0, b), \a steps + 1 points spread evenly over arc length and turning. */
std::vector<ProfilePoint> quarterProfile(double a, double b, double e, int steps) {
  // the normal is the same curve with the dual exponent 2 - e; a hair of rounding
  // keeps the corners of e = 2 at the axes from vanishing between two points
  const double dual = 2.0 - std::min(e, 1.98);
  const auto point = [&](double cosine, double sine) {
    return ProfilePoint{a * std::pow(cosine, e),
                        b * std::pow(sine, e),
                        std::pow(cosine, dual) / a,
                        std::pow(sine, dual) / b};
  };
  // candidates: geometric towards both ends, where powers of small numbers live
  std::vector<ProfilePoint> candidates = {point(1.0, 0.0)};
  const int half = 3000; // one percent from one to the next
  for (int i = 0; i <= half; ++i) {
    const double angle =
        M_PI / 4 * std::pow(1e-14, 1.0 - static_cast<double>(i) / half);
    candidates.push_back(point(std::cos(angle), std::sin(angle)));
  }
  for (int i = half - 1; i >= 0; --i) {
    const double angle =
        M_PI / 4 * std::pow(1e-14, 1.0 - static_cast<double>(i) / half);
    candidates.push_back(point(std::sin(angle), std::cos(angle)));
  }
  candidates.push_back(point(0.0, 1.0));
  std::vector<double> measure = {0.0};
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    const ProfilePoint& p = candidates[i - 1];
    const ProfilePoint& q = candidates[i];
    const double arc = std::hypot((q.x - p.x) / a, (q.y - p.y) / b);
    const double turn =
        std::abs(std::atan2(q.ny * a, q.nx * b) - std::atan2(p.ny * a, p.nx * b));
    measure.push_back(measure.back() + arc + turn);
  }
  std::vector<ProfilePoint> profile;
  std::size_t last = candidates.size();
  for (int i = 0; i <= steps; ++i) {
    const double wanted = measure.back() * i / steps;
    const auto at = std::lower_bound(measure.begin(), measure.end(), wanted);
    const auto chosen =
        std::min<std::size_t>(at - measure.begin(), candidates.size() - 1);
    if (chosen != last) // a turn within no length at all takes one point
      profile.push_back(candidates[chosen]);
    last = chosen;
  }
  // the corner itself, or its edge line would run beside it
  const double corner = std::sqrt(0.5);
  if (e < 1.0) {
    const auto nearest = std::min_element(
        profile.begin() + 1, profile.end() - 1, [&](const auto& p, const auto& q) {
          return std::abs(p.x / a - p.y / b) < std::abs(q.x / a - q.y / b);
        });
    *nearest = point(corner, corner);
  }
  return profile;
}

/** \brief The closed curve, or the half from -b to b. */
std::vector<ProfilePoint> mirrored(const std::vector<ProfilePoint>& quarter,
                                   bool closed) {
  std::vector<ProfilePoint> curve;
  const int last = static_cast<int>(quarter.size()) - 1;
  const auto add = [&](int i, double sx, double sy) {
    const ProfilePoint& p = quarter[i];
    curve.push_back({sx * p.x, sy * p.y, sx * p.nx, sy * p.ny});
  };
  if (!closed)
    for (int i = last; i > 0; --i)
      add(i, 1, -1);
  for (int i = 0; i <= last; ++i)
    add(i, 1, 1);
  if (closed) {
    for (int i = last - 1; i >= 0; --i)
      add(i, -1, 1);
    for (int i = 1; i <= last; ++i)
      add(i, -1, -1);
    for (int i = last - 1; i > 0; --i)
      add(i, 1, -1);
  }
  return curve;
}

/** \brief Whether the profile has a visible corner there. */
bool isCorner(const ProfilePoint& p, double a, double b, double e) {
  const double x = std::abs(p.x) / a, y = std::abs(p.y) / b;
  if (e < SHARP_BELOW)
    return std::abs(x - y) < 1e-9;
  return e > SHARP_ABOVE && (x == 0.0 || y == 0.0);
}

/** \brief The surface of a body with a rim: its smooth stretches apart, so that the
 * rim's edges stay edges. */
DisplaySurface openSurface(const Superquadric& s, int steps) {
  const auto around = static_cast<std::uint32_t>(8 * steps / 2);
  DisplaySurface surface;
  const auto angle = [&](std::uint32_t k) { return 2.0 * M_PI * k / around; };
  const auto stretches = detail::ringsOf(s, 2 * steps);
  for (std::size_t part = 0; part < stretches.size(); ++part) {
    const std::vector<detail::Ring>& rings = stretches[part];
    const auto first = static_cast<std::uint32_t>(surface.vertices.size());
    const auto rows = static_cast<std::uint32_t>(rings.size());
    for (std::uint32_t i = 0; i < rows; ++i)
      for (std::uint32_t k = 0; k < around; ++k) {
        const detail::Ring &below = rings[i > 0 ? i - 1 : 0],
                           &above = rings[std::min(i + 1, rows - 1)];
        // an empty ring has no direction of its own: the normal is the axis
        const detail::Ring& here = rings[i];
        const auto on = [&](const detail::Ring& ring, double at) {
          return detail::onRing(ring, s.epsilon2, at);
        };
        const Eigen::Vector3d round =
            on(here, angle(k) + 1e-4) - on(here, angle(k) - 1e-4);
        const Eigen::Vector3d up = on(above, angle(k)) - on(below, angle(k));
        const Eigen::Vector3d normal =
            here.section.empty() ? Eigen::Vector3d(0.0, 0.0, part == 0 ? -1.0 : 1.0)
                                 : round.cross(up).stableNormalized().eval();
        surface.vertices.push_back(s.toWorld(on(here, angle(k))));
        surface.normals.push_back(s.rotation * normal);
      }
    const auto index = [&](std::uint32_t row, std::uint32_t column) {
      return first + row * around + column % around;
    };
    for (std::uint32_t i = 0; i + 1 < rows; ++i)
      for (std::uint32_t k = 0; k < around; ++k) {
        surface.triangles.push_back(
            {index(i, k), index(i, k + 1), index(i + 1, k + 1)});
        surface.triangles.push_back(
            {index(i, k), index(i + 1, k + 1), index(i + 1, k)});
      }
    if (part == 0)
      continue;
    std::vector<std::uint32_t> edge; // where this stretch leaves the one before
    for (std::uint32_t k = 0; k <= around; ++k)
      edge.push_back(index(0, k));
    surface.edges.push_back(edge);
  }
  return surface;
}

} // namespace

DisplaySurface displaySurface(const Superquadric& s, int steps) {
  if (s.isCut())
    return openSurface(s, steps);
  const Eigen::Vector3d a = s.semi_axes;
  // the meridian's radius is a share of the equator's: shape it with the larger one
  const double radius = std::max(a.x(), a.y());
  const auto equator = mirrored(quarterProfile(a.x(), a.y(), s.epsilon2, steps), true);
  const auto meridian =
      mirrored(quarterProfile(radius, a.z(), s.epsilon1, steps), false);
  const std::uint32_t around = static_cast<std::uint32_t>(equator.size());
  const std::uint32_t up = static_cast<std::uint32_t>(meridian.size());

  DisplaySurface surface;
  for (const ProfilePoint& m : meridian)
    for (const ProfilePoint& h : equator) {
      const double share = m.x / radius;
      const Eigen::Vector3d straight(share * h.x, share * h.y, m.y);
      surface.vertices.push_back(s.toWorld(detail::deformed(s, straight)));
      const double weight = m.nx * radius;
      const Eigen::Vector3d normal(weight * h.nx, weight * h.ny, m.ny);
      surface.normals.push_back(
          (s.rotation * detail::deformedAreaVector(s, straight, normal)).normalized());
    }
  const auto index = [around](std::uint32_t row, std::uint32_t column) {
    return row * around + column % around;
  };
  for (std::uint32_t row = 0; row + 1 < up; ++row)
    for (std::uint32_t i = 0; i < around; ++i) {
      surface.triangles.push_back(
          {index(row, i), index(row, i + 1), index(row + 1, i + 1)});
      surface.triangles.push_back(
          {index(row, i), index(row + 1, i + 1), index(row + 1, i)});
    }

  for (std::uint32_t row = 0; row < up; ++row)
    if (meridian[row].x > 0.0 && isCorner(meridian[row], radius, a.z(), s.epsilon1)) {
      std::vector<std::uint32_t> ring;
      for (std::uint32_t i = 0; i <= around; ++i)
        ring.push_back(index(row, i));
      surface.edges.push_back(ring);
    }
  for (std::uint32_t i = 0; i < around; ++i)
    if (isCorner(equator[i], a.x(), a.y(), s.epsilon2)) {
      std::vector<std::uint32_t> rib;
      for (std::uint32_t row = 0; row < up; ++row)
        // an edge across a flat lid would be no edge
        if (s.epsilon1 >= SHARP_BELOW ||
            meridian[row].x >= radius * std::pow(0.5, 0.5 * s.epsilon1) * (1 - 1e-9))
          rib.push_back(index(row, i));
      surface.edges.push_back(rib);
    }
  return surface;
}

std::vector<Eigen::Vector3d> outline(const DisplaySurface& surface,
                                     const std::vector<Eigen::Vector3d>& to_eye) {
  std::vector<double> facing(surface.vertices.size());
  for (std::size_t i = 0; i < facing.size(); ++i) {
    facing[i] = surface.normals[i].dot(to_eye[i]);
    // exactly edge-on vertices would give two or no crossings
    if (facing[i] == 0.0)
      facing[i] = 1e-300;
  }
  std::vector<Eigen::Vector3d> ends;
  for (const auto& t : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t i = t[k], j = t[(k + 1) % 3];
      if ((facing[i] < 0.0) == (facing[j] < 0.0))
        continue;
      const double share = facing[i] / (facing[i] - facing[j]);
      ends.push_back(surface.vertices[i] +
                     share * (surface.vertices[j] - surface.vertices[i]));
    }
  return ends;
}

} // namespace pcl_sq

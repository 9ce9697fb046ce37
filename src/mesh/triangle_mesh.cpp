// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/triangle_mesh.h"

#include "mesh/open_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace pcl_sq {

namespace {

/** \brief Points on a quarter of the superellipse |x/a|^(2/e) + |y/b|^(2/e) = 1 from
 * (a, 0) to (0, b), about \a spacing apart along the curve. */
std::vector<Eigen::Vector2d>
quarterSuperellipse(double a, double b, double epsilon, double spacing) {
  // a fine polyline, denser towards the corner that small exponents make, then
  // resampled
  constexpr int FINE = 2048;
  std::vector<Eigen::Vector2d> fine;
  std::vector<double> length{0.0};
  for (int i = 0; i <= FINE; ++i) {
    const double s = 0.5 - 0.5 * std::cos(M_PI * i / FINE);
    const double larger = std::max(s, 1.0 - s), smaller = std::min(s, 1.0 - s);
    const double norm =
        larger *
        std::pow(1.0 + std::pow(smaller / larger, 2.0 / epsilon), epsilon / 2.0);
    fine.emplace_back(a * (1.0 - s) / norm, b * s / norm);
    if (i > 0)
      length.push_back(length.back() + (fine[i] - fine[i - 1]).norm());
  }
  const int steps =
      static_cast<int>(std::clamp(std::round(length.back() / spacing), 1.0, 4096.0));
  std::vector<Eigen::Vector2d> curve;
  std::size_t k = 1;
  for (int i = 0; i <= steps; ++i) {
    const double at = length.back() * i / steps;
    while (k < length.size() - 1 && length[k] < at)
      ++k;
    const double span = length[k] - length[k - 1];
    const double f = span > 0.0 ? (at - length[k - 1]) / span : 0.0;
    curve.push_back(fine[k - 1] + f * (fine[k] - fine[k - 1]));
  }
  return curve;
}

} // namespace

TriangleMesh meshSuperquadric(const Superquadric& superquadric, int divisions) {
  const int n = std::max(divisions, 2);
  if (superquadric.isCut())
    return detail::meshOpenBody(superquadric, n);
  TriangleMesh mesh;
  // Vertices live on an integer cube of side n, so that the six faces weld by their
  // keys.
  std::map<std::array<int, 3>, std::uint32_t> welded;
  const auto vertex = [&](const std::array<int, 3>& key) {
    const auto [it, added] =
        welded.try_emplace(key, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (added) {
      Eigen::Vector3d direction;
      for (int k = 0; k < 3; ++k) // equal angles on the face instead of equal lengths
        direction[k] = std::tan((2.0 * key[k] / n - 1.0) * M_PI / 4.0);
      Eigen::Vector3d v =
          superquadric.toWorld(direction.cwiseProduct(superquadric.semi_axes));
      if (superquadric.isDeformed()) // the projection takes it back first
        v = superquadric.deformed(v);
      mesh.vertices.push_back(superquadric.radialProjection(v));
    }
    return it->second;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> key{};
            key[axis] = side;
            key[u] = i + di;
            key[v] = j + dj;
            return vertex(key);
          };
          const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1),
                              d = corner(0, 1);
          if (side == n) {
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
          } else {
            mesh.triangles.push_back({a, c, b});
            mesh.triangles.push_back({a, d, c});
          }
        }
  }
  return mesh;
}

std::vector<Eigen::Vector3d>
sampleUniform(const Superquadric& superquadric, std::size_t count, unsigned seed) {
  const TriangleMesh mesh = meshSuperquadric(superquadric, 64);
  std::vector<double> cumulative;
  cumulative.reserve(mesh.triangles.size());
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    area += 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
    cumulative.push_back(area);
  }
  std::mt19937_64 engine(seed);
  // drawn from the raw bits: the standard's distributions differ between libraries
  const auto uniform = [&engine] { return double(engine() >> 11) * 0x1.0p-53; };
  std::vector<Eigen::Vector3d> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto it =
        std::lower_bound(cumulative.begin(), cumulative.end(), uniform() * area);
    const auto& t = mesh.triangles[std::min<std::size_t>(it - cumulative.begin(),
                                                         mesh.triangles.size() - 1)];
    double u = uniform(), v = uniform();
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    const Eigen::Vector3d p =
        a + u * (mesh.vertices[t[1]] - a) + v * (mesh.vertices[t[2]] - a);
    // with a rim the chord's point will do: the nearest one costs a search
    points.push_back(superquadric.isCut() ? p : superquadric.radialProjection(p));
  }
  return points;
}

std::vector<Eigen::Vector3d> sampleEqualDistance(const Superquadric& superquadric,
                                                 double spacing) {
  std::vector<Eigen::Vector3d> points;
  const Eigen::Vector3d& a = superquadric.semi_axes;
  if (!(spacing > 0.0))
    return points;
  if (superquadric.isCut()) { // no two profile curves: as many, spread evenly
    double area = 0.0;
    const TriangleMesh mesh = meshSuperquadric(superquadric, 32);
    for (const auto& t : mesh.triangles) {
      const Eigen::Vector3d& o = mesh.vertices[t[0]];
      area += 0.5 * (mesh.vertices[t[1]] - o).cross(mesh.vertices[t[2]] - o).norm();
    }
    return sampleUniform(superquadric,
                         static_cast<std::size_t>(area / (spacing * spacing)) + 1);
  }
  const double radius = std::max(a.x(), a.y());
  const auto profile =
      quarterSuperellipse(radius, a.z(), superquadric.epsilon1, spacing);
  for (const Eigen::Vector2d& p : profile) {
    const double share = p.x() / radius; // of the section's size at this height
    const auto section = quarterSuperellipse(a.x() * share + 1e-12 * radius,
                                             a.y() * share + 1e-12 * radius,
                                             superquadric.epsilon2,
                                             spacing);
    const bool pole = share < 1e-9;
    for (const double sz : {1.0, -1.0}) {
      if (sz < 0.0 && p.y() <= 0.0)
        continue; // the equator is its own mirror image
      if (pole) {
        points.push_back(superquadric.toWorld({0.0, 0.0, sz * a.z()}));
        continue;
      }
      const std::size_t n =
          section.size() - 1; // each quadrant leaves its end to the next
      for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector2d& q = section[i];
        const Eigen::Vector2d& r = section[n - i];
        points.push_back(superquadric.toWorld({q.x(), q.y(), sz * p.y()}));
        points.push_back(superquadric.toWorld({-r.x(), r.y(), sz * p.y()}));
        points.push_back(superquadric.toWorld({-q.x(), -q.y(), sz * p.y()}));
        points.push_back(superquadric.toWorld({r.x(), -r.y(), sz * p.y()}));
      }
    }
  }
  for (Eigen::Vector3d& p : points) // the polyline's chords lie a little inside
    p = superquadric.radialProjection(
        superquadric.isDeformed() ? superquadric.deformed(p) : p);
  return points;
}

} // namespace pcl_sq

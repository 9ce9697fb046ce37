// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/line_intersection.h"
#include "pcl_sq/multi_superquadric.h"
#include "pcl_sq/object_view.h"
#include "random_superquadric.h"
#include "union/shortest_turn.h"

#include <limits>

namespace pcl_sq::test {

/** \brief Distance along a ray to a superquadric; infinity where it is missed. The
 * gauge is convex along the ray, or nearly so where the body is tapered. */
inline double firstHit(const Superquadric& s,
                       const Eigen::Vector3d& from,
                       const Eigen::Vector3d& ray) {
  if (s.isCut() || s.isBent()) { // one may see into it, or through
    double at;
    return pcl_sq::firstHit(s, from, ray, at) ? at
                                              : std::numeric_limits<double>::infinity();
  }
  // the box holds the body
  const double radius = s.halfSizes().norm();
  const double middle = ray.dot(s.center - from);
  if ((from + middle * ray - s.center).norm() > radius)
    return std::numeric_limits<double>::infinity();
  const auto gauge = [&](double t) { return s.gauge(from + t * ray); };
  double a = middle - radius, b = middle + radius;
  for (int i = 0; i < 32; ++i) {
    const double c = a + 0.382 * (b - a), d = a + 0.618 * (b - a);
    (gauge(c) < gauge(d) ? b : a) = gauge(c) < gauge(d) ? d : c;
  }
  double inside = 0.5 * (a + b), outside = middle - radius;
  if (gauge(inside) > 1.0)
    return std::numeric_limits<double>::infinity();
  for (int i = 0; i < 30; ++i) {
    const double half = 0.5 * (inside + outside);
    (gauge(half) < 1.0 ? inside : outside) = half;
  }
  return inside;
}

/** \brief An object on a table as a camera sees it, without noise unless asked for. */
struct ViewScene {
  PinholeCamera camera;
  TableModel table;
  MultiSuperquadric object;
  double taper = 0.0; ///< of all its parts, kx = ky
  int width = 160, height = 120;
  Eigen::Matrix3Xf points; ///< organized, row by row
  CellMask mask;           ///< the object's pixels

  /** \brief Camera at the origin, 1 m from the table's point, tilted down. */
  explicit ViewScene(double tilt = 0.45) {
    camera.fx = camera.fy = 300.0;
    camera.cx = 79.5;
    camera.cy = 59.5;
    table.normal = Eigen::Vector3d(0.0, -std::cos(tilt), -std::sin(tilt));
    table.offset = std::sin(tilt);
  }
  /** \brief Rotation whose z axis is the table's normal. */
  Eigen::Matrix3d upright(double yaw = 0.3) const {
    return detail::shortestTurn(Eigen::Vector3d::UnitZ(), table.normal) *
           Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
  /** \brief Adds a part whose axis stands on the table, its centre at a height [m]. */
  void addUpright(const Eigen::Vector3d& semi_axes,
                  double e1,
                  double e2,
                  double center_height) {
    Superquadric s;
    s.rotation = upright();
    s.semi_axes = semi_axes;
    s.epsilon1 = e1;
    s.epsilon2 = e2;
    s.center = Eigen::Vector3d(0.0, 0.0, 1.0) + center_height * table.normal;
    object.parts.push_back(s);
  }
  /** \brief The object with its taper. */
  MultiSuperquadric tapered() const {
    MultiSuperquadric bodies = object;
    for (Superquadric& body : bodies.parts)
      if (taper != 0.0)
        body.kx = body.ky = taper;
    return bodies;
  }
  void render(double noise = 0.0) {
    const MultiSuperquadric bodies = tapered();
    Random random(3);
    points.resize(3, width * height);
    mask = CellMask(width, height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Eigen::Vector3d ray = camera.ray({double(x), double(y)});
        double t = -table.offset / table.normal.dot(ray);
        if (!(t > 0.0 && t < 3.0))
          t = 3.0;
        for (const Superquadric& s : bodies.parts) {
          const double hit = firstHit(s, camera.center, ray);
          if (hit < t) {
            t = hit;
            mask.set(x, y);
          }
        }
        points.col(y * width + x) =
            ((t + random.normal(std::max(noise, 1e-9))) * ray).cast<float>();
      }
  }
};

/** \brief A camera of 320 x 240 pixels, twice as fine. */
inline ViewScene finerScene() {
  ViewScene scene(0.6);
  scene.width = 320;
  scene.height = 240;
  scene.camera.fx = scene.camera.fy = 600.0;
  scene.camera.cx = 159.5;
  scene.camera.cy = 119.5;
  return scene;
}

/** \brief A can on a table. */
inline ViewScene canScene(double noise = 0.001) {
  ViewScene scene;
  scene.addUpright({0.04, 0.04, 0.07}, 0.2, 1.0, 0.07);
  scene.render(noise);
  return scene;
}

} // namespace pcl_sq::test

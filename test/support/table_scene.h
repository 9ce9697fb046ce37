// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/object_view.h"
#include "view_scene.h"

#include <algorithm>

namespace pcl_sq::test {

/** \brief A room with z up as a depth camera sees it: things on a table whose top is
 * z = 0, with a wall and a floor where asked for. */
struct TableScene {
  int width = 160, height = 120;
  PinholeCamera camera;             ///< its pose in the room
  Eigen::Vector2d half_table{3, 3}; ///< [m]
  double wall = 1e3;                ///< y of a wall across the view [m]
  double floor = 1e3;               ///< below the table [m]
  std::vector<Superquadric> things;
  double noise = 0.001; ///< of the depth at 0.7 m [m]; grows with its square

  explicit TableScene(double focal_length = 300.0,
                      const Eigen::Vector3d& eye = {0.0, -0.55, 0.42},
                      const Eigen::Vector3d& target = {0.0, 0.0, 0.05}) {
    camera.fx = camera.fy = focal_length;
    camera.cx = 79.5;
    camera.cy = 59.5;
    camera.center = eye;
    const Eigen::Vector3d z = (target - eye).normalized();
    const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
    camera.rotation << x, z.cross(x), z;
  }

  /** \brief Smaller image of the same view, coarser by a factor. */
  TableScene& coarser(int factor) {
    width /= factor;
    height /= factor;
    camera.fx /= factor;
    camera.fy /= factor;
    camera.cx = 0.5 * (width - 1);
    camera.cy = 0.5 * (height - 1);
    return *this;
  }

  /** \brief Adds a thing that stands on the table. */
  TableScene& stand(const Eigen::Vector2d& at,
                    const Eigen::Vector3d& semi_axes,
                    double e1,
                    double e2,
                    double yaw = 0.0) {
    Superquadric s;
    s.rotation = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    s.semi_axes = semi_axes;
    s.epsilon1 = e1;
    s.epsilon2 = e2;
    s.center = Eigen::Vector3d(at.x(), at.y(), semi_axes.z());
    things.push_back(s);
    return *this;
  }
  TableScene& can(const Eigen::Vector2d& at = {0.0, 0.0}) {
    return stand(at, {0.033, 0.033, 0.06}, 0.1, 1.0);
  }

  /** \brief Points in the room's frame, row by row; NaN where nothing is. */
  Eigen::Matrix3Xf inRoom() const {
    Random random(7);
    Eigen::Matrix3Xf points(3, width * height);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Eigen::Vector3d ray = camera.ray({double(x), double(y)});
        const double t = hit(ray);
        const double error = noise * t * t / 0.49 * random.normal();
        points.col(y * width + x) =
            t < 20.0
                ? Eigen::Vector3f((camera.center + (t + error) * ray).cast<float>())
                : Eigen::Vector3f::Constant(std::nanf(""));
      }
    return points;
  }
  /** \brief The same in the camera's frame. */
  Eigen::Matrix3Xf inCamera() const {
    return (camera.rotation.transpose() *
            (inRoom().cast<double>().colwise() - camera.center))
        .cast<float>();
  }
  /** \brief Those points that there are, in an order by chance. */
  static Eigen::Matrix3Xf listOf(const Eigen::Matrix3Xf& points) {
    std::vector<int> finite;
    for (int c = 0; c < points.cols(); ++c)
      if (points.col(c).allFinite())
        finite.push_back(c);
    std::shuffle(finite.begin(), finite.end(), std::mt19937(11));
    Eigen::Matrix3Xf list(3, Eigen::Index(finite.size()));
    for (std::size_t i = 0; i < finite.size(); ++i)
      list.col(Eigen::Index(i)) = points.col(finite[i]);
    return list;
  }

private:
  double hit(const Eigen::Vector3d& ray) const {
    const Eigen::Vector3d& eye = camera.center;
    double nearest = 1e9;
    const auto meet = [&](double t) {
      if (t > 0.0 && t < nearest)
        nearest = t;
    };
    const double t = -eye.z() / ray.z();
    const Eigen::Vector3d on = eye + t * ray;
    if (std::abs(on.x()) < half_table.x() && std::abs(on.y()) < half_table.y())
      meet(t);
    if (wall < 1e3)
      meet((wall - eye.y()) / ray.y());
    if (floor < 1e3)
      meet((-floor - eye.z()) / ray.z());
    for (const Superquadric& s : things)
      meet(firstHit(TaperedSuperquadric{s}, eye, ray));
    return nearest;
  }
};

/** \brief Height of the lowest and highest point of a model, z up [m]. */
inline std::pair<double, double>
heightsOf(const MultiSuperquadric& model, const Eigen::Vector3d& up, double offset) {
  double low = 1e9, high = -1e9;
  for (const Superquadric& s : model.parts) {
    low = std::min(low, up.dot(s.center) - s.support(-up));
    high = std::max(high, up.dot(s.center) + s.support(up));
  }
  return {low + offset, high + offset};
}

} // namespace pcl_sq::test

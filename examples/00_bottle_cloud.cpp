// SPDX-License-Identifier: BSD-3-Clause
// Sample data from nothing: a bottle of two superquadrics on a table as a depth camera
// sees it, written as an organized PCD. Usage: example_00_bottle_cloud bottle.pcd
#include <pcl_sq/multi_superquadric.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <limits>
#include <random>

using pcl_sq::MultiSuperquadric;
using pcl_sq::Superquadric;

namespace {

// The camera: x right, y down, z forward [m]; it looks down on the table by TILT.
constexpr int WIDTH = 320, HEIGHT = 240;
constexpr double FOCAL_LENGTH = 400.0; // [px]
constexpr double TILT = 0.5;           // [rad]
constexpr double DEPTH_NOISE = 0.0005; // [m]
const Eigen::Vector3d UP(0.0, -std::cos(TILT), -std::sin(TILT));
const Eigen::Vector3d FOOT(0.02, 0.09, 0.72); // where the bottle stands

Superquadric
upright(double radius, double bottom, double top, double epsilon1, double epsilon2) {
  Superquadric part;
  part.center = FOOT + 0.5 * (bottom + top) * UP;
  part.rotation.col(2) = UP;
  part.rotation.col(0) = Eigen::Vector3d::UnitX();
  part.rotation.col(1) = UP.cross(Eigen::Vector3d::UnitX());
  part.semi_axes = Eigen::Vector3d(radius, radius, 0.5 * (top - bottom));
  part.epsilon1 = epsilon1;
  part.epsilon2 = epsilon2;
  return part;
}

MultiSuperquadric bottle() {
  MultiSuperquadric object;
  object.parts.push_back(upright(0.038, 0.0, 0.18, 0.2, 1.0));  // body
  object.parts.push_back(upright(0.014, 0.17, 0.26, 0.2, 1.0)); // neck
  return object;
}

// Distance along the ray from the camera to the part. The gauge is convex along a ray:
// its minimum tells whether the ray hits, the bisection in front of it where.
double hit(const Superquadric& part, const Eigen::Vector3d& ray) {
  const double miss = std::numeric_limits<double>::infinity();
  const double middle = part.center.dot(ray);
  const double reach = 2.0 * part.semi_axes.norm();
  if ((part.center - middle * ray).norm() > reach)
    return miss;
  double near = middle - reach, far = middle + reach;
  for (int i = 0; i < 60; ++i) {
    const double third = (far - near) / 3.0;
    if (part.gauge((near + third) * ray) < part.gauge((far - third) * ray))
      far -= third;
    else
      near += third;
  }
  double inside = near;
  if (part.gauge(inside * ray) >= 1.0)
    return miss;
  double outside = middle - reach;
  for (int i = 0; i < 40; ++i) {
    const double half = 0.5 * (outside + inside);
    (part.gauge(half * ray) < 1.0 ? inside : outside) = half;
  }
  return inside;
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "Usage: " << argv[0] << " bottle.pcd\n";
    return 2;
  }
  std::ofstream file(argv[1]);
  file << "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
       << WIDTH << "\nHEIGHT " << HEIGHT << "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS "
       << WIDTH * HEIGHT << "\nDATA ascii\n";

  const MultiSuperquadric object = bottle();
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.0, DEPTH_NOISE);
  for (int v = 0; v < HEIGHT; ++v)
    for (int u = 0; u < WIDTH; ++u) {
      const Eigen::Vector3d ray =
          Eigen::Vector3d(u - 0.5 * WIDTH, v - 0.5 * HEIGHT, FOCAL_LENGTH).normalized();
      double distance = FOOT.dot(UP) / ray.dot(UP); // the table
      for (const Superquadric& part : object.parts)
        distance = std::min(distance, hit(part, ray));
      if (distance > 0.0 && distance < 1.5) {
        const Eigen::Vector3d point = (distance + noise(generator)) * ray;
        file << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
      } else {
        file << "nan nan nan\n";
      }
    }
  file.close();
  if (!file) {
    std::cerr << "Could not write " << argv[1] << ".\n";
    return 1;
  }
  for (const Superquadric& part : object.parts)
    std::cout << "true size " << 2000.0 * part.semi_axes.transpose()
              << " mm, exponents " << part.epsilon1 << ' ' << part.epsilon2 << '\n';
  return 0;
}

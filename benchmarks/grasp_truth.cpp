// SPDX-License-Identifier: BSD-3-Clause
#include "grasp_truth.h"

#include <cmath>
#include <limits>
#include <random>

using namespace pcl_sq;

namespace {

constexpr std::size_t SAMPLES = 30000;

} // namespace

GraspTruth::GraspTruth(const TriangleMesh& mesh) : mesh_(mesh) {
  std::vector<double> areas;
  for (const auto& t : mesh_.triangles)
    areas.push_back((mesh_.vertices[t[1]] - mesh_.vertices[t[0]])
                        .cross(mesh_.vertices[t[2]] - mesh_.vertices[t[0]])
                        .norm());
  std::mt19937 engine(7);
  std::discrete_distribution<std::size_t> pick(areas.begin(), areas.end());
  std::uniform_real_distribution<double> share(0.0, 1.0);
  while (samples_.size() < SAMPLES) {
    const auto& t = mesh_.triangles[pick(engine)];
    double u = share(engine), v = share(engine);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Eigen::Vector3d& a = mesh_.vertices[t[0]];
    samples_.push_back(a + u * (mesh_.vertices[t[1]] - a) +
                       v * (mesh_.vertices[t[2]] - a));
  }
}

// first hit: distance and the triangle's normal, turned against the ray
bool GraspTruth::castRay(const Eigen::Vector3d& origin,
                         const Eigen::Vector3d& direction,
                         double& distance,
                         Eigen::Vector3d& normal) const {
  distance = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh_.triangles) {
    const Eigen::Vector3d& a = mesh_.vertices[t[0]];
    const Eigen::Vector3d ab = mesh_.vertices[t[1]] - a, ac = mesh_.vertices[t[2]] - a;
    const Eigen::Vector3d p = direction.cross(ac);
    const double det = ab.dot(p);
    if (std::abs(det) < 1e-18)
      continue;
    const Eigen::Vector3d s = origin - a;
    const double u = s.dot(p) / det;
    const Eigen::Vector3d q = s.cross(ab);
    const double v = direction.dot(q) / det, at = ac.dot(q) / det;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || at < 0.0 || at >= distance)
      continue;
    distance = at;
    normal = ab.cross(ac).normalized();
    if (normal.dot(direction) > 0.0)
      normal = -normal;
  }
  return std::isfinite(distance);
}

bool GraspTruth::isAntipodal(const Grasp& grasp, double friction) const {
  const Eigen::Vector3d y = grasp.closing();
  const double out = 0.5 * grasp.open_width;
  const Eigen::Vector3d line =
      0.5 * (grasp.contacts[0].position + grasp.contacts[1].position);
  double d[2];
  Eigen::Vector3d n[2];
  if (!castRay(line + out * y, -y, d[0], n[0]) ||
      !castRay(line - out * y, y, d[1], n[1]))
    return false;
  if (d[0] + d[1] >= 2.0 * out) // the jaws met nothing between them
    return false;
  const double least = 1.0 / std::sqrt(1.0 + friction * friction);
  return n[0].dot(y) >= least && n[1].dot(-y) >= least;
}

bool GraspTruth::isFree(const Grasp& grasp,
                        const GraspScene& scene,
                        const Gripper& gripper,
                        double retreat) const {
  const std::vector<double> reach(2, 0.5 * grasp.open_width);
  for (const double back : {0.0, 0.2, 0.5, 1.0})
    for (const OrientedBox& box :
         gripper.boxes(grasp.position - back * retreat * grasp.approach(),
                       grasp.rotation,
                       reach)) {
      if (scene.has_table &&
          scene.table_offset - box.support(-scene.table_normal) < 0.0)
        return false;
      for (const Eigen::Vector3d& p : samples_)
        if (box.contains(p))
          return false;
    }
  return true;
}

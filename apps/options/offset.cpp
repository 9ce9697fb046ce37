// SPDX-License-Identifier: BSD-3-Clause
#include "options/offset.h"

#include <cmath>

namespace pcl_sq::app {

namespace {

/** \brief Offset d of the plane n . p + d = 0 after a move. */
double
movedOffset(double offset, const Eigen::Vector3d& normal, const Eigen::Vector3d& by) {
  return offset - normal.dot(by);
}

void moveNumbers(std::vector<double>& place, const Eigen::Vector3d& by) {
  for (std::size_t k = 0; k < place.size(); ++k)
    place[k] += by[static_cast<Eigen::Index>(k % 3)];
}

void moveBox(RoiBox& box, const Eigen::Vector3d& by) {
  box.min += by;
  box.max += by;
}

} // namespace

Eigen::Vector3d offsetOf(const MultiSuperquadric& model) {
  constexpr double FAR = 1e4; // squares of doubles keep 1e-8 m^2 there
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  if (!model.parts.empty() && model.parts[0].center.cwiseAbs().maxCoeff() > FAR)
    for (int k = 0; k < 3; ++k)
      offset[k] = std::round(model.parts[0].center[k]);
  return offset;
}

MultiSuperquadric moved(MultiSuperquadric model, const Eigen::Vector3d& by) {
  for (Superquadric& part : model.parts)
    part.center += by;
  return model;
}

GraspScene moved(GraspScene scene, const Eigen::Vector3d& by) {
  scene.table_offset = movedOffset(scene.table_offset, scene.table_normal, by);
  scene.viewpoint += by;
  scene.cloud.colwise() += by;
  scene.obstacles = moved(std::move(scene.obstacles), by);
  return scene;
}

GraspPlan moved(GraspPlan plan, const Eigen::Vector3d& by) {
  plan.wrench_origin += by;
  for (Grasp& grasp : plan.grasps) {
    grasp.position += by;
    for (GraspContact& contact : grasp.contacts)
      contact.position += by;
  }
  return plan;
}

ModelOptions moved(ModelOptions options, const Eigen::Vector3d& by) {
  moveNumbers(options.frame.viewpoint, by);
  moveNumbers(options.box, by);
  std::vector<double>& table = options.frame.table;
  if (table.size() == 4)
    table[3] = movedOffset(table[3], Eigen::Vector3d(table[0], table[1], table[2]), by);
  return options;
}

ModelResult moved(ModelResult result, const Eigen::Vector3d& by) {
  result.file.model = moved(std::move(result.file.model), by);
  if (auto& table = result.file.table)
    (*table)[3] = movedOffset(
        (*table)[3], Eigen::Vector3d((*table)[0], (*table)[1], (*table)[2]), by);
  if (result.sensor)
    *result.sensor += by;
  moveBox(result.report.region, by);
  for (auto& prism : result.report.prisms)
    moveBox(prism.box, by);
  if (auto& table = result.report.view.table)
    table->offset = movedOffset(table->offset, table->normal, by);
  return result;
}

} // namespace pcl_sq::app

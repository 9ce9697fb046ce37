// SPDX-License-Identifier: BSD-3-Clause
#include "grasp/hand_collision.h"

#include <algorithm>

namespace pcl_sq::detail {

HandCollision::HandCollision(const MultiSuperquadric& object,
                             const GraspScene& scene,
                             const Gripper& gripper,
                             const GraspPlannerOptions& options,
                             const MeasuredSurface& measured)
    : object_(object), scene_(scene), gripper_(gripper), options_(options) {
  const double reach = gripper.finger_length + gripper.palm_height +
                       gripper.palm_width + options.retreat;
  Eigen::AlignedBox3d around = object.boundingBox();
  around.min().array() -= reach;
  around.max().array() += reach;
  std::vector<Eigen::Vector3d> others;
  const auto pass = [&](const Eigen::Vector3d& p) {
    if (!scene.has_table ||
        scene.table_normal.dot(p) + scene.table_offset > options.cloud_tolerance)
      others.push_back(p);
  };
  for (Eigen::Index i = 0; i < scene.cloud.cols(); ++i) {
    const Eigen::Vector3d p = scene.cloud.col(i);
    if (around.contains(p) && !measured.isAbout(p))
      pass(p);
  }
  for (const Eigen::Vector3d& p : measured.others())
    pass(p);
  const PointGrid fine(std::move(others), OBSTACLE_CELL);
  obstacles_ = PointGrid(fine.means(options.min_obstacle_points), SEARCH_CELL);
}

std::vector<OrientedBox> HandCollision::boxes(const Grasp& grasp,
                                              double opening) const {
  std::vector<double> reach;
  for (int i = 0; i < gripper_.fingers; ++i)
    reach.push_back(options_.compliance +
                    gripper_.fingerDirection(grasp.rotation, i)
                        .dot(grasp.contacts[std::size_t(i)].position - grasp.position));
  return gripper_.boxes(
      grasp.position, grasp.rotation, reach, opening, options_.retreat);
}

double HandCollision::tableClearance(const std::vector<OrientedBox>& boxes) const {
  double lowest = 1.0;
  if (scene_.has_table)
    for (const OrientedBox& box : boxes)
      lowest =
          std::min(lowest, scene_.table_offset - box.support(-scene_.table_normal));
  return lowest;
}

Obstruction HandCollision::test(const OrientedBox& box, double margin) const {
  for (const Superquadric& part : object_.parts)
    if (collides(box, part, margin))
      return Obstruction::OBJECT;
  for (const Superquadric& other : scene_.obstacles.parts)
    if (collides(box, other, options_.clearance))
      return Obstruction::OBSTACLE;
  return obstacles_.anyIn(box, options_.clearance) ? Obstruction::CLOUD
                                                   : Obstruction::NONE;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "grasp/hand_collision.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

constexpr double OBSTACLE_CELL = 0.005; ///< thins obstacle points and counts noise [m]
constexpr double SEARCH_CELL = 0.02;    ///< of the grid the boxes are tested in [m]

} // namespace

HandCollision::HandCollision(const MultiSuperquadric& object,
                             const GraspScene& scene,
                             const Gripper& gripper,
                             const GraspPlannerOptions& options)
    : object_(object), scene_(scene), gripper_(gripper), options_(options) {
  if (scene.cloud.cols() > 0)
    sortCloud(scene);
}

void HandCollision::sortCloud(const GraspScene& scene) {
  const double tolerance = options_.cloud_tolerance;
  const double reach = gripper_.finger_length + gripper_.palm_height +
                       gripper_.palm_width + options_.retreat;
  Eigen::AlignedBox3d near = object_.boundingBox(), around = near;
  near.min().array() -= tolerance;
  near.max().array() += tolerance;
  around.min().array() -= reach;
  around.max().array() += reach;
  std::vector<Eigen::Vector3d> own, others;
  for (Eigen::Index i = 0; i < scene.cloud.cols(); ++i) {
    const Eigen::Vector3d p = scene.cloud.col(i);
    if (!p.allFinite() || !around.contains(p))
      continue;
    const bool object =
        near.contains(p) && std::any_of(object_.parts.begin(),
                                        object_.parts.end(),
                                        [&](const Superquadric& s) {
                                          return s.footPointDistance(p) <= tolerance;
                                        });
    const bool table =
        scene.has_table && scene.table_normal.dot(p) + scene.table_offset <= tolerance;
    if (object)
      own.push_back(p);
    else if (!table)
      others.push_back(p);
  }
  seen_ = PointGrid(std::move(own), options_.observed_distance);
  const PointGrid fine(std::move(others), OBSTACLE_CELL);
  obstacles_ = PointGrid(fine.means(options_.min_obstacle_points), SEARCH_CELL);
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

double HandCollision::observed(const GraspContact& contact, bool at_rim) const {
  double facing = 1.0;
  if (scene_.has_viewpoint && !at_rim) {
    // the outline is known as well as the front; 30 degrees behind it nothing is:
    // points close to such a contact lie on another surface, such as a cup's inside
    const Eigen::Vector3d to_viewer =
        (scene_.viewpoint - contact.position).normalized();
    facing = std::clamp(1.0 + 2.0 * contact.normal.dot(to_viewer), 0.0, 1.0);
  }
  if (seen_.empty() || seen_.anyNear(contact.position, options_.observed_distance))
    return facing;
  return scene_.has_viewpoint ? 0.5 * facing : 0.0; // on the model alone
}

} // namespace pcl_sq::detail

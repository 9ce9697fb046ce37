// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/grasp.h"
#include "pcl_sq/multi_superquadric.h"

namespace pcl_sq {

/** \brief Weights of the terms in GraspScores::total, each >= 0. */
struct GraspWeights {
  double antipodal = 2.0;
  double robustness = 2.0;
  double observed = 1.0;
  double centre = 0.7;
  double clearance = 0.5;
  double approach = 1.0;
  double opening = 0.3;
};

/** \brief Settings of the GraspPlanner. */
struct PCL_SQ_EXPORTS GraspPlannerOptions {
  std::size_t count = 100;   ///< most grasps to return, [1, 10000]
  double friction = 0.5;     ///< coefficient between finger and object, [0.05, 2]
  int surface_samples = 3;   ///< rows of samples in an eighth of a face, [1, 20]
  int approaches = 12;       ///< directions tried about a closing line, [1, 72]
  double clearance = 0.002;  ///< least distance of hand to table and obstacles [m]
  double compliance = 0.002; ///< how far the object may press into the pads [m]
  double opening = 0.015;    ///< gap on each side of the object while approaching; a
                             ///< third of it where that is not free [m]
  double margin = 0.003;     ///< least distance of the palm to the object [m]
  double retreat = 0.10;     ///< straight approach kept free of collision [m]
  double shift = 0.004; ///< of the lines in GraspScores::robustness, once and twice [m]
  double min_distance = 0.015;      ///< between tool centre points of grasps told apart
                                    ///< by neither direction [m]
  double min_angle = 0.35;          ///< between their directions [rad]
  double cloud_tolerance = 0.010;   ///< points nearer to the model belong to it [m]
  double observed_distance = 0.006; ///< of a point that makes a contact observed [m]
  /** \brief Grasps with a smaller GraspScores::observed are not given, [0, 1]: where
   * hardly anything was seen of both contacts, the model is a guess. */
  double min_observed = 0.3;
  int min_obstacle_points = 3; ///< in a cube of 5 mm, fewer are noise, [1, 1000]
  bool wrench_quality = false; ///< compute Grasp::epsilon and volume (slow)
  /** \brief Of the contact of a pad with the object [m], half the width of a pad; see
   * softFingerTorsion(). 0 is a point contact. */
  double patch_radius = 0.01;
  GraspWeights weights;

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief What surrounds the object. Everything is optional. */
struct GraspScene {
  bool has_table = false;
  Eigen::Vector3d table_normal = Eigen::Vector3d::UnitZ(); ///< unit, towards the object
  double table_offset = 0.0; ///< d of normal . p + d = 0, the plane of the table [m]
  bool has_viewpoint = false;
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero(); ///< of the camera [m]
  /** \brief Measured points [m], 3 x N, NaN columns allowed. Those near the model are
   * the object and make contacts observed; all others but the table's are obstacles. */
  Eigen::Matrix3Xd cloud;
  MultiSuperquadric obstacles; ///< other objects
};

/** \brief Why candidates were not returned. */
struct GraspRejections {
  std::size_t candidates = 0; ///< closing lines, or contact sets of three fingers
  std::size_t too_wide = 0;   ///< wider than the gripper opens
  std::size_t too_narrow = 0; ///< thinner than the gripper closes
  std::size_t slipping = 0;   ///< a normal outside of the friction cone
  std::size_t unseen = 0;     ///< contacts on surface that hardly was observed
  std::size_t poses = 0;      ///< hand poses tested for collision
  std::size_t table = 0;      ///< poses in collision with the table
  std::size_t object = 0;     ///< poses in collision with the object itself
  std::size_t obstacle = 0;   ///< poses in collision with another object
  std::size_t cloud = 0;      ///< poses in collision with measured points
};

/** \brief What the planner found. */
struct GraspPlan {
  std::vector<Grasp> grasps; ///< best first
  GraspRejections rejections;
  /** \brief What Grasp::epsilon and volume refer to: torques about the centre of
   * gravity over the largest distance of the surface from it [m]. */
  Eigen::Vector3d wrench_origin = Eigen::Vector3d::Zero();
  double wrench_length = 0.0;
  /** \brief Empty, or why there is no grasp and what came nearest to one. */
  std::string failure;
  [[nodiscard]] bool ok() const { return !grasps.empty(); }
};

/** \brief Ranked grasps of a union of superquadrics, without sampling of random poses.
 *
 * A superquadric is symmetric under the seven half turns and reflections g of its axes
 * and its centre. A surface point p and its image g p carry mirrored normals, so both
 * contacts of the closing line through p and g p make the same angle with their normal,
 * and the pair is force closed for soft fingers if and only if
 * \f[ n \cdot (p - g p) \ge |p - g p| / \sqrt{1 + \mu^2}. \f]
 * For the point reflection this is |p - t| / h(n) <= sqrt(1 + mu^2). One gradient of an
 * eighth of the surface so decides 28 closing lines. Their ends are then moved to the
 * surface of the union, the line turned towards the two normals, and the hand's swept
 * boxes tested against table, parts, other objects and measured points; the best are
 * taken greedily, similar ones left out.
 *
 * Repeatable: the same input gives the same grasps.
 * \ingroup pcl_sq */
class PCL_SQ_EXPORTS GraspPlanner {
public:
  explicit GraspPlanner(const Gripper& gripper = {},
                        const GraspPlannerOptions& options = {});

  const Gripper& getGripper() const { return gripper_; }
  const GraspPlannerOptions& getOptions() const { return options_; }

  /** \brief Grasps for the object, best first; GraspPlan::failure says why there are
   * none: an empty or invalid model, settings out of range, an object wider than the
   * gripper with the nearest miss, every pose in collision. */
  GraspPlan plan(const MultiSuperquadric& object, const GraspScene& scene = {}) const;

private:
  Gripper gripper_;
  GraspPlannerOptions options_;
};

} // namespace pcl_sq

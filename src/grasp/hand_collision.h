// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/grasp_planner.h"
#include "util/point_grid.h"

namespace pcl_sq::detail {

/** \brief What a hand can run into. */
enum class Obstruction { NONE, TABLE, OBJECT, OBSTACLE, CLOUD };

/** \brief The scene prepared for many hand poses. */
class HandCollision {
public:
  HandCollision(const MultiSuperquadric& object,
                const GraspScene& scene,
                const Gripper& gripper,
                const GraspPlannerOptions& options);

  /** \brief The hand's boxes of a grasp while it approaches, closes from \a opening on
   * each side and holds: fingers, then the palm. */
  std::vector<OrientedBox> boxes(const Grasp& grasp, double opening) const;
  /** \brief Least distance of the boxes to the table's plane [m], 1 m without one. */
  double tableClearance(const std::vector<OrientedBox>& boxes) const;
  /** \brief First thing a box runs into but for the table. \param[in] margin least
   * distance to the object [m] */
  Obstruction test(const OrientedBox& box, double margin) const;
  /** \brief Whether a box that is to touch nothing meets the object where it was
   * measured, be it in the model or not. */
  bool meetsPoints(const OrientedBox& box, double margin) const {
    return seen_.anyIn(box, margin);
  }
  /** \brief Whether the camera sees what is behind a contact: there is air, such as in
   * a handle that the model takes for a disc. */
  bool seenThrough(const GraspContact& contact) const;

  /** \brief Share of a contact that the sensor saw, GraspContact::observed.
   * \param[in] at_rim the wall is thin there: who saw one side knows the other */
  double observed(const GraspContact& contact, bool at_rim = false) const;
  /** \brief Tangent of the angle between a line and the surface's normal at a contact
   * as the measured points about it have it, who tell where the model is too plain: at
   * a shoulder, a lid, a groove. \param[in] outward the line, of unit length \return 0
   * where too few points tell */
  double seenSlope(const GraspContact& contact, const Eigen::Vector3d& outward);
  /** \brief How far measured points lie from the model, as a standard deviation [m]. */
  double scatter() const { return scatter_; }

private:
  /** \brief What a measured point says of the surface it lies on. */
  struct Witness {
    std::size_t part = 0;
    double distance = 0.0; ///< of the point from the part's surface, outwards [m]
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< the part's, once asked
  };

  void sortCloud(const GraspScene& scene);
  /** \brief A point as the viewer sees it: across the line of sight, as far as the
   * object is away, and along it [m]. */
  Eigen::Vector3d asSeen(const Eigen::Vector3d& point) const;
  void takePicture(const GraspScene& scene);
  void callWitnesses(std::vector<Eigen::Vector3d> places,
                     const std::vector<Witness>& said);
  /** \brief Whether a point is one of the object's, and on which part it lies. */
  bool belongs(const Eigen::Vector3d& point, Witness& witness) const;
  /** \brief Whether such a point tells of its part: the table and other objects are
   * not nearer. */
  bool bearsWitness(const Eigen::Vector3d& point, const Witness& witness) const;
  /** \brief Whether a witness lies on a side of this normal, one that the camera sees.
   */
  bool faces(std::size_t witness, const Eigen::Vector3d& normal);

  const MultiSuperquadric& object_;
  const GraspScene& scene_;
  const Gripper& gripper_;
  const GraspPlannerOptions& options_;
  PointGrid seen_; ///< measured object, means of points
  Eigen::Matrix3d sight_ = Eigen::Matrix3d::Identity(); ///< right, down, ahead
  double distance_ = 1.0;      ///< of the object from the viewer [m]
  PointGrid picture_;          ///< all points as seen, their depth aside
  std::vector<double> depths_; ///< of each of picture_.points() [m]
  PointGrid witnesses_;        ///< means of the object's points
  std::vector<Witness> said_;  ///< of each of witnesses_.points()
  double scatter_ = 0.0;
  PointGrid obstacles_; ///< measured points of anything else but the table
};

} // namespace pcl_sq::detail

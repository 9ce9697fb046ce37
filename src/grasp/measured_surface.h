// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/grasp_planner.h"
#include "util/point_grid.h"

namespace pcl_sq::detail {

constexpr double OBSTACLE_CELL = 0.005; ///< thins points a hand may hit, as noise [m]
constexpr double SEARCH_CELL = 0.02;    ///< of the grid the boxes are tested in [m]

/** \brief What was measured of an object, which its model follows as well as it can. */
class MeasuredSurface {
public:
  MeasuredSurface(const MultiSuperquadric& object,
                  const GraspScene& scene,
                  const GraspPlannerOptions& options);

  /** \brief Whether a point is so near that it may be the object's. */
  bool isAbout(const Eigen::Vector3d& point) const { return about_.contains(point); }
  /** \brief Points about the object that lie on none of its parts. */
  const std::vector<Eigen::Vector3d>& others() const { return others_; }
  /** \brief Whether a box that is to touch nothing meets the object where it was
   * measured, be it in the model or not. */
  bool meets(const OrientedBox& box, double margin) const {
    return own_.anyIn(box, margin);
  }
  /** \brief Share of a contact that the sensor saw, GraspContact::observed.
   * \param[in] at_rim the wall is thin there: who saw one side knows the other */
  double observed(const GraspContact& contact, bool at_rim = false) const;
  /** \brief Tangent of the angle between a line and the surface's normal at a contact
   * as the measured points about it have it, who tell where the model is too plain: at
   * a shoulder, a lid, a groove. \param[in] outward the line, of unit length \return 0
   * where too few points tell */
  double slope(const GraspContact& contact, const Eigen::Vector3d& outward);
  /** \brief How far measured points lie from the model, as a standard deviation [m]. */
  double scatter() const { return scatter_; }
  /** \brief Whether the camera sees what is behind a contact: there is air, such as in
   * a handle that the model takes for a disc. */
  bool seenThrough(const GraspContact& contact) const;

private:
  /** \brief What a measured point says of the surface it lies on. */
  struct Witness {
    std::size_t part = 0;
    double distance = 0.0; ///< of the point from the part's surface, outwards [m]
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< the part's, once asked
  };

  void sortCloud();
  /** \brief Whether a point is one of the object's, and on which part it lies. */
  bool belongs(const Eigen::Vector3d& point, Witness& witness) const;
  /** \brief Whether such a point tells of its part: the table and other objects are
   * not nearer. */
  bool bearsWitness(const Eigen::Vector3d& point, const Witness& witness) const;
  void callWitnesses(std::vector<Eigen::Vector3d> places,
                     const std::vector<Witness>& said);
  /** \brief Whether a witness lies on a side of this normal, one that the camera sees.
   */
  bool faces(std::size_t witness, const Eigen::Vector3d& normal);
  /** \brief A point as the viewer sees it: across the line of sight, as far as the
   * object is away, and along it [m]. */
  Eigen::Vector3d asSeen(const Eigen::Vector3d& point) const;
  void takePicture();

  const MultiSuperquadric& object_;
  const GraspScene& scene_;
  const GraspPlannerOptions& options_;
  Eigen::AlignedBox3d about_;
  PointGrid own_; ///< the object's points, means of them
  std::vector<Eigen::Vector3d> others_;
  PointGrid witnesses_;       ///< means of the object's points
  std::vector<Witness> said_; ///< of each of witnesses_.points()
  double scatter_ = 0.0;
  Eigen::Matrix3d sight_ = Eigen::Matrix3d::Identity(); ///< right, down, ahead
  double distance_ = 1.0;      ///< of the object from the viewer [m]
  PointGrid picture_;          ///< all points as seen, their depth aside
  std::vector<double> depths_; ///< of each of picture_.points() [m]
};

} // namespace pcl_sq::detail

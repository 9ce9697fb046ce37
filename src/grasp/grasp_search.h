// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "grasp/closing_lines.h"
#include "grasp/hand_collision.h"

#include <string>

namespace pcl_sq::detail {

/** \brief A pose that was good but for one obstruction: the nearest miss. */
struct NearestMiss {
  double score = -1.0;
  Grasp grasp;
  Obstruction obstruction = Obstruction::NONE;
};

/** \brief Object, scene and settings of one planning run with what follows from them.
 */
class GraspSearch {
public:
  GraspSearch(const MultiSuperquadric& object,
              const GraspScene& scene,
              const Gripper& gripper,
              const GraspPlannerOptions& options);

  /** \brief Fills the plan for two jaws or three fingers. */
  void run(GraspPlan& plan);

private:
  struct Candidate {
    double bound;        ///< no grasp from it scores more
    std::uint32_t index; ///< of the line or contact set
    int approach;        ///< -1: the line as a whole
    bool exact;          ///< the bound is the line's own score with its best approach
    bool operator<(const Candidate& o) const {
      return bound != o.bound
                 ? bound < o.bound
                 : (index != o.index ? index > o.index : approach > o.approach);
    }
  };

  void runTwoJaws(GraspPlan& plan);
  void runThreeFingers(GraspPlan& plan);
  std::vector<Grasp> contactSets(GraspRejections& rejections, double& narrowest) const;
  /** \brief Hand with its approach turned about the closing line by one of turns_. */
  Eigen::Matrix3d handFrame(const Eigen::Vector3d& axis, int approach) const;
  /** \brief Sets the terms that depend on contacts and pose, and the total. */
  void scoreContacts(Grasp& grasp, double slope, double robustness) const;
  void scorePose(Grasp& grasp, double table_clearance) const;
  double total(const GraspScores& scores) const;
  /** \brief Gap on each side of the object while approaching [m], for a share of the
   * one asked for. */
  double opening(const Grasp& grasp, double share) const;
  /** \brief Tests the hand where it is, opened wide or else less; sets open_width.
   * \param[out] table clearance of the table [m] */
  Obstruction tryPose(Grasp& grasp, double& table) const;
  /** \brief The hand drawn back so that the contacts lie nearer to the fingertips. */
  Grasp slid(const Grasp& grasp, double slide) const;
  /** \brief The boxes of two jaws about the grasp's line, in the hand's frame. */
  std::vector<OrientedBox> handAt(const Grasp& grasp) const;
  /** \brief Distance to the table where the hand is drawn back if that helps [m]. */
  double bestTableClearance(const Grasp& grasp,
                            const std::vector<OrientedBox>& hand) const;
  /** \brief Whether the fingers of the open hand meet the object where it was measured.
   */
  bool openHandTouches(const Grasp& grasp, double opening) const;
  /** \brief Whether the fingers' tips are nearer to the object than the palm may be. */
  bool tipsTouch(const Grasp& grasp) const;
  /** \brief Tests the pose, drawn back if that frees it; on success moves the grasp
   * there and completes its score. */
  bool place(Grasp& grasp, GraspPlan& plan);
  void missed(const Grasp& grasp, Obstruction obstruction);
  bool isNew(const Grasp& grasp, const std::vector<Grasp>& taken, double scale) const;
  void finish(GraspPlan& plan) const;
  std::string explain(const GraspPlan& plan, double narrowest, double widest) const;

  const MultiSuperquadric& object_;
  const GraspScene& scene_;
  const Gripper& gripper_;
  const GraspPlannerOptions& options_;
  MeasuredSurface measured_;
  HandCollision collision_;
  Eigen::Vector3d centre_;   ///< of gravity, overlaps counted twice [m]
  double radius_;            ///< of a ball about the centre that holds the object [m]
  Eigen::Vector3d favoured_; ///< approach direction that scores highest
  std::vector<Eigen::Vector2d> turns_; ///< cosine and sine of each approach's angle
  NearestMiss miss_;
};

} // namespace pcl_sq::detail

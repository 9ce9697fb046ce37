// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/grasp_planner.h"

#include <array>

namespace pcl_sq::detail {

constexpr double MIN_COSINE = 1e-3; ///< of normal and line: not even nearly opposite

/** \brief Two contacts and the line along which the jaws close on them. */
struct ClosingLine {
  std::array<Eigen::Vector3d, 2> points, normals; ///< on the union, outward
  std::array<std::size_t, 2> parts{{0, 0}};
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX(); ///< from the first to the second
  double width = 0.0;                              ///< [m]
  double slope = 0.0;  ///< tangent of the larger angle between axis and normal
  bool at_rim = false; ///< across a vessel's wall, from the inside to the outside

  Eigen::Vector3d middle() const { return 0.5 * (points[0] + points[1]); }
};

/** \brief A unit vector across \a axis that turns with \a frame, so that a plan does
 * not depend on the frame of the cloud. */
Eigen::Vector3d across(const Eigen::Vector3d& axis, const Eigen::Matrix3d& frame);

/** \brief Finds where two jaws can hold a union of superquadrics. */
class ClosingLines {
public:
  /** \param[in] gap a finger fits into gaps of this width between parts [m] */
  ClosingLines(const MultiSuperquadric& object,
               const GraspPlannerOptions& options,
               double gap);

  /** \brief All closing lines by the seven symmetries of each part, ends on the union;
   * \param[in,out] rejections counts what friction and widths leave out
   * \param[out] narrowest width of the narrowest line left out as too wide [m] */
  std::vector<ClosingLine> find(double min_width,
                                double max_width,
                                GraspRejections& rejections,
                                double& narrowest,
                                double& widest) const;

  /** \brief Moves the line to where it meets the surface more squarely. \return whether
   * the slope became smaller and the width not larger than \a max_width; else the line
   * is unchanged */
  bool refine(ClosingLine& line, double max_width) const;

  /** \brief GraspScores::robustness of the line. */
  double robustness(const ClosingLine& line) const;
  /** \brief The same for one contact that is pressed against \a outward. */
  double robustness(const Eigen::Vector3d& point,
                    const Eigen::Vector3d& outward,
                    std::size_t part) const;

  /** \brief Whether both contacts stay within their friction cones where the body lies
   * \a shift [m] beside its model: on a stem as thin as the points scatter they do
   * not. */
  bool standsShift(const ClosingLine& line, double shift) const;

  /** \brief The closing line through \a middle that starts from one part. \return
   * whether the part is met */
  bool cast(const Eigen::Vector3d& middle,
            const Eigen::Vector3d& axis,
            std::size_t part,
            ClosingLine& line) const;

private:
  /** \brief Whether a contact lies within another part that is open: what of a handle
   * reaches through a wall belongs to the model, not to the thing. */
  bool liesInHollow(const ClosingLine& line) const;
  bool extendToUnion(ClosingLine& line) const;
  void setSlope(ClosingLine& line) const;
  bool contains(const Eigen::Vector3d& point, std::size_t first) const;
  void findOnPart(std::size_t part, std::vector<ClosingLine>& lines) const;
  /** \brief Lines across the wall of a hollow part, all around below its rim. */
  void findOnRim(std::size_t part, std::vector<ClosingLine>& lines) const;
  /** \brief A normal turned towards level by a share of the friction cone's half angle,
   * no farther than that. */
  Eigen::Vector3d levelled(const Eigen::Vector3d& normal,
                           const Eigen::Vector3d& up,
                           double share) const;
  /** \brief The line from the inside to a place of the outside along \a axis. \return
   * whether it comes from the hollow, through the wall alone */
  bool throughWall(const Superquadric& part,
                   const Eigen::Vector3d& outside,
                   const Eigen::Vector3d& axis,
                   ClosingLine& line) const;

  const MultiSuperquadric& object_;
  const GraspPlannerOptions& options_;
  double gap_;
};

} // namespace pcl_sq::detail

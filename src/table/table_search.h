// SPDX-License-Identifier: BSD-3-Clause
// Private. Which of a scene's planes is the table: the one that things stand on (M12).
#pragma once

#include "sensor/observation.h"

#include <functional>

namespace pcl_sq::detail {

/** \brief What findPlane() asks of a plane, and how long it looks. */
struct PlaneDemand {
  double share = 0.33;  ///< of the points that lie on it
  int iterations = 200; ///< planes through three points that are tried
};

/** \brief The largest plane among the points; which side is which is left open. */
[[nodiscard]] bool findPlane(const std::vector<Eigen::Vector3d>& points,
                             double inlier_distance,
                             const PlaneDemand& demand,
                             TableModel& plane);

/** \brief Least squares through the points near a plane, with its noise.
 * \return false if they are too few */
[[nodiscard]] bool refitPlane(const std::vector<Eigen::Vector3d>& points,
                              double inlier_distance,
                              TableModel& plane);

/** \brief The same plane, looked at from its other side. */
inline TableModel flipped(TableModel plane) {
  plane.normal = -plane.normal;
  plane.offset = -plane.offset;
  return plane;
}

/** \brief A thing and the table it stands on. */
struct Standing {
  TableModel table;
  std::vector<int> thing; ///< columns; empty where nothing was found
  bool cut = false;       ///< by the image border
  int planes = 0;         ///< that were found, whether something stands on them or not
};

/** \brief The search for a table and what stands on it, the same for images and lists:
 * they differ in how points hang together, which the two functions tell. */
struct TableSearch {
  std::vector<Eigen::Vector3d> voters; ///< points spread over the scene
  double points_a_voter = 1.0;         ///< of the scene
  double distance = 0.0;               ///< of a plane's points to it, at most [m]
  std::optional<Eigen::Vector3d> viewpoint;
  std::optional<Eigen::Vector3d> up; ///< told: a table lies across it
  /** \brief Where up is if nobody tells: decides between planes across each other. */
  Eigen::Vector3d upward = -Eigen::Vector3d::UnitY();
  std::optional<TableModel> table; ///< known; then no other is tried
  /** \brief The thing that is looked for on a plane, among all points or some. */
  std::function<Standing(const TableModel&, const std::vector<int>* within)> choose;
  std::function<void(TableModel&)> refine; ///< of a plane that was found (optional)
  std::function<Eigen::Vector3d(int column)> at; ///< a point
  bool nested = true; ///< whether the thing may turn out to be a table itself

  [[nodiscard]] Standing run() const;

private:
  [[nodiscard]] std::vector<TableModel> sidesOf(const TableModel& plane) const;
  [[nodiscard]] Standing largestOn(const TableModel& plane) const;
  [[nodiscard]] bool findNext(const std::vector<Eigen::Vector3d>& points,
                              TableModel& plane) const;
  [[nodiscard]] Standing onNestedTable(Standing found) const;
};

/** \brief Each how many-th point gives at most \a wanted of them, free of patterns that
 * the width of an image would make. */
[[nodiscard]] std::size_t evenStep(std::size_t points, int width, std::size_t wanted);

/** \brief Pixels that lie above a table, among all or some. */
[[nodiscard]] CellMask pixelsAbove(const TableModel& table,
                                   const CloudPoints& points,
                                   int width,
                                   int height,
                                   const std::vector<int>* within = nullptr);

/** \brief Finds table and thing in an organized cloud in its camera's frame.
 * \param[in] region pixels of a box around the thing, or nullptr: the largest thing
 * \param[in] size of that box over the depth
 * \param[in] loose whether the largest thing in the region will do where none fits it
 */
[[nodiscard]] Standing findInImage(const CloudPoints& points,
                                   int width,
                                   int height,
                                   const ViewOptions& view,
                                   const CellMask* region = nullptr,
                                   float size = 0.0F,
                                   bool loose = false);

/** \brief The thing that a region was drawn around: pixels above the table that hang
 * together and whose box is the region's. Neighbours, what stands before or behind, and
 * the table itself are left out. */
[[nodiscard]] Standing
findInRegion(const Observation& o, const CellMask& region, bool loose = false);

constexpr std::size_t MIN_TABLE_SCENE = 30; ///< points

/** \brief Finds table and thing in a list of points in any frame.
 * \param[in] candidates whether a column may belong to the thing; empty: all may
 * \param[in] gap that separates two things [m]; 0: from the points' spacing
 * \param[in] clearance of the thing's points from the table [m]; 0: from the noise */
[[nodiscard]] Standing findInList(const CloudPoints& points,
                                  const std::vector<bool>& candidates,
                                  const ViewOptions& view,
                                  double clearance,
                                  double gap);

} // namespace pcl_sq::detail

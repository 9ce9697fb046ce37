// SPDX-License-Identifier: BSD-3-Clause
// Private. The two ways to observe an object: in an image, or as bare points.
#pragma once

#include "pcl_sq/object_view.h"

#include <algorithm>

namespace pcl_sq::detail {

/** \brief Input and output of an observation. */
struct Observation {
  const CloudPoints& points;
  int width, height;
  const std::vector<int>& object;
  const ViewOptions& view;
  ObservedObject& out;

  Eigen::Vector3d at(int column) const { return points.col(column).cast<double>(); }
  bool finite(int column) const { return points.col(column).allFinite(); }
};

[[nodiscard]] bool observeImage(Observation& o, std::string& why);
[[nodiscard]] bool observeBare(Observation& o, std::string& why);

class DepthPatch;
constexpr int MIN_IMAGE_POINTS = 30; ///< of an object in an image

/** \brief The object's points that are to be fitted, their columns and effective
 * number. \param[in] box of the object's pixels \param[in] rim pixels beside the
 * outline that are left out while enough remain */
void choosePoints(Observation& o,
                  const CellRect& box,
                  const DepthPatch& patch,
                  int rim);
/** \brief The table from the points around the object. */
void findTable(Observation& o, const CellRect& box);
/** \brief Pixels beside the object's through which the background is seen.
 * \param[in] margin pixels beside the outline that may be either's */
void findFreePixels(Observation& o, const CellRect& box, int margin);
/** \brief The largest gap in the object's pixels through which the background is seen.
 * \param[in] box of the object's pixels */
void findGap(Observation& o, const CellRect& box);
/** \brief Whether something nearer than the object hides it beyond a contour pixel. */
bool occluded(const Observation& o, const DepthPatch& patch, int x, int y);

/** \brief Checks a table against the object's points; drops it with a note if they lie
 * below it. */
void checkTable(ObservedObject& observed);

/** \brief Points lower than this above a table may be the table's [m]. */
inline double standingHeight(const TableModel& table, double depth) {
  return std::max(4.0 * table.noise, 0.003 * depth);
}

/** \brief Height above the table from which on the outline is the object's own; a thin
 * thing's is the edge of its top. */
double lowestOutline(const ObservedObject& observed);

/** \brief How far the object may reach below its points: foot and hidden_below.
 * \param[in] rim pixels beside the outline that were left out */
void findFoot(Observation& o, const CellRect& box, int rim);

/** \brief How far each point's surface moves along its normal when the measurement
 * belongs a pixel beside the point's own [m]. */
Eigen::VectorXf sidewaysErrors(const Observation& o, const DepthPatch& patch);

/** \brief Extent and depth from the points. */
void measure(ObservedObject& observed);

/** \brief Whether points look as if a camera at the origin, looking along z, has seen
 * them: far enough before it, and hardly any ray meets two layers of them. */
bool isCameraFrame(const Eigen::Matrix3Xd& points);
/** \brief How many points share one error: 1 where neighbours err independently. */
double sharingOfErrors(const Eigen::Matrix3Xd& points);

/** \brief A place from which points of one side may have been seen: in the middle of
 * the directions from which each ray meets them once, some way off. */
std::optional<Eigen::Vector3d> guessViewpoint(const Eigen::Matrix3Xd& points);

} // namespace pcl_sq::detail

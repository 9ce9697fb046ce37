// SPDX-License-Identifier: BSD-3-Clause
// Private. The two ways to observe an object: in an image, or as bare points.
#pragma once

#include "sensor/observation.h"

namespace pcl_sq::detail {

/** \brief The camera of an organized cloud, its intrinsics those that are known.
 * \return false if the cloud is no pinhole image */
[[nodiscard]] bool findImage(const CloudPoints& points,
                             int width,
                             int height,
                             const ViewOptions& view,
                             PinholeCamera& camera);

/** \brief Tells of a viewpoint that is not where an image of points was taken from, by
 * a tenth of the distance to its middle or more: nearer, it is an estimate of the same.
 */
void noteOtherViewpoint(const CloudPoints& points,
                        const PinholeCamera& camera,
                        const ViewOptions& view,
                        std::vector<std::string>& notes);

[[nodiscard]] bool observeImage(Observation& o, std::string& why);
[[nodiscard]] bool observeBare(Observation& o, std::string& why);

class DepthPatch;
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
void findFreeSpace(Observation& o, const CellRect& box, int margin);
/** \brief The largest gap in the object's pixels through which the background is seen.
 * \param[in] box of the object's pixels */
void findGap(Observation& o, const CellRect& box);
/** \brief Whether something nearer than the object hides it beyond a contour pixel. */
bool occluded(const Observation& o, const DepthPatch& patch, int x, int y);
/** \brief Whether a pixel of the outline lies beside one of ViewOptions::others that is
 * not clearly behind the object: there the other's outline is seen, or both touch. */
bool besideAnother(const Observation& o, const DepthPatch& patch, int x, int y);

/** \brief Checks a table against the object's points; drops it with a note if they lie
 * below it. */
void checkTable(ObservedObject& observed);

/** \brief Height above the table from which on the outline is the object's own; a thin
 * thing's is the edge of its top. */
double lowestOutline(const ObservedObject& observed);

/** \brief How far the object may reach below its points: foot and hidden_below.
 * \param[in] rim pixels beside the outline that were left out */
void findFoot(Observation& o, const CellRect& box, int rim);

/** \brief All lines that touch an outline, and which of them silhouetteLines() has. */
struct TouchingLines {
  std::vector<SilhouetteLine> lines;
  std::vector<bool> known;

  bool knows(const SilhouetteLine& line) const;
};
TouchingLines touchingLines(const std::vector<ContourPoint>& contour,
                            int count,
                            double tolerance = 1.0);

/** \brief Extent and depth from the points. */
void measure(ObservedObject& observed);

} // namespace pcl_sq::detail

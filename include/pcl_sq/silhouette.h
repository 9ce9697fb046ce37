// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/camera.h"
#include "pcl_sq/cell_mask.h"
#include "pcl_sq/tangent_plane.h"

#include <functional>
#include <vector>

namespace pcl_sq {

/** \brief A point of an object's outline in the image. */
struct ContourPoint {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  /** \brief False where the outline is not the object's own: at the image border, at an
   * occluder, at a cut between two parts. */
  bool own = true;
};

/** \brief A line direction . u = offset that touches the outline, which lies at
 * direction . u <= offset. */
struct SilhouetteLine {
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX(); ///< unit length, outwards
  double offset = 0.0;                                  ///< [px]
  Eigen::Vector2d contact = Eigen::Vector2d::Zero();    ///< where it touches [px]
};

/** \brief Outline of a mask: its pixels with a neighbour (of four) that is not set.
 *
 * Those in the outermost rows and columns are not the object's own outline.
 * \param[in] foreign tells further pixels whose outline is not the object's own, for
 * instance an occluder's (optional) */
PCL_SQ_EXPORTS std::vector<ContourPoint>
contourOf(const CellMask& mask, const std::function<bool(int x, int y)>& foreign = {});

/** \brief Convex hull, counter-clockwise in x, y; each vertex keeps its flag. */
PCL_SQ_EXPORTS std::vector<ContourPoint>
convexHull(const std::vector<ContourPoint>& contour);

/** \brief Lines that touch an outline in \a count equally spaced directions.
 *
 * Directions are left out in which the outline is within \a tolerance [px] of the line
 * at a point that is not the object's own: where the object goes on beyond is unknown.
 */
PCL_SQ_EXPORTS std::vector<SilhouetteLine> silhouetteLines(
    const std::vector<ContourPoint>& contour, int count, double tolerance = 1.0);

/** \brief The plane through the camera's centre and a line of the image; the body that
 * made the outline touches it.
 * \param[in] sigma standard deviation of the line [px]
 * \param[in] depth of the body [m], turns pixels into metres */
PCL_SQ_EXPORTS TangentPlane tangentPlane(const PinholeCamera& camera,
                                         const SilhouetteLine& line,
                                         double sigma,
                                         double depth);

} // namespace pcl_sq

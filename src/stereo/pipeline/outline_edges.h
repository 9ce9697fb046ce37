// SPDX-License-Identifier: BSD-3-Clause
// Private. Whether an object ends where its outline is.
#pragma once

#include "pcl_sq/exports.h"
#include "pcl_sq/stereo/stereo_reprojector.h"

#include <opencv2/core.hpp>

namespace pcl_sq::detail {

/** \brief What lies beyond an object's outline, shares of 0 to 1. */
struct OutlineEdges {
  /** \brief Of the outline's pixels where nothing nearer hides where the object ends.
   */
  double own = 0.0;
  /** \brief Of these, where a flat surface of the object is seen to go on. */
  double goes_on = 0.0;

  /** \brief Whether the object is a piece cut out of a wall, a table, another thing. */
  PCL_SQ_EXPORTS bool isPiece() const;
};

/** \brief Looks a few pixels to either side of an object's outline whether its planes,
 * which are planes in the disparities as well, go on.
 * \param[in] mask the object's pixels, as large as the disparities
 * \return nothing goes on without disparities and their noise */
PCL_SQ_EXPORTS OutlineEdges outlineEdges(const StereoResult& stereo,
                                         const cv::Mat& mask);

} // namespace pcl_sq::detail

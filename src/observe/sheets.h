// SPDX-License-Identifier: BSD-3-Clause
// Private. Bare points as small pieces of surface, each one sheet of several where a
// thin wall's other side is near.
#pragma once

#include "pcl_sq/object_view.h"

#include <vector>

namespace pcl_sq::detail {

/** \brief The surface about one point, as most of its neighbours have it. */
struct Sheet {
  Eigen::Vector3d normal; ///< unit length, of either sign
  /** \brief Along the normal to another sheet that lies beyond it, and as wide as the
   * neighbourhood; 0: there is none [m]. */
  double other = 0.0;
  /** \brief Standard deviation of the neighbours about the curved surface through those
   * of them that are the point's own sheet [m]; negative: unknown. */
  double scatter = -1.0;
};

/** \brief The sheets about some of the points. */
std::vector<Sheet> sheetsOf(const Eigen::Matrix3Xd& points);

/** \brief Share of the sheets that have another one beyond them. */
double doubled(const std::vector<Sheet>& sheets);

/** \brief The noise of bare points, and whether they are of both sides of thin walls,
 * as no single view and no solid shows. */
ObservedObject::Surface surfaceOf(const Eigen::Matrix3Xd& points);

} // namespace pcl_sq::detail

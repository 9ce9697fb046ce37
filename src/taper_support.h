// SPDX-License-Identifier: BSD-3-Clause
// Private. The support function of a tapered superquadric and its derivatives.
#pragma once

#include "support_rows.h"
#include "taper_row.h"

namespace pcl_sq::detail {

/** \brief Reach along a direction of unit length, with the derivatives for t (along the
 * own axes), w, ln a, e1, e2, kx, ky: the envelope theorem, at the point that touches.
 */
SupportRow<13> taperSupport(const TaperedSuperquadric& superquadric,
                            const Eigen::Vector3d& normal);

} // namespace pcl_sq::detail

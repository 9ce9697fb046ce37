// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/normalisation.h"

namespace pcl_sq::detail {

/** \brief The points that have many neighbours: those of a surface rather than of the
 * space around it; of many points some thousands are looked at. Only starts are made
 * from them; no point is lost to the fit. */
UnitPoints densePoints(const UnitPoints& points);

} // namespace pcl_sq::detail

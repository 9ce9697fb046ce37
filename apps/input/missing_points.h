// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "input/shape.h"

namespace pcl_sq::app {

/** \brief Makes NaN of the points that stand for "nothing was measured here": not
 * finite, 0 0 0, at one far value that many points share, or all at one place.
 * \return a sentence for each kind, without its full stop */
std::vector<std::string> dropMissingPoints(Shape& shape);

} // namespace pcl_sq::app

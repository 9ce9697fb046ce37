// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "files/cloud_io.h"

namespace pcl_sq::app {

/** \brief A sentence, without its full stop, for things that are no size of what a
 * gripper or a table holds: larger than 10 m or smaller than 1 mm. Most such files are
 * in another unit. Empty for all others.
 * \param[in] what "the object", "the cloud"
 * \param[in] size longest side [m] */
std::string
sizeDoubt(const std::string& what, double size, const CloudOptions& options);

/** \brief Longest side of the box of a cloud's points [m]. */
double sizeOf(const LoadedCloud& input);

} // namespace pcl_sq::app

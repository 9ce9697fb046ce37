// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl_sq::app {

/** \brief Holds the sizes that a PCD header states against the file's length.
 * \return an empty string, or what is wrong */
std::string checkPcdHeader(const std::string& path);

/** \brief The same for PLY. */
std::string checkPlyHeader(const std::string& path);

} // namespace pcl_sq::app

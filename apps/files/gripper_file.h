// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/gripper.h"

#include <string>

namespace pcl_sq::app {

/** \brief A hand by the name of a preset or of a .toml file. \throw UsageError with the
 * known names, or with the key of the file that is wrong */
Gripper readGripper(const std::string& preset_or_path);

/** \brief A hand from the text of a TOML file: sizes [m] by the names of Gripper's
 * members; what is left out is the Panda hand's. \param[in] path for messages
 * \param[out] missing names of the sizes that were left out \throw UsageError */
Gripper
gripperFromToml(const std::string& text, const std::string& path, std::string& missing);

} // namespace pcl_sq::app

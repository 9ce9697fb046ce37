// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/graspit_export.h"

#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief Name for the files of an input: its file name without folder and extension,
 * what GraspIt! cannot have in a name as underscores. */
std::string graspitName(const std::string& input_path);

/** \brief Writes an export into a GraspIt! folder.
 *
 * A list of the files, NAME_files.txt, is left beside them. By it an export of the same
 * name replaces its own files, all of them; a file that is not in the list is somebody
 * else's and stays.
 * \throw Failure, before anything is written, if a file of another origin is in the way
 */
void writeGraspitFolder(const std::string& folder,
                        const std::string& name,
                        std::vector<TextFile> files);

} // namespace pcl_sq::app

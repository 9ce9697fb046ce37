// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/visualization/snapshot_renderer.h"

namespace pcl_sq {

/** \brief Asked before a picture is rendered. \throws pcl_sq::Exception if the path
 * does not end in .png (pipes and devices need no ending) or cannot be written */
void checkPngPath(const std::string& path, const std::string& who);

/** \brief Writes a picture as PNG. \throws pcl_sq::Exception if that fails */
void writePng(const std::string& path,
              const SnapshotImage& image,
              const std::string& who);

} // namespace pcl_sq

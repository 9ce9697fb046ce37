// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/visualization/snapshot_renderer.h"

namespace pcl_sq {

// See VtkPart.
std::string pngBytes(const SnapshotImage& image);
std::string vtpBytes(const std::vector<TriangleMesh>& parts,
                     const std::vector<Color>& colors);

} // namespace pcl_sq

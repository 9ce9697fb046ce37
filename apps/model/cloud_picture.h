// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "files/cloud_io.h"

#include "pcl_sq/model_io.h"

namespace pcl_sq {
class SnapshotRenderer;
}

namespace pcl_sq::app {

/** \brief Puts a cloud into a picture, in its own colours if it has any. */
void addCloud(SnapshotRenderer& renderer, const LoadedCloud& input);

/** \brief Surface of each part of a model. */
std::vector<TriangleMesh> meshesOf(const ModelFile& file);

} // namespace pcl_sq::app

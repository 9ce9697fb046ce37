// SPDX-License-Identifier: BSD-3-Clause
// What images became, as the model half takes it.
#pragma once

#include "files/cloud_io.h"

#include "pcl_sq/object_view.h"
#include "pcl_sq/stereo/stereo_reprojector.h"

namespace pcl_sq::app {

/** \brief The stereo cloud in the programs' point type; only \a keep's points stay
 * finite, all of them if it is null. */
LoadedCloud toLoadedCloud(const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                          const pcl::Indices* keep);

} // namespace pcl_sq::app

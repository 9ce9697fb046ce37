// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/adaptive_voxel_grid.h"

#include <pcl/point_types.h>

PCL_SQ_INSTANTIATE(template class, AdaptiveVoxelGrid)

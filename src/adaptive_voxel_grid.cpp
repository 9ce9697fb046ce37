// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/impl/adaptive_voxel_grid.hpp"

#include "instantiate.h"

PCL_SQ_INSTANTIATE(AdaptiveVoxelGrid)

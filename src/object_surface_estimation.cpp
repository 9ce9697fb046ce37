// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/impl/object_surface_estimation.hpp"

#include "instantiate.h"

PCL_SQ_INSTANTIATE(ObjectSurfaceEstimation)

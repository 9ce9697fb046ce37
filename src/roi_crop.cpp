// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/impl/roi_crop.hpp"

#include "instantiate.h"

PCL_SQ_INSTANTIATE(RoiCrop)

// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/roi_crop.h"

#include <pcl/point_types.h>

PCL_SQ_INSTANTIATE(template class, RoiCrop)

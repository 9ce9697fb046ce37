// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/impl/prism_segmentation.hpp"

#include "instantiate.h"

PCL_SQ_INSTANTIATE(PrismSegmentation)

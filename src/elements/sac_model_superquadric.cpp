// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/sac_model_superquadric.h"

#include <pcl/point_types.h>

PCL_SQ_INSTANTIATE(template class, SampleConsensusModelSuperquadric)

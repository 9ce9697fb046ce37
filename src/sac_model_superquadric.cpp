// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/impl/sac_model_superquadric.hpp"

#include "instantiate.h"

PCL_SQ_INSTANTIATE(SampleConsensusModelSuperquadric)

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <pcl/point_types.h>

/** \brief Instantiates an element for the point types that the library serves; for any
 * other type the user defines PCL_NO_PRECOMPILE. */
#define PCL_SQ_INSTANTIATE(Element)                                                    \
  template class PCL_SQ_EXPORTS pcl_sq::Element<pcl::PointXYZ>;                        \
  template class PCL_SQ_EXPORTS pcl_sq::Element<pcl::PointXYZI>;                       \
  template class PCL_SQ_EXPORTS pcl_sq::Element<pcl::PointXYZRGB>;                     \
  template class PCL_SQ_EXPORTS pcl_sq::Element<pcl::PointXYZRGBA>;                    \
  template class PCL_SQ_EXPORTS pcl_sq::Element<pcl::PointNormal>;                     \
  template class PCL_SQ_EXPORTS pcl_sq::Element<pcl::PointXYZRGBNormal>;

// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/exception.h"
#include "stereo/wls/wls_filter.h"

#ifdef PCL_SQ_PLUG_INS
#include "util/plug_in.h"
#endif

namespace pcl_sq::detail {

WlsFilter* wlsFilter() {
#ifndef PCL_SQ_HAVE_XIMGPROC
  return nullptr;
#elif defined(PCL_SQ_PLUG_INS)
  std::string why;
  auto* find = functionOf<WlsFilter*()>("pcl_sq_wls.so", "pcl_sq_wls_filter", &why);
  if (find == nullptr)
    throw Exception("[pcl_sq::StereoReprojector::compute] " + why + ".");
  return find();
#else
  return pcl_sq_wls_filter();
#endif
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/exception.h"
#include "visualization/frame_renderer.h"

#ifdef PCL_SQ_PLUG_INS
#include "util/plug_in.h"
#endif

namespace pcl_sq {

const VtkPart& vtkPart([[maybe_unused]] const std::string& who) {
#ifdef PCL_SQ_PLUG_INS
  std::string why;
  auto* part =
      detail::functionOf<const VtkPart*()>("pcl_sq_vtk.so", "pcl_sq_vtk_part", &why);
  if (part == nullptr)
    throw Exception("[" + who + "] " + why + ".");
  return *part();
#else
  return *pcl_sq_vtk_part();
#endif
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
// What "import pcl_sq" loads: neither OpenCV nor VTK.
#include "bodies.h"
#include "errors.h"

#include "pcl_sq/config.h"

#include <pcl/console/print.h>

PYBIND11_MODULE(_core, module) {
  // the library's own words come with its results, as exceptions and notes
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  module.doc() = "Superquadrics, their fit and their grasps; use the package pcl_sq.";
  module.attr("__version__") = PCL_SQ_VERSION;
  pcl_sq::python::raiseOptionErrors();
  pcl_sq::python::addBodies(module);
  pcl_sq::python::addEstimation(module);
  pcl_sq::python::addScenes(module);
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

namespace pcl_sq::python {

/** \brief Superquadric, MultiSuperquadric and the fit of one. */
void addBodies(pybind11::module_& module);
/** \brief Models: estimation, files, grasps. */
void addEstimation(pybind11::module_& module);
/** \brief Scenes: estimation, files, pages. */
void addScenes(pybind11::module_& module);

} // namespace pcl_sq::python

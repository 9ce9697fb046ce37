// SPDX-License-Identifier: BSD-3-Clause
// Georeferenced coordinates: millions of metres, of which the last millimetre counts.
// What is computed is computed near the origin; what is read and written is not.
#pragma once

#include "options/model_options.h"

#include "pcl_sq/grasp_planner.h"

namespace pcl_sq::app {

/** \brief Whole metres between the origin and a model that is so far away that squares
 * of its coordinates lose what counts; else zero [m]. */
Eigen::Vector3d offsetOf(const MultiSuperquadric& model);

/** \name The same things, moved by \a by [m] */
///@{
MultiSuperquadric moved(MultiSuperquadric model, const Eigen::Vector3d& by);
GraspScene moved(GraspScene scene, const Eigen::Vector3d& by);
GraspPlan moved(GraspPlan plan, const Eigen::Vector3d& by);
ModelOptions moved(ModelOptions options, const Eigen::Vector3d& by);
ModelResult moved(ModelResult result, const Eigen::Vector3d& by);
///@}

} // namespace pcl_sq::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "files/cloud_io.h"
#include "options/frame_options.h"

#include "pcl_sq/grasp_planner.h"
#include "pcl_sq/model_io.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief What programs that plan grasps ask the user. */
struct GraspOptions {
  Gripper gripper;
  GraspPlannerOptions planner;
  FrameOptions frame;
  std::string output;       ///< grasps as JSON
  std::string snapshot;     ///< picture
  std::string html;         ///< page to turn
  std::string graspit;      ///< folder for GraspIt!'s files
  std::string graspit_name; ///< of these files; empty: that of the input
  bool part_bodies = false; ///< also one body per part for GraspIt!

  GraspOptions();
};

/** \brief Adds gripper, friction and clearance to a program. */
void addGripperOptions(CLI::App& cli, GraspOptions& options);

/** \brief Adds the number of grasps and the outputs to a program. */
void addGraspOutputOptions(CLI::App& cli, GraspOptions& options);

/** \brief Refuses contradictions and files that could not be written later. */
void checkGraspOptions(const GraspOptions& options);

/** \brief The scene of a model: table and viewpoint from the options, else those that
 * the model file tells of, else the viewpoint that the cloud does. A place of the
 * camera that was guessed is none: which sides are unseen is not known then. \param[in]
 * cloud the scene, or nullptr */
GraspScene
makeScene(const GraspOptions& options, const ModelFile& file, const LoadedCloud* cloud);

/** \brief All points of a cloud as columns. */
Eigen::Matrix3Xd columnsOf(const LoadedCloud& input);

/** \brief Plans and takes the time; GraspPlan::failure says why there is no grasp. */
GraspPlan planGrasps(const MultiSuperquadric& model,
                     const GraspScene& scene,
                     const GraspOptions& options,
                     double& milliseconds);

/** \brief The grasps as JSON, schema pcl_sq/grasps. */
std::string graspsToJson(const GraspPlan& plan,
                         const GraspScene& scene,
                         const GraspOptions& options,
                         const std::string& frame,
                         const std::string& model_path,
                         double milliseconds);

/** \brief Adds "grasps" to the top level of a model file. */
void addGrasps(const GraspPlan& plan, const GraspOptions& options, ModelFile& file);

/** \brief Writes the files that the options name. */
void writeGraspOutputs(const MultiSuperquadric& model,
                       const GraspPlan& plan,
                       const GraspScene& scene,
                       const GraspOptions& options,
                       const std::string& json);

/** \brief The ranked grasps for people, on stdout. */
void printGrasps(const GraspPlan& plan,
                 const GraspOptions& options,
                 double milliseconds);

} // namespace pcl_sq::app

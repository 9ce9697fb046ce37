// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/grasp_planner.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief What programs that plan grasps ask the user. */
struct GraspOptions {
  Gripper gripper;
  GraspPlannerOptions planner;
  std::vector<double> table;     ///< nx, ny, nz, d of n . p + d = 0, or empty
  std::vector<double> viewpoint; ///< [m], or empty
  std::string output;            ///< grasps as JSON
  std::string snapshot;          ///< picture
  std::string graspit;           ///< folder for GraspIt!'s files
  bool part_bodies = false;      ///< also one body per part for GraspIt!

  GraspOptions();
};

/** \brief Adds gripper, friction, table, viewpoint and the outputs to a program. */
void addGraspOptions(CLI::App& cli, GraspOptions& options);

/** \brief Refuses contradictions and files that could not be written later. */
void checkGraspOptions(const GraspOptions& options);

/** \brief A preset's name or a TOML file with the members of Gripper.
 * \throw UsageError naming the presets, or the key that is wrong */
Gripper readGripper(const std::string& preset_or_path);

/** \brief The scene that the options describe. */
GraspScene makeScene(const GraspOptions& options);

/** \brief Plans. \throw Failure with the planner's reason if there is no grasp */
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/object_view.h"

#include <CLI/CLI.hpp>

#include <optional>
#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief What the user knows of the cloud's frame; each counts at every stage. */
struct FrameOptions {
  std::vector<double> viewpoint; ///< camera's place x, y, z [m], or empty
  std::vector<double> table;     ///< nx, ny, nz, d of n . p + d = 0 [m], or empty
  std::string up;                ///< axis or x,y,z, or empty

  /** \name What they tell. \throw UsageError where the numbers make no sense */
  ///@{
  std::optional<Eigen::Vector3d> viewpointOf() const;
  std::optional<TableModel> tableOf() const;
  std::optional<Eigen::Vector3d> upOf() const; ///< as told; any length
  ///@}
};

/** \brief Refuses --table and --up where they contradict each other.
 * \throw UsageError */
void checkFrame(const FrameOptions& options);

/** \brief Adds --viewpoint, --table and --up to a program. */
void addFrameOptions(CLI::App& cli, FrameOptions& options);

} // namespace pcl_sq::app

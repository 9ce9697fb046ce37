// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

#include <cstddef>
#include <string>

namespace pcl_sq::app {

/** \brief What every program that reads clouds or meshes asks the user. */
struct CloudOptions {
  /// of the numbers in the file: mm, cm, m or in; empty: what the file says, else m
  std::string unit;
  /// what tells another unit of the input
  std::string unit_option = "--unit mm, cm, m or in";
  std::size_t samples = 5000; ///< points on the surface of a mesh, 100 to 10,000,000

  /** \brief Length of the unit [m]. */
  double scale() const;
};

/** \brief Adds --unit and --samples to a program. */
void addCloudOptions(CLI::App& cli, CloudOptions& options);

/** \brief Adds --unit alone: to programs that take meshes as they are. */
void addUnitOption(CLI::App& cli, CloudOptions& options);

} // namespace pcl_sq::app

// SPDX-License-Identifier: BSD-3-Clause
#include "options/cloud_options.h"

#include "command_line/value_checks.h"

namespace pcl_sq::app {

double CloudOptions::scale() const {
  return unit == "mm" ? 1e-3 : unit == "cm" ? 1e-2 : unit == "in" ? 0.0254 : 1.0;
}

void addUnitOption(CLI::App& cli, CloudOptions& options) {
  cli.add_option("--unit",
                 options.unit,
                 "Unit of the coordinates in the input, else what the file says, or m; "
                 "results are always in metres")
      ->check(oneOf({"mm", "cm", "m", "in"}));
}

void addCloudOptions(CLI::App& cli, CloudOptions& options) {
  addUnitOption(cli, options);
  cli.add_option("--samples",
                 options.samples,
                 "Points on the surface of a mesh (PLY, OBJ or STL with faces)")
      ->check(wholeNumber(100, 10000000))
      ->type_name("N")
      ->capture_default_str();
}

} // namespace pcl_sq::app

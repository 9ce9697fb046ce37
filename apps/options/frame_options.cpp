// SPDX-License-Identifier: BSD-3-Clause
// Options that tell of the cloud's frame, the same in every program.
#include "options/frame_options.h"

#include "command_line/app.h"
#include "command_line/value_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl_sq::app {

namespace {

bool finite(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::ArrayXd>(values.data(), Eigen::Index(values.size()))
      .allFinite();
}

} // namespace

std::optional<Eigen::Vector3d> FrameOptions::viewpointOf() const {
  if (viewpoint.empty())
    return std::nullopt;
  if (!finite(viewpoint))
    throw UsageError("--viewpoint wants three finite numbers.");
  return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(viewpoint.data()));
}

std::optional<TableModel> FrameOptions::tableOf() const {
  if (table.empty())
    return std::nullopt;
  const Eigen::Map<const Eigen::Vector3d> normal(table.data());
  const double length = normal.norm();
  if (!finite(table) || !(length > 1e-9))
    throw UsageError("--table wants finite numbers and a normal that is not zero.");
  TableModel plane;
  plane.normal = normal / length;
  plane.offset = table[3] / length;
  return plane;
}

std::optional<Eigen::Vector3d> FrameOptions::upOf() const {
  if (up.empty())
    return std::nullopt;
  const bool negative = up.size() == 2 && up[0] == '-';
  if (up.size() == (negative ? 2u : 1u) && up.back() >= 'x' && up.back() <= 'z') {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(up.back() - 'x');
    return negative ? Eigen::Vector3d(-axis) : axis;
  }
  Eigen::Vector3d direction;
  char rest = 0;
  if (std::sscanf(up.c_str(),
                  "%lf,%lf,%lf%c",
                  &direction.x(),
                  &direction.y(),
                  &direction.z(),
                  &rest) != 3)
    throw UsageError("--up " + up +
                     " is neither an axis (x, -x, y, ...) nor three numbers.");
  if (!direction.allFinite() || !(direction.norm() > 1e-9))
    throw UsageError("--up wants finite numbers that are not all zero.");
  return direction;
}

void checkFrame(const FrameOptions& options) {
  constexpr double MOST = 30.0; // [degrees] what a hand-written direction may be off
  const auto table = options.tableOf();
  const auto up = options.upOf();
  if (!table || !up)
    return;
  const double off =
      std::acos(std::clamp(table->normal.dot(up->normalized()), -1.0, 1.0)) * 180.0 /
      M_PI;
  if (off > MOST)
    throw UsageError("--table and --up contradict each other: the table's normal is " +
                     std::to_string(std::lround(off)) +
                     " degrees from up; give one of them.");
}

void addFrameOptions(CLI::App& cli, FrameOptions& options) {
  const auto numbers = [&cli](const char* name,
                              std::vector<double>& values,
                              int count,
                              const char* type,
                              const char* description) {
    cli.add_option(name, values, description)
        ->expected(count)
        ->delimiter(',')
        ->type_name(type)
        ->check(number(-FARTHEST, FARTHEST));
  };
  numbers("--viewpoint",
          options.viewpoint,
          3,
          "X,Y,Z",
          "Camera's place in the cloud's frame [m]; else from an organized cloud's "
          "rays, the file's VIEWPOINT, or the origin where the points look so");
  numbers("--table",
          options.table,
          4,
          "NX,NY,NZ,D",
          "Table n.p + d = 0 in the cloud's frame, n away from the ground; else found");
  cli.add_option("--up",
                 options.up,
                 "Direction away from the ground in the cloud's frame: the table lies "
                 "across it, pictures stand on it; else an image's top")
      ->type_name("x|-x|y|-y|z|-z|X,Y,Z");
}

} // namespace pcl_sq::app

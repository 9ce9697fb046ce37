// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/app.h"
#include "files/files.h"
#include "files/gripper_file.h"
#include "model/grasp_output.h"

#include "command_line/value_checks.h"
#include "pcl_sq/graspit_export.h"

#include <nlohmann/json.hpp>

namespace pcl_sq::app {

namespace {

std::string presetList() {
  std::string list;
  for (const std::string& name : Gripper::presetNames())
    list += (list.empty() ? "" : ", ") + name;
  return list;
}

/** \brief The camera's place that the report of a model file tells of, if it is known.
 */
std::optional<Eigen::Vector3d> knownSensor(const ModelFile& file) {
  const auto extra = nlohmann::json::parse(file.extra_json);
  const auto report = extra.value("report", nlohmann::json::object());
  if (!report.is_object() || !report.contains("sensor_known") ||
      report["sensor_known"] != true || !report.contains("sensor"))
    return std::nullopt;
  const auto& place = report["sensor"];
  if (!place.is_array() || place.size() != 3 || !place[0].is_number() ||
      !place[1].is_number() || !place[2].is_number())
    return std::nullopt;
  return Eigen::Vector3d(place[0], place[1], place[2]);
}

} // namespace

GraspOptions::GraspOptions() {
  planner.count = 10;
  planner.wrench_quality = true;
}

void addGripperOptions(CLI::App& cli, GraspOptions& options) {
  cli.add_option_function<std::string>(
         "--gripper",
         [&options](const std::string& name) { options.gripper = readGripper(name); },
         "Hand: " + presetList() + ", or a TOML file with its sizes [m]")
      ->type_name("NAME|FILE")
      ->default_str(options.gripper.name);
  cli.add_option("--friction",
                 options.planner.friction,
                 "Coefficient between finger and object")
      ->check(number(0.05, 2.0))
      ->capture_default_str();
  cli.add_option("--clearance",
                 options.planner.clearance,
                 "Least distance of the hand to table and obstacles [m]")
      ->check(number(0.0, 1.0))
      ->capture_default_str();
  cli.add_option("--min-observed",
                 options.planner.min_observed,
                 "Least share of the contacts that the camera saw")
      ->check(number(0.0, 1.0))
      ->capture_default_str();
}

void addGraspOutputOptions(CLI::App& cli, GraspOptions& options) {
  cli.add_option("-o,--output", options.output, "Grasps as JSON; -: standard output")
      ->type_name("FILE");
  cli.add_option("--count", options.planner.count, "Most grasps to give")
      ->check(wholeNumber(1, 10000))
      ->capture_default_str();
  cli.add_option(
         "--graspit",
         options.graspit,
         "GraspIt! folder (the one GRASPIT points to) for a world, the body, its "
         "table and the grasps as lines for the Barrett hand; friction is not "
         "among them, and gravity there is along -z")
      ->type_name("DIR");
  cli.add_option(
         "--graspit-name",
         options.graspit_name,
         "Name of GraspIt!'s files, by default that of the input; only files of "
         "the same name are replaced")
      ->type_name("NAME")
      ->check([](const std::string& name) {
        GraspitOptions settings;
        settings.name = name;
        return settings.isValid()
                   ? std::string()
                   : std::string("a name has letters, digits, _ and - only");
      });
  cli.add_flag("--graspit-parts",
               options.part_bodies,
               "One more GraspIt! body for each part, and a world with them");
  cli.add_option("--html", options.html, "Page to turn in a browser, with the grasps")
      ->type_name("FILE");
#ifdef PCL_SQ_HAVE_VISUALIZATION
  cli.add_option("--snapshot", options.snapshot, "Picture with the hand as PNG")
      ->type_name("FILE");
#endif
}

void checkGraspOptions(const GraspOptions& options) {
  std::string why;
  if (!options.planner.isValid(&why))
    throw UsageError(why);
  (void)options.frame.tableOf(); // refuse what makes no sense before the work
  (void)options.frame.viewpointOf();
  (void)options.frame.upOf();
  claimOutput("--output", options.output);
  if (!options.graspit.empty())
    claimFolder(options.graspit);
  claimOutput("--snapshot", options.snapshot, {".png"});
  claimOutput("--html", options.html, {".html", ".htm"});
}

GraspScene makeScene(const GraspOptions& options,
                     const ModelFile& file,
                     const LoadedCloud* cloud) {
  GraspScene scene;
  if (const auto table = options.frame.tableOf()) {
    scene.has_table = true;
    scene.table_normal = table->normal;
    scene.table_offset = table->offset;
  } else if (file.table) {
    const auto& t = *file.table;
    scene.has_table = true;
    scene.table_normal = Eigen::Vector3d(t[0], t[1], t[2]);
    scene.table_offset = t[3];
  }
  std::optional<Eigen::Vector3d> viewpoint = options.frame.viewpointOf();
  if (!viewpoint)
    viewpoint = knownSensor(file);
  if (!viewpoint && cloud) {
    if ((viewpoint = viewpointOf(*cloud)))
      *viewpoint += cloud->offset;
  }
  if (viewpoint) {
    scene.has_viewpoint = true;
    scene.viewpoint = *viewpoint;
  }
  return scene;
}

Eigen::Matrix3Xd columnsOf(const LoadedCloud& input) {
  Eigen::Matrix3Xd points(3, Eigen::Index(input.cloud->size()));
  for (std::size_t i = 0; i < input.cloud->size(); ++i)
    points.col(Eigen::Index(i)) =
        (*input.cloud)[i].getVector3fMap().cast<double>() + input.offset;
  return points;
}

} // namespace pcl_sq::app

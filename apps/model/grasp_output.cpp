// SPDX-License-Identifier: BSD-3-Clause
#include "model/grasp_output.h"

#include "command_line/app.h"
#include "files/files.h"
#include "files/graspit_folder.h"
#include "options/offset.h"

#include "pcl_sq/config.h"
#include "pcl_sq/grasp_quality.h"

#ifdef PCL_SQ_HAVE_VISUALIZATION
#include "pcl_sq/visualization/snapshot_renderer.h"
#endif

#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>

namespace pcl_sq::app {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Json toJson(const Eigen::Matrix3d& m) {
  return {toJson(Eigen::Vector3d(m.row(0))),
          toJson(Eigen::Vector3d(m.row(1))),
          toJson(Eigen::Vector3d(m.row(2)))};
}

Json toJson(const Gripper& g) {
  return {{"name", g.name},
          {"fingers", g.fingers},
          {"min_opening", g.min_opening},
          {"max_opening", g.max_opening},
          {"finger_length", g.finger_length},
          {"finger_width", g.finger_width},
          {"finger_thickness", g.finger_thickness},
          {"pad_length", g.pad_length},
          {"palm_width", g.palm_width},
          {"palm_depth", g.palm_depth},
          {"palm_height", g.palm_height}};
}

Json toJson(const GraspScores& s) {
  return {{"total", s.total},
          {"antipodal", s.antipodal},
          {"robustness", s.robustness},
          {"observed", s.observed},
          {"centre", s.centre},
          {"clearance", s.clearance},
          {"approach", s.approach},
          {"opening", s.opening}};
}

Json toJson(const Grasp& grasp) {
  Json contacts = Json::array();
  for (const GraspContact& contact : grasp.contacts)
    contacts.push_back({{"position", toJson(contact.position)},
                        {"normal", toJson(contact.normal)},
                        {"part", contact.part},
                        {"observed", contact.observed}});
  return {{"position", toJson(grasp.position)},
          {"rotation", toJson(grasp.rotation)},
          {"approach", toJson(grasp.approach())},
          {"closing", toJson(grasp.closing())},
          {"width", grasp.width},
          {"open_width", grasp.open_width},
          {"contacts", contacts},
          {"scores", toJson(grasp.scores)},
          {"epsilon", grasp.epsilon},
          {"volume", grasp.volume}};
}

Json toJson(const GraspRejections& r) {
  return {{"candidates", r.candidates},
          {"too_wide", r.too_wide},
          {"too_narrow", r.too_narrow},
          {"unseen", r.unseen},
          {"slipping", r.slipping},
          {"poses", r.poses},
          {"table", r.table},
          {"object", r.object},
          {"obstacle", r.obstacle},
          {"cloud", r.cloud}};
}

#ifdef PCL_SQ_HAVE_VISUALIZATION
constexpr std::size_t SHOWN = 20; ///< grasps beside the best, as forks

/** \brief A hand as a fork of lines: palm, two or three fingers. */
void addFork(const Grasp& grasp, const Gripper& gripper, Eigen::Matrix3Xd& lines) {
  const double palm = gripper.finger_length - 0.5 * gripper.pad_length;
  const Eigen::Vector3d back = -palm * grasp.approach();
  const Eigen::Vector3d middle = grasp.position + back;
  const Eigen::Index first = lines.cols();
  lines.conservativeResize(3, first + 2 + 4 * Eigen::Index(grasp.contacts.size()));
  Eigen::Index at = first;
  const auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    lines.col(at++) = a;
    lines.col(at++) = b;
  };
  add(middle, middle - 0.4 * palm * grasp.approach());
  for (const GraspContact& contact : grasp.contacts) {
    const Eigen::Vector3d depth =
        grasp.approach() * grasp.approach().dot(contact.position - grasp.position);
    const Eigen::Vector3d knuckle = contact.position - depth + back;
    add(middle, knuckle);
    add(knuckle, contact.position);
  }
}

void writeGraspPicture(const MultiSuperquadric& model,
                       const GraspPlan& plan,
                       const GraspScene& scene,
                       const GraspOptions& options) {
  SnapshotOptions settings;
  if (scene.has_table)
    settings.up = scene.table_normal;
  const Grasp& best = plan.grasps.front();
  char caption[160];
  std::snprintf(caption,
                sizeof caption,
                "best of %zu grasps with %s: width %.1f mm, score %.2f",
                plan.grasps.size(),
                options.gripper.name.c_str(),
                1e3 * best.width,
                best.scores.total);
  settings.caption = caption;
  SnapshotRenderer renderer(settings);
  if (scene.cloud.cols() > 0)
    renderer.addCloud(scene.cloud);
  renderer.addModel(model);
  if (!scene.obstacles.empty())
    renderer.addMesh(scene.obstacles.meshParts(), {150, 150, 150}, 0.6);
  std::vector<double> reach;
  Eigen::Matrix3Xd contacts(3, Eigen::Index(best.contacts.size()));
  for (int i = 0; i < options.gripper.fingers; ++i) {
    contacts.col(i) = best.contacts[std::size_t(i)].position;
    reach.push_back(options.gripper.fingerDirection(best.rotation, i)
                        .dot(contacts.col(i) - best.position));
  }
  std::vector<OrientedBox> hand =
      options.gripper.boxes(best.position, best.rotation, reach);
  renderer.addMesh(meshBox(hand.back()), {150, 155, 165}, 0.3);
  hand.pop_back();
  for (const OrientedBox& finger : hand)
    renderer.addMesh(meshBox(finger), {110, 115, 125}, 0.8);
  Eigen::Matrix3Xd forks(3, 0);
  for (std::size_t i = 1; i < std::min(plan.grasps.size(), SHOWN + 1); ++i)
    addFork(plan.grasps[i], options.gripper, forks);
  if (forks.cols() > 0)
    renderer.addLines(forks, {120, 160, 120}, 1.5);
  renderer.addPoints(contacts, {220, 30, 30}, 12.0);
  renderer.save(options.snapshot);
  noteWritten(options.snapshot);
}
#endif

void writeGraspit(const MultiSuperquadric& model,
                  const GraspPlan& plan,
                  const GraspScene& scene,
                  const GraspOptions& options) {
  GraspitOptions settings;
  settings.part_bodies = options.part_bodies;
  settings.has_table = scene.has_table;
  settings.table_normal = scene.table_normal;
  settings.table_offset = scene.table_offset;
  settings.grasps = plan.grasps;
  settings.gripper = options.gripper;
  settings.name = options.graspit_name;
  settings.obstacles = scene.obstacles;
  settings.retreat = options.planner.retreat;
  writeGraspitFolder(options.graspit, settings.name, graspitFiles(model, settings));
}

} // namespace

GraspPlan planGrasps(const MultiSuperquadric& model,
                     const GraspScene& scene,
                     const GraspOptions& options,
                     double& milliseconds) {
  const auto start = std::chrono::steady_clock::now();
  const GraspPlanner planner(options.gripper, options.planner);
  const Eigen::Vector3d offset = offsetOf(model);
  GraspPlan plan =
      offset.isZero()
          ? planner.plan(model, scene)
          : moved(planner.plan(moved(model, -offset), moved(scene, -offset)), offset);
  milliseconds = std::chrono::duration<double, std::milli>(
                     std::chrono::steady_clock::now() - start)
                     .count();
  return plan;
}

std::string graspsToJson(const GraspPlan& plan,
                         const GraspScene& scene,
                         const GraspOptions& options,
                         const std::string& frame,
                         const std::string& model_path,
                         double milliseconds) {
  Json json;
  json["schema"] = "pcl_sq/grasps";
  json["version"] = 1;
  json["unit"] = "m";
  json["frame"] = frame;
  json["model"] = model_path;
  json["gripper"] = toJson(options.gripper);
  json["friction"] = options.planner.friction;
  if (scene.has_table)
    json["table"] = {scene.table_normal.x(),
                     scene.table_normal.y(),
                     scene.table_normal.z(),
                     scene.table_offset};
  const Eigen::Vector3d& origin = plan.wrench_origin;
  json["wrench"] = {
      {"origin", {origin.x(), origin.y(), origin.z()}},
      {"torque_length", plan.wrench_length},
      {"torsional_friction",
       softFingerTorsion(options.planner.friction, options.planner.patch_radius)}};
  json["grasps"] = Json::array();
  for (const Grasp& grasp : plan.grasps)
    json["grasps"].push_back(toJson(grasp));
  json["rejections"] = toJson(plan.rejections);
  json["timings_ms"] = {{"plan", milliseconds}};
  json["generator"] = "pcl_sq " PCL_SQ_VERSION;
  // names may hold bytes that are not UTF-8
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

void addGrasps(const GraspPlan& plan, const GraspOptions& options, ModelFile& file) {
  Json extra = Json::parse(file.extra_json);
  extra["gripper"] = toJson(options.gripper);
  extra["grasps"] = Json::array();
  for (const Grasp& grasp : plan.grasps)
    extra["grasps"].push_back(toJson(grasp));
  file.extra_json = extra.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void writeGraspOutputs(const MultiSuperquadric& model,
                       const GraspPlan& plan,
                       const GraspScene& scene,
                       const GraspOptions& options,
                       const std::string& json) {
  if (!options.output.empty())
    writeOutput(options.output, json + "\n");
  if (!options.graspit.empty())
    writeGraspit(model, plan, scene, options);
#ifdef PCL_SQ_HAVE_VISUALIZATION
  const Eigen::Vector3d near = -offsetOf(model);
  if (!options.snapshot.empty())
    writeGraspPicture(
        moved(model, near), moved(plan, near), moved(scene, near), options);
#endif
}

void printGrasps(const GraspPlan& plan,
                 const GraspOptions& options,
                 double milliseconds) {
  std::printf("%zu grasps with %s, friction %.2f, in %.1f ms\n",
              plan.grasps.size(),
              options.gripper.name.c_str(),
              options.planner.friction,
              milliseconds);
  std::printf("  rank  score  antip robust  seen centre clear apprch | width  part  "
              "epsilon  tool centre point [mm]\n");
  for (std::size_t i = 0; i < plan.grasps.size(); ++i) {
    const Grasp& g = plan.grasps[i];
    const GraspScores& s = g.scores;
    std::printf("  %4zu  %5.3f  %5.2f  %5.2f %5.2f  %5.2f %5.2f  %5.2f | %5.1f  %4zu  "
                "%7.4f  %8.1f %7.1f %7.1f\n",
                i + 1,
                s.total,
                s.antipodal,
                s.robustness,
                s.observed,
                s.centre,
                s.clearance,
                s.approach,
                1e3 * g.width,
                g.contacts.front().part + 1,
                g.epsilon,
                1e3 * g.position.x(),
                1e3 * g.position.y(),
                1e3 * g.position.z());
  }
}

} // namespace pcl_sq::app

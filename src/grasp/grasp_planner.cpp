// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/grasp_planner.h"

#include "grasp/grasp_search.h"
#include "pcl_sq/grasp_quality.h"
#include "quality/largest_radius.h"

#include <algorithm>
#include <sstream>

namespace pcl_sq {

namespace {

const char* nameOf(detail::Obstruction obstruction) {
  switch (obstruction) {
  case detail::Obstruction::TABLE:
    return "the table";
  case detail::Obstruction::OBJECT:
    return "the object itself";
  case detail::Obstruction::OBSTACLE:
    return "another object";
  case detail::Obstruction::CLOUD:
    return "measured points";
  case detail::Obstruction::NONE:
    break;
  }
  return "nothing";
}

std::string millimetres(double metres) {
  std::ostringstream text;
  text.precision(1);
  text << std::fixed << 1000.0 * metres << " mm";
  return text.str();
}

} // namespace

bool GraspPlannerOptions::isValid(std::string* why) const {
  const auto fail = [why](const char* sentence) {
    if (why)
      *why = sentence;
    return false;
  };
  const auto within = [](double value, double low, double high) {
    return value >= low && value <= high; // false for NaN
  };
  if (count < 1 || count > 10000)
    return fail("count is outside [1, 10000]");
  if (!within(friction, 0.05, 2.0))
    return fail("friction is outside [0.05, 2]");
  if (surface_samples < 1 || surface_samples > 20)
    return fail("surface_samples is outside [1, 20]");
  if (approaches < 1 || approaches > 72)
    return fail("approaches is outside [1, 72]");
  for (const double length : {clearance,
                              compliance,
                              opening,
                              margin,
                              retreat,
                              shift,
                              min_distance,
                              cloud_tolerance,
                              observed_distance,
                              patch_radius})
    if (!within(length, 0.0, 1.0))
      return fail("a length is outside [0, 1] m");
  if (opening <= 0.0)
    return fail("opening is not positive");
  if (min_distance <= 0.0 || !within(min_angle, 1e-3, 3.2))
    return fail("min_distance or min_angle is not positive");
  if (observed_distance <= 0.0)
    return fail("observed_distance is not positive");
  if (!within(min_observed, 0.0, 1.0))
    return fail("min_observed is outside [0, 1]");
  if (min_obstacle_points < 1 || min_obstacle_points > 1000)
    return fail("min_obstacle_points is outside [1, 1000]");
  double sum = 0.0;
  for (const double weight : {weights.antipodal,
                              weights.robustness,
                              weights.observed,
                              weights.centre,
                              weights.clearance,
                              weights.approach,
                              weights.opening}) {
    if (!within(weight, 0.0, 1e6))
      return fail("a weight is negative");
    sum += weight;
  }
  if (sum <= 0.0)
    return fail("all weights are zero");
  return true;
}

GraspPlanner::GraspPlanner(const Gripper& gripper, const GraspPlannerOptions& options)
    : gripper_(gripper), options_(options) {}

GraspPlan GraspPlanner::plan(const MultiSuperquadric& object,
                             const GraspScene& scene) const {
  GraspPlan plan;
  const auto fail = [&plan](const std::string& sentence) {
    plan.failure = "[pcl_sq::GraspPlanner::plan] " + sentence;
    return plan;
  };
  std::string why;
  if (!gripper_.isValid(&why))
    return fail("the gripper is not usable: " + why + "; correct its sizes.");
  if (!options_.isValid(&why))
    return fail("an option is out of range: " + why + ".");
  if (object.empty())
    return fail("the model has no parts; fit one to a cloud first.");
  for (const MultiSuperquadric* model : {&object, &scene.obstacles})
    for (const Superquadric& part : model->parts)
      if (!part.isValid(&why))
        return fail("a part is not a superquadric: " + why + "; fit it again.");
  if (scene.has_table && !(std::abs(scene.table_normal.norm() - 1.0) < 1e-3 &&
                           std::isfinite(scene.table_offset)))
    return fail("the table's normal is not of unit length; normalise the plane.");
  detail::GraspSearch search(object, scene, gripper_, options_);
  search.run(plan);
  return plan;
}

namespace detail {

void GraspSearch::finish(GraspPlan& plan) const {
  std::stable_sort(
      plan.grasps.begin(), plan.grasps.end(), [](const Grasp& a, const Grasp& b) {
        return a.scores.total > b.scores.total;
      });
  plan.wrench_origin = centre_;
  plan.wrench_length = largestRadius(object_, centre_);
  if (!options_.wrench_quality)
    return;
  WrenchOptions wrench;
  wrench.friction = options_.friction;
  wrench.torsional_friction =
      softFingerTorsion(options_.friction, options_.patch_radius);
  wrench.origin = centre_;
  wrench.torque_length = plan.wrench_length;
  for (Grasp& grasp : plan.grasps) {
    const WrenchQuality quality = wrenchQuality(grasp.contacts, wrench);
    grasp.epsilon = quality.epsilon;
    grasp.volume = quality.volume;
  }
}

std::string
GraspSearch::explain(const GraspPlan& plan, double narrowest, double widest) const {
  const GraspRejections& r = plan.rejections;
  std::ostringstream text;
  text << "[pcl_sq::GraspPlanner::plan] no grasp: ";
  if (r.poses > 0) {
    text << "each of " << r.poses << " poses of " << gripper_.name << " collides ("
         << r.table << " with the table, " << r.object << " with the object, "
         << r.obstacle << " with other objects, " << r.cloud
         << " with measured points); nearest miss: a grasp of width "
         << millimetres(miss_.grasp.width) << " on part "
         << miss_.grasp.contacts.front().part + 1 << " blocked by "
         << nameOf(miss_.obstruction) << "; use a slimmer gripper or clear the scene.";
  } else if (r.unseen > 0) {
    text << "the contacts of all " << r.unseen
         << " closing lines lie on surface that was not seen; look at the object from "
         << "another side or lower min_observed (now " << options_.min_observed << ").";
  } else if (r.too_wide > 0) {
    text << "the object is too wide for " << gripper_.name
         << "; nearest miss: opposite "
         << "surfaces " << millimetres(narrowest) << " apart where the gripper holds "
         << millimetres(gripper_.max_opening - 2.0 * options_.compliance)
         << " at most; use a gripper that opens wider.";
  } else if (r.too_narrow > 0) {
    text << "the object is too thin for " << gripper_.name
         << "; nearest miss: opposite "
         << "surfaces " << millimetres(widest) << " apart where the gripper closes to "
         << millimetres(gripper_.min_opening) << "; use a gripper that closes farther.";
  } else {
    text << "no two surfaces are opposite within friction " << options_.friction
         << "; use a gripper with more friction.";
  }
  return text.str();
}

} // namespace detail

} // namespace pcl_sq

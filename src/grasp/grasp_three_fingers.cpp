// SPDX-License-Identifier: BSD-3-Clause
// Contact sets for hands whose three fingers close on one axis. Three forces of equal
// size, 120 degrees apart in a plane and concurrent, balance; the set is force closed
// if each lies inside of its contact's friction cone.
#include "grasp/grasp_search.h"

#include <algorithm>
#include <limits>

namespace pcl_sq::detail {

namespace {

constexpr int TURNS = 6;           ///< of the hand within 120 degrees
constexpr int LEVELS = 5;          ///< planes along each axis of a part
constexpr double SPREAD = 0.7;     ///< share of the axis the planes cover
constexpr double MAX_UNEVEN = 0.3; ///< spread of the fingers over the largest reach

} // namespace

std::vector<Grasp> GraspSearch::contactSets(GraspRejections& rejections,
                                            double& narrowest) const {
  const ClosingLines finder(
      object_, options_, gripper_.finger_thickness + options_.opening);
  std::vector<Grasp> found;
  narrowest = std::numeric_limits<double>::infinity();
  const int poses = 6 * LEVELS * TURNS;
  for (std::size_t k = 0; k < object_.size(); ++k)
    for (int pose = 0; pose < poses; ++pose) {
      const Superquadric& part = object_.parts[k];
      const int axis = pose % 6, level = pose / 6 % LEVELS, turn = pose / 6 / LEVELS;
      const double sign = axis < 3 ? 1.0 : -1.0;
      const double along =
          SPREAD * part.semi_axes[axis % 3] * (2.0 * level / (LEVELS - 1) - 1.0);
      Grasp grasp;
      const Eigen::Vector3d z = sign * part.rotation.col(axis % 3);
      const Eigen::Vector3d y = Eigen::AngleAxisd(2.0 * M_PI / 3.0 * turn / TURNS, z) *
                                part.rotation.col((axis + 1) % 3);
      grasp.rotation << y.cross(z), y, z;
      grasp.position = part.center + along * part.rotation.col(axis % 3);
      double slope = 0.0, largest = 0.0, smallest = 1e9, robustness = 0.0;
      for (int finger = 0; finger < 3; ++finger) {
        const Eigen::Vector3d outward =
            gripper_.fingerDirection(grasp.rotation, finger);
        ClosingLine line;
        if (!finder.cast(grasp.position, outward, k, line))
          break;
        GraspContact contact;
        contact.position = line.points[1];
        contact.normal = line.normals[1];
        contact.part = line.parts[1];
        contact.observed = measured_.observed(contact);
        grasp.contacts.push_back(contact);
        const double cosine = outward.dot(contact.normal);
        slope = std::max(slope,
                         cosine > 1e-3
                             ? std::sqrt(std::max(1.0 - cosine * cosine, 0.0)) / cosine
                             : 1e3);
        const double reach = outward.dot(contact.position - grasp.position);
        largest = std::max(largest, reach);
        smallest = std::min(smallest, reach);
        robustness += finder.robustness(contact.position, outward, contact.part) / 3.0;
      }
      ++rejections.candidates;
      grasp.width = 2.0 * largest;
      if (grasp.contacts.size() < 3 || slope > options_.friction ||
          largest - smallest > MAX_UNEVEN * largest) {
        ++rejections.slipping;
      } else if (grasp.width > gripper_.max_opening - 2.0 * options_.compliance) {
        ++rejections.too_wide;
        narrowest = std::min(narrowest, grasp.width);
      } else if (grasp.width < gripper_.min_opening) {
        ++rejections.too_narrow;
      } else {
        scoreContacts(grasp, slope, robustness);
        scorePose(grasp, 1.0);
        if (grasp.scores.observed < options_.min_observed)
          ++rejections.unseen;
        else
          found.push_back(grasp);
      }
    }
  return found;
}

void GraspSearch::runThreeFingers(GraspPlan& plan) {
  double narrowest;
  std::vector<Grasp> sets = contactSets(plan.rejections, narrowest);
  std::stable_sort(sets.begin(), sets.end(), [](const Grasp& a, const Grasp& b) {
    return a.scores.total > b.scores.total;
  });
  for (const double scale : {1.0, 0.5})
    for (std::size_t i = 0; i < sets.size() && plan.grasps.size() < options_.count; ++i)
      if (isNew(sets[i], plan.grasps, scale) && place(sets[i], plan))
        plan.grasps.push_back(sets[i]);
  if (plan.grasps.empty())
    plan.failure = explain(plan, narrowest, 0.0);
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// The terms by which grasps are ranked, and how near a hand comes to what was measured.
#include "grasp/grasp_search.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

constexpr double GOOD_CLEARANCE = 0.03; ///< table distance that scores 1 [m]
constexpr double GOOD_OPENING = 0.02;   ///< spare opening that scores 1 [m]

} // namespace

double GraspSearch::total(const GraspScores& s) const {
  const GraspWeights& w = options_.weights;
  const double sum = w.antipodal + w.robustness + w.observed + w.centre + w.clearance +
                     w.approach + w.opening;
  return (w.antipodal * s.antipodal + w.robustness * s.robustness +
          w.observed * s.observed + w.centre * s.centre + w.clearance * s.clearance +
          w.approach * s.approach + w.opening * s.opening) /
         sum;
}

void GraspSearch::scoreContacts(Grasp& grasp, double slope, double robustness) const {
  GraspScores& s = grasp.scores;
  s.antipodal = std::max(1.0 - slope / options_.friction, 0.0);
  s.robustness = robustness;
  s.observed = 0.0;
  for (const GraspContact& contact : grasp.contacts)
    s.observed += contact.observed / double(grasp.contacts.size());
  const Eigen::Vector3d lever = centre_ - grasp.contacts[0].position;
  const Eigen::Vector3d line =
      grasp.contacts.size() == 2
          ? (grasp.contacts[1].position - grasp.contacts[0].position).normalized()
          : grasp.approach();
  const Eigen::Vector3d from =
      grasp.contacts.size() == 2 ? lever : centre_ - grasp.position;
  const double distance = (from - line * line.dot(from)).norm();
  s.centre = std::max(1.0 - distance / radius_, 0.0);
  s.opening = std::clamp((gripper_.max_opening - grasp.width) / GOOD_OPENING, 0.0, 1.0);
  s.clearance = s.approach = 1.0;
  s.total = total(s);
}

void GraspSearch::scorePose(Grasp& grasp, double table_clearance) const {
  GraspScores& s = grasp.scores;
  s.clearance =
      scene_.has_table ? std::clamp(table_clearance / GOOD_CLEARANCE, 0.0, 1.0) : 1.0;
  if (grasp.open_width > 0.0)
    s.opening =
        std::min(0.5 * (grasp.open_width - grasp.width) / options_.opening, 1.0);
  s.approach = scene_.has_table || scene_.has_viewpoint
                   ? 0.5 * (1.0 + grasp.approach().dot(favoured_))
                   : 1.0;
  s.total = total(s);
}

bool GraspSearch::openHandTouches(const Grasp& grasp, double opening) const {
  std::vector<double> reach;
  for (int i = 0; i < gripper_.fingers; ++i)
    reach.push_back(opening +
                    gripper_.fingerDirection(grasp.rotation, i)
                        .dot(grasp.contacts[std::size_t(i)].position - grasp.position));
  const std::vector<OrientedBox> boxes =
      gripper_.boxes(grasp.position, grasp.rotation, reach);
  return std::any_of(boxes.begin(), boxes.end() - 1, [&](const OrientedBox& finger) {
    return measured_.meets(finger, std::min(options_.clearance, 0.5 * opening));
  });
}

bool GraspSearch::tipsTouch(const Grasp& grasp) const {
  Grasp ahead = grasp;
  ahead.position += options_.margin * grasp.approach();
  const std::vector<OrientedBox> boxes =
      collision_.boxes(ahead, 0.5 * (grasp.open_width - grasp.width));
  return std::any_of(boxes.begin(), boxes.end() - 1, [&](const OrientedBox& finger) {
    return collision_.test(finger, 0.0) == Obstruction::OBJECT;
  });
}

} // namespace pcl_sq::detail

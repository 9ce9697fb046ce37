// SPDX-License-Identifier: BSD-3-Clause
// Best-first search: a line enters the queue with the score it would have if every
// costly term were perfect, so that those terms are computed for the few lines only
// that can still be among the best.
#include "grasp/grasp_search.h"

#include <algorithm>
#include <queue>

namespace pcl_sq::detail {

namespace {

constexpr double OPENINGS[] = {1.0, 1.0 / 3.0}; ///< of the gap asked for
constexpr double SLIDES[] = {0.0, 0.35}; ///< of the pad, contacts towards the tip

/** \brief Counts an obstruction and hands it on. */
Obstruction counted(GraspRejections& rejections, Obstruction found) {
  switch (found) {
  case Obstruction::TABLE:
    ++rejections.table;
    break;
  case Obstruction::OBJECT:
    ++rejections.object;
    break;
  case Obstruction::OBSTACLE:
    ++rejections.obstacle;
    break;
  case Obstruction::CLOUD:
    ++rejections.cloud;
    break;
  case Obstruction::NONE:
    break;
  }
  return found;
}

} // namespace

GraspSearch::GraspSearch(const MultiSuperquadric& object,
                         const GraspScene& scene,
                         const Gripper& gripper,
                         const GraspPlannerOptions& options)
    : object_(object), scene_(scene), gripper_(gripper), options_(options),
      measured_(object, scene, options),
      collision_(object, scene, gripper, options, measured_) {
  double volume = 0.0;
  centre_.setZero();
  for (const Superquadric& part : object.parts) {
    volume += part.volume();
    centre_ += part.volume() * part.centerOfGravity();
  }
  centre_ /= volume;
  radius_ = 0.0;
  for (const Superquadric& part : object.parts)
    radius_ =
        std::max(radius_, (part.center - centre_).norm() + part.halfSizes().norm());
  favoured_.setZero();
  if (scene.has_table)
    favoured_ -= scene.table_normal;
  if (scene.has_viewpoint)
    favoured_ += (centre_ - scene.viewpoint).normalized();
  if (favoured_.norm() < 1e-6)
    favoured_ = -object.parts.front().rotation.col(2);
  favoured_.normalize();
  for (int a = 0; a < options.approaches; ++a) {
    const double angle = 2.0 * M_PI * a / options.approaches;
    turns_.emplace_back(std::cos(angle), std::sin(angle));
  }
}

Eigen::Matrix3d GraspSearch::handFrame(const Eigen::Vector3d& axis,
                                       int approach) const {
  Eigen::Vector3d z = favoured_ - axis * axis.dot(favoured_);
  z = z.norm() > 0.05 ? z.normalized() : across(axis, object_.parts.front().rotation);
  const Eigen::Vector2d& turn = turns_[std::size_t(approach)];
  z = turn.x() * z + turn.y() * axis.cross(z);
  Eigen::Matrix3d frame;
  frame << axis.cross(z), axis, z;
  return frame;
}

bool GraspSearch::isNew(const Grasp& grasp,
                        const std::vector<Grasp>& taken,
                        double scale) const {
  const double d2 = scale * scale * options_.min_distance * options_.min_distance;
  const double a2 = scale * scale * options_.min_angle * options_.min_angle;
  for (const Grasp& other : taken) {
    const double position = (grasp.position - other.position).squaredNorm() / d2;
    if (position >= 1.0)
      continue;
    // 2 - 2 cos is the squared angle nearly; two jaws are the same upside down
    const double closing = grasp.closing().dot(other.closing());
    const double turn = gripper_.fingers == 2 ? 2.0 - 2.0 * std::abs(closing) : 0.0;
    const double tilt = 2.0 - 2.0 * grasp.approach().dot(other.approach());
    if (position + turn / a2 + 0.25 * tilt / a2 < 1.0)
      return false;
  }
  return true;
}

double GraspSearch::opening(const Grasp& grasp, double share) const {
  return std::min(share * options_.opening, 0.5 * (gripper_.max_opening - grasp.width));
}

Grasp GraspSearch::slid(const Grasp& grasp, double slide) const {
  Grasp moved = grasp;
  moved.position -= slide * gripper_.pad_length * grasp.approach();
  return moved;
}

std::vector<OrientedBox> GraspSearch::handAt(const Grasp& grasp) const {
  Grasp own = grasp; // in the hand's frame, where it is the same for each approach
  own.rotation.setIdentity();
  own.position.setZero();
  for (std::size_t c = 0; c < 2; ++c)
    own.contacts[c].position =
        (c == 0 ? 0.5 : -0.5) * grasp.width * Eigen::Vector3d::UnitY();
  return collision_.boxes(
      own, opening(grasp, *std::min_element(std::begin(OPENINGS), std::end(OPENINGS))));
}

double GraspSearch::bestTableClearance(const Grasp& grasp,
                                       const std::vector<OrientedBox>& hand) const {
  if (!scene_.has_table)
    return 1.0;
  const Eigen::Vector3d up = grasp.rotation.transpose() * scene_.table_normal;
  const double height = scene_.table_normal.dot(grasp.position) + scene_.table_offset;
  double lowest = 1.0;
  for (const OrientedBox& box : hand)
    lowest = std::min(lowest, height - box.support(-up));
  // drawing the hand back moves all of its boxes alike
  const double rise = -grasp.approach().dot(scene_.table_normal);
  const double back =
      rise > 0.0 ? *std::max_element(std::begin(SLIDES), std::end(SLIDES)) : 0.0;
  return lowest + back * gripper_.pad_length * rise;
}

Obstruction GraspSearch::tryPose(Grasp& grasp, double& table) const {
  Obstruction found = Obstruction::NONE;
  bool palm_is_free = false; // for one opening as for the other
  for (const double share : OPENINGS) {
    const std::vector<OrientedBox> boxes =
        collision_.boxes(grasp, opening(grasp, share));
    table = collision_.tableClearance(boxes);
    found = table < options_.clearance ? Obstruction::TABLE : Obstruction::NONE;
    if (found == Obstruction::NONE && !palm_is_free) {
      found = collision_.test(boxes.back(), options_.margin);
      if (found == Obstruction::NONE &&
          measured_.meets(boxes.back(), options_.clearance))
        found = Obstruction::OBJECT;
      if (found != Obstruction::NONE)
        return found;
      palm_is_free = true;
    }
    for (std::size_t i = 0; i + 1 < boxes.size(); ++i)
      if (found == Obstruction::NONE)
        found = collision_.test(boxes[i], 0.0);
    if (found == Obstruction::NONE && openHandTouches(grasp, opening(grasp, share)))
      found = Obstruction::OBJECT;
    if (found == Obstruction::NONE) {
      grasp.open_width = grasp.width + 2.0 * opening(grasp, share);
      break;
    }
  }
  return found;
}

bool GraspSearch::place(Grasp& grasp, GraspPlan& plan) {
  Obstruction first = Obstruction::NONE;
  for (const double slide : SLIDES) {
    Grasp moved = slid(grasp, slide);
    double table = 1.0;
    ++plan.rejections.poses;
    const Obstruction found = counted(plan.rejections, tryPose(moved, table));
    if (found == Obstruction::NONE) {
      // where the model is a little low the tips would touch: rather nearer to them
      Grasp back = slid(grasp, SLIDES[1]);
      double back_table = table;
      if (slide == 0.0 && tipsTouch(moved) &&
          tryPose(back, back_table) == Obstruction::NONE && !tipsTouch(back)) {
        moved = back;
        table = back_table;
      }
      grasp = moved;
      scorePose(grasp, table);
      return true;
    }
    if (slide == 0.0)
      first = found;
  }
  missed(grasp, first);
  return false;
}

void GraspSearch::missed(const Grasp& grasp, Obstruction obstruction) {
  if (grasp.scores.total > miss_.score)
    miss_ = {grasp.scores.total, grasp, obstruction};
}

void GraspSearch::runTwoJaws(GraspPlan& plan) {
  const ClosingLines finder(
      object_, options_, gripper_.finger_thickness + options_.opening);
  double narrowest, widest;
  const double max_width = gripper_.max_opening - 2.0 * options_.compliance;
  std::vector<ClosingLine> lines =
      finder.find(gripper_.min_opening, max_width, plan.rejections, narrowest, widest);
  std::vector<Grasp> grasps(lines.size());
  const auto describe = [&](std::size_t i, double robustness) {
    Grasp& g = grasps[i];
    const ClosingLine& line = lines[i];
    g.contacts.resize(2);
    for (std::size_t c = 0; c < 2; ++c) {
      // the first finger stands on the side the closing direction points to
      g.contacts[c].position = line.points[1 - c];
      g.contacts[c].normal = line.normals[1 - c];
      g.contacts[c].part = line.parts[1 - c];
    }
    g.position = line.middle();
    g.width = line.width;
    scoreContacts(g, line.slope, robustness);
  };
  std::priority_queue<Candidate> queue;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    describe(i, 1.0);
    queue.push({grasps[i].scores.total, std::uint32_t(i), -1, false});
  }
  std::vector<Grasp> similar;
  while (!queue.empty() && plan.grasps.size() < options_.count) {
    const Candidate candidate = queue.top();
    queue.pop();
    const std::size_t i = candidate.index;
    if (candidate.approach < 0 && !candidate.exact) {
      finder.refine(lines[i], max_width);
      describe(i, finder.robustness(lines[i]));
      if (!lines[i].at_rim) {
        const Eigen::Vector3d& axis = lines[i].axis;
        lines[i].slope = std::max({lines[i].slope,
                                   measured_.slope(grasps[i].contacts[0], axis),
                                   measured_.slope(grasps[i].contacts[1], -axis)});
        if (lines[i].slope > options_.friction ||
            !finder.standsShift(lines[i], measured_.scatter())) {
          ++plan.rejections.slipping;
          continue;
        }
      }
      for (GraspContact& contact : grasps[i].contacts)
        contact.observed = measured_.observed(contact, lines[i].at_rim);
      scoreContacts(grasps[i], lines[i].slope, grasps[i].scores.robustness);
      const std::vector<GraspContact>& contacts = grasps[i].contacts;
      if (grasps[i].scores.observed < options_.min_observed ||
          measured_.seenThrough(contacts[0]) || measured_.seenThrough(contacts[1])) {
        ++plan.rejections.unseen;
        continue;
      }
      queue.push({grasps[i].scores.total, candidate.index, -1, true});
    } else if (candidate.approach < 0) {
      const std::vector<OrientedBox> hand = handAt(grasps[i]);
      for (int a = 0; a < options_.approaches; ++a) {
        grasps[i].rotation = handFrame(lines[i].axis, a);
        const double table = bestTableClearance(grasps[i], hand);
        scorePose(grasps[i], table);
        if (table < options_.clearance) {
          ++plan.rejections.poses;
          counted(plan.rejections, Obstruction::TABLE);
          missed(grasps[i], Obstruction::TABLE);
          continue;
        }
        queue.push({grasps[i].scores.total, candidate.index, a, true});
      }
    } else {
      Grasp grasp = grasps[i];
      grasp.rotation = handFrame(lines[i].axis, candidate.approach);
      grasp.scores.total = candidate.bound;
      if (!isNew(grasp, plan.grasps, 1.0))
        similar.push_back(grasp);
      else if (place(grasp, plan))
        plan.grasps.push_back(grasp);
    }
  }
  // not enough that differ clearly: let in what differs at all
  for (std::size_t i = 0; i < similar.size() && plan.grasps.size() < options_.count;
       ++i)
    if (isNew(similar[i], plan.grasps, 0.5) && place(similar[i], plan))
      plan.grasps.push_back(similar[i]);
  if (plan.grasps.empty())
    plan.failure = explain(plan, narrowest, widest);
}

void GraspSearch::run(GraspPlan& plan) {
  if (gripper_.fingers == 2)
    runTwoJaws(plan);
  else
    runThreeFingers(plan);
  finish(plan);
}

} // namespace pcl_sq::detail

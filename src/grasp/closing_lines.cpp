// SPDX-License-Identifier: BSD-3-Clause
#include "grasp/closing_lines.h"

#include "pcl_sq/line_intersection.h"

#include <algorithm>
#include <limits>

namespace pcl_sq::detail {

namespace {

constexpr int REFINEMENTS = 2;
constexpr double ALIGNED = 0.02; ///< slope below which a line is left as it is

} // namespace

Eigen::Vector3d across(const Eigen::Vector3d& axis, const Eigen::Matrix3d& frame) {
  Eigen::Index least;
  (frame.transpose() * axis).cwiseAbs().minCoeff(&least);
  return axis.cross(frame.col(least)).normalized();
}

ClosingLines::ClosingLines(const MultiSuperquadric& object,
                           const GraspPlannerOptions& options,
                           double gap)
    : object_(object), options_(options), gap_(gap) {}

std::vector<ClosingLine> ClosingLines::find(double min_width,
                                            double max_width,
                                            GraspRejections& rejections,
                                            double& narrowest,
                                            double& widest) const {
  std::vector<ClosingLine> all, kept;
  for (std::size_t k = 0; k < object_.size(); ++k) {
    findOnPart(k, all);
    if (object_.parts[k].isHollow())
      findOnRim(k, all);
  }
  narrowest = std::numeric_limits<double>::infinity();
  widest = 0.0;
  for (ClosingLine& line : all) {
    ++rejections.candidates;
    // both normals of a part's own line slip alike, and no second part mends both
    if (line.slope <= options_.friction && !line.at_rim && extendToUnion(line))
      setSlope(line);
    if (line.slope > options_.friction || liesInHollow(line)) {
      ++rejections.slipping;
    } else if (line.width > max_width) {
      ++rejections.too_wide;
      if (line.width < narrowest) { // a chord beside the middle does not count
        refine(line, std::numeric_limits<double>::infinity());
        narrowest = std::min(narrowest, line.width);
      }
    } else if (line.width < min_width) {
      ++rejections.too_narrow;
      widest = std::max(widest, line.width);
    } else {
      kept.push_back(line);
    }
  }
  return kept;
}

bool ClosingLines::liesInHollow(const ClosingLine& line) const {
  for (std::size_t k = 0; k < object_.size(); ++k)
    for (std::size_t c = 0; c < 2; ++c)
      if (k != line.parts[c] && object_.parts[k].isHollow() &&
          object_.parts[k].contains(line.points[c]))
        return true;
  return false;
}

bool ClosingLines::extendToUnion(ClosingLine& line) const {
  double low = 0.0, high = line.width;
  std::array<std::size_t, 2> parts = line.parts;
  bool changed = false, again = object_.size() > 1;
  while (again) {
    again = false;
    for (std::size_t k = 0; k < object_.size(); ++k) {
      LineInterval other;
      if (k == parts[0] || k == parts[1] ||
          !intersectLineBox(object_.parts[k], line.points[0], line.axis, other) ||
          other.enter > high + gap_ || other.leave < low - gap_ ||
          (other.enter >= low && other.leave <= high) ||
          !intersectLine(object_.parts[k], line.points[0], line.axis, other) ||
          other.enter > high + gap_ || other.leave < low - gap_)
        continue;
      if (other.enter < low - 1e-9) {
        low = other.enter;
        parts[0] = k;
        again = changed = true;
      }
      if (other.leave > high + 1e-9) {
        high = other.leave;
        parts[1] = k;
        again = changed = true;
      }
    }
  }
  if (!changed)
    return false;
  const Eigen::Vector3d origin = line.points[0];
  line.points = {origin + low * line.axis, origin + high * line.axis};
  line.parts = parts;
  line.width = high - low;
  for (std::size_t i = 0; i < 2; ++i)
    line.normals[i] = object_.parts[parts[i]].normal(line.points[i]);
  return true;
}

void ClosingLines::setSlope(ClosingLine& line) const {
  const double cosine =
      std::min(-line.normals[0].dot(line.axis), line.normals[1].dot(line.axis));
  line.slope = cosine > MIN_COSINE
                   ? std::sqrt(std::max(1.0 - cosine * cosine, 0.0)) / cosine
                   : 1e3;
}

bool ClosingLines::cast(const Eigen::Vector3d& middle,
                        const Eigen::Vector3d& axis,
                        std::size_t part,
                        ClosingLine& line) const {
  LineInterval interval;
  if (!intersectLine(object_.parts[part], middle, axis, interval))
    return false;
  line.points = {middle + interval.enter * axis, middle + interval.leave * axis};
  line.parts = {part, part};
  line.axis = axis;
  line.width = interval.leave - interval.enter;
  for (std::size_t i = 0; i < 2; ++i)
    line.normals[i] = object_.parts[part].normal(line.points[i]);
  extendToUnion(line);
  setSlope(line);
  return true;
}

bool ClosingLines::refine(ClosingLine& line, double max_width) const {
  bool better = false;
  if (line.at_rim) // along the outside's normal already
    return false;
  for (int step = 0; step < REFINEMENTS && line.slope > ALIGNED; ++step) {
    const Eigen::Vector3d& n0 = line.normals[0];
    const Eigen::Vector3d& n1 = line.normals[1];
    // what both normals share is an offset from the middle of the body; on a ball of
    // the line's width this shift is exact
    const Eigen::Vector3d middle = line.middle() - 0.25 * line.width * (n0 + n1);
    ClosingLine turned;
    if (!cast(middle, (n1 - n0).normalized(), line.parts[0], turned) ||
        turned.width > max_width || turned.slope >= line.slope || liesInHollow(turned))
      break;
    line = turned;
    better = true;
  }
  return better;
}

bool ClosingLines::contains(const Eigen::Vector3d& point, std::size_t first) const {
  if (object_.parts[first].gauge(point) <= 1.0)
    return true;
  for (std::size_t k = 0; k < object_.size(); ++k)
    if (k != first && object_.parts[k].gauge(point) <= 1.0)
      return true;
  return false;
}

double ClosingLines::robustness(const Eigen::Vector3d& point,
                                const Eigen::Vector3d& outward,
                                std::size_t part) const {
  const Eigen::Vector3d first = across(outward, object_.parts[part].rotation);
  const Eigen::Vector3d second = outward.cross(first);
  int found = 0;
  for (const double shift : {options_.shift, 2.0 * options_.shift})
    for (const Eigen::Vector3d& side : {first, second})
      for (const double sign : {-1.0, 1.0})
        found +=
            contains(point + shift * (sign * side - options_.friction * outward), part);
  return found / 8.0;
}

double ClosingLines::robustness(const ClosingLine& line) const {
  return 0.5 * (robustness(line.points[0], -line.axis, line.parts[0]) +
                robustness(line.points[1], line.axis, line.parts[1]));
}

bool ClosingLines::standsShift(const ClosingLine& line, double shift) const {
  if (!(shift > 0.0)) // nothing was measured
    return true;
  // on a round body the normal leans twice as much as the secant
  const double spare = 0.5 * (options_.friction - line.slope);
  for (std::size_t c = 0; c < 2; ++c) {
    const Eigen::Vector3d& normal = line.normals[c];
    const Eigen::Vector3d first = across(normal, object_.parts[line.parts[c]].rotation);
    const Eigen::Vector3d second = normal.cross(first);
    for (const Eigen::Vector3d& side : {first, second})
      for (const double sign : {-1.0, 1.0})
        if (!contains(line.points[c] + shift * (sign * side - spare * normal),
                      line.parts[c]))
          return false;
  }
  return true;
}

} // namespace pcl_sq::detail

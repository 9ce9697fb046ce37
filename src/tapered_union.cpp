// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/tapered_union.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_sq {

namespace {
constexpr double INFINITE = std::numeric_limits<double>::infinity();
}

TaperedUnion::TaperedUnion(const MultiSuperquadric& model) {
  for (const Superquadric& part : model.parts) {
    TaperedSuperquadric body;
    body.shape = part;
    parts.push_back(body);
  }
}

bool TaperedUnion::isTapered() const {
  return std::any_of(parts.begin(), parts.end(), [](const TaperedSuperquadric& part) {
    return part.isTapered();
  });
}

double TaperedUnion::gauge(const Eigen::Vector3d& point) const {
  double smallest = INFINITE;
  for (const TaperedSuperquadric& part : parts)
    smallest = std::min(smallest, part.gauge(point));
  return smallest;
}

double TaperedUnion::distance(const Eigen::Vector3d& point) const {
  double smallest = INFINITE;
  for (const TaperedSuperquadric& part : parts)
    smallest = std::min(smallest,
                        part.isTapered() ? part.footPointDistance(point)
                                         : part.shape.euclideanDistance(point));
  return smallest;
}

double TaperedUnion::support(const Eigen::Vector3d& direction) const {
  double largest = -INFINITE;
  for (const TaperedSuperquadric& part : parts)
    largest =
        std::max(largest, direction.dot(part.shape.center) + part.support(direction));
  return largest;
}

Eigen::AlignedBox3d TaperedUnion::boundingBox() const {
  Eigen::AlignedBox3d box;
  if (empty())
    return box;
  for (int k = 0; k < 3; ++k) {
    box.min()[k] = -support(-Eigen::Vector3d::Unit(k));
    box.max()[k] = support(Eigen::Vector3d::Unit(k));
  }
  return box;
}

double TaperedUnion::distortion(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                double unit) const {
  double sum = 0.0;
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < points.cols() && !empty(); ++i) {
    if (!points.col(i).allFinite())
      continue;
    double off = INFINITE, factor = 0.0; // of the part with the smallest |G - 1|
    for (const TaperedSuperquadric& part : parts) {
      const double candidate = std::abs(part.gauge(points.col(i)) - 1.0);
      if (candidate < off) {
        off = candidate;
        factor = std::sqrt(part.shape.semi_axes.prod());
      }
    }
    sum += factor * off * off;
    ++count;
  }
  // sqrt(a1 a2 a3) is a length to the power of 1.5
  return count > 0 ? sum / double(count) * std::pow(unit, -1.5) : 0.0;
}

double
TaperedUnion::rmsDistance(const Eigen::Ref<const Eigen::Matrix3Xd>& points) const {
  double sum = 0.0;
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < points.cols() && !empty(); ++i) {
    if (!points.col(i).allFinite())
      continue;
    double nearest = INFINITE;
    for (const TaperedSuperquadric& part : parts)
      nearest = std::min(nearest, std::abs(part.footPointDistance(points.col(i))));
    sum += nearest * nearest;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / double(count)) : 0.0;
}

} // namespace pcl_sq

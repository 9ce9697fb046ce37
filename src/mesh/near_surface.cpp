// SPDX-License-Identifier: BSD-3-Clause
// Where the surface of a union is: seams, and what is near to it.
#include "geometry/taper.h"
#include "mesh/surface_remesher.h"
#include "mesh/triangle_shape.h"

#include <Eigen/LU>

namespace pcl_sq::detail {

namespace {

constexpr int MAX_STEPS = 30;
constexpr double CONVERGED = 1e-13;  ///< of a gauge
constexpr double LEAST_ANGLE = 1e-6; ///< squared sine between surfaces that cross

} // namespace

bool ontoParts(const MultiSuperquadric& model,
               const std::vector<std::size_t>& parts,
               Eigen::Vector3d& point) {
  // Newton's method with the shortest step; all gauges are convex
  const Eigen::Index count = Eigen::Index(parts.size());
  Eigen::Vector3d at = point;
  for (int step = 0; step < MAX_STEPS; ++step) {
    Eigen::VectorXd miss(count);
    Eigen::MatrixX3d slopes(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Superquadric& part = model.parts[parts[std::size_t(i)]];
      const Eigen::Vector3d slope = part.gaugeGradient(at);
      const double length = slope.norm();
      if (!(length > 0.0))
        return false;
      miss[i] = (1.0 - part.gauge(at)) / length;
      slopes.row(i) = slope.transpose() / length;
    }
    if (miss.cwiseAbs().maxCoeff() < CONVERGED * point.norm() + 1e-15) {
      point = at;
      return true;
    }
    const Eigen::MatrixXd angles = slopes * slopes.transpose();
    if (!(std::abs(angles.determinant()) > LEAST_ANGLE))
      return false;
    at += slopes.transpose() * angles.inverse() * miss;
    if (!at.allFinite())
      return false;
  }
  return false;
}

bool SurfaceRemesher::facesOut(const Corners& triangle, std::size_t part) const {
  const Eigen::Vector3d normal = doubleArea(triangle);
  const Eigen::Vector3d middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
  return normal.dot(model_.parts[part].normal(middle)) > 0.3 * normal.norm();
}

bool SurfaceRemesher::isNear(const Eigen::Vector3d& point,
                             std::size_t part,
                             Eigen::Vector3d& normal) const {
  // the tangent planes of all parts near by
  planes_.clear();
  bool own = false;
  for (std::size_t k = 0; k < model_.size(); ++k) {
    const Superquadric& body = model_.parts[k];
    const Eigen::Vector3d local = body.toLocal(point);
    if ((local.cwiseAbs() - body.halfSizes()).maxCoeff() > tolerance_)
      continue;
    const Place place = placeOf(body, local);
    const double gauge = std::exp(place.gauge.value);
    const Eigen::Vector3d slope = gauge * logGradient(body, place);
    const double length = slope.norm();
    if (!(length > 0.0))
      return false; // in the middle of it
    const double distance = (gauge - 1.0) / length;
    if (distance < -tolerance_)
      return false;
    if (distance > tolerance_)
      continue;
    planes_.push_back({body.rotation * slope / length, distance});
    if (k == part) {
      own = true;
      normal = planes_.back().normal;
    }
  }
  if (!own && !planes_.empty())
    normal = std::min_element(
                 planes_.begin(),
                 planes_.end(),
                 [](const auto& a, const auto& b) { return a.distance < b.distance; })
                 ->normal;
  // a foot on one of them or on the seam of two that is in none
  const auto isOut = [&](const Eigen::Vector3d& step) {
    return step.squaredNorm() <= tolerance_ * tolerance_ &&
           std::all_of(planes_.begin(), planes_.end(), [&](const Plane& p) {
             return p.distance + p.normal.dot(step) > -1e-3 * tolerance_;
           });
  };
  for (const Plane& p : planes_)
    if (isOut(-p.distance * p.normal))
      return true;
  for (const Plane& p : planes_)
    for (const Plane& q : planes_) {
      const double cosine = p.normal.dot(q.normal), sine2 = 1.0 - cosine * cosine;
      if (&p < &q && sine2 > 1e-9 &&
          isOut(((q.distance * cosine - p.distance) * p.normal +
                 (p.distance * cosine - q.distance) * q.normal) /
                sine2))
        return true;
    }
  return false;
}

bool SurfaceRemesher::fits(const Corners& triangle, std::size_t part) const {
  const Eigen::Vector3d area = doubleArea(triangle);
  if (!(area.norm() > 0.0))
    return false;
  const Eigen::Vector3d normal = area.normalized();
  Eigen::Vector3d there;
  const auto near = [&](const Eigen::Vector3d& p) { return isNear(p, part, there); };
  const auto along = [&](const Eigen::Vector3d& p) {
    return near(p) && there.dot(normal) >= ALONG;
  };
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d middle = (a + b + c) / 3.0;
  return along(middle) && near(0.5 * (a + b)) && near(0.5 * (b + c)) &&
         near(0.5 * (c + a)) && along(0.5 * (middle + a)) &&
         along(0.5 * (middle + b)) && along(0.5 * (middle + c));
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "table/table_search.h"

#include <Eigen/Eigenvalues>

#include <random>

namespace pcl_sq {

namespace {

constexpr std::size_t SAMPLE = 600; ///< points that vote
constexpr std::size_t MIN_POINTS = 30;

/** \brief Least squares through the points within \a distance; their number. */
std::size_t refit(const std::vector<Eigen::Vector3d>& points,
                  double distance,
                  TableModel& plane,
                  double& rms) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  std::size_t n = 0;
  for (const Eigen::Vector3d& p : points)
    if (std::abs(plane.height(p)) <= distance) {
      mean += p;
      ++n;
    }
  if (n < MIN_POINTS)
    return n;
  mean /= double(n);
  for (const Eigen::Vector3d& p : points)
    if (std::abs(plane.height(p)) <= distance)
      square += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(square / double(n));
  plane.normal = eigen.eigenvectors().col(0);
  plane.offset = -plane.normal.dot(mean);
  rms = std::sqrt(std::max(eigen.eigenvalues()[0], 0.0));
  return n;
}

} // namespace

bool findPlane(const std::vector<Eigen::Vector3d>& points,
               const Eigen::Vector3d& viewpoint,
               double inlier_distance,
               TableModel& plane) {
  if (!detail::findPlane(points, inlier_distance, {}, plane))
    return false;
  if (plane.height(viewpoint) < 0.0)
    plane = detail::flipped(plane);
  return true;
}

bool detail::findPlane(const std::vector<Eigen::Vector3d>& points,
                       double inlier_distance,
                       const PlaneDemand& demand,
                       TableModel& plane) {
  if (points.size() < MIN_POINTS)
    return false;
  std::mt19937 engine(5489U);
  const auto pick = [&] { return points[engine() % points.size()]; };
  Eigen::Matrix<double, SAMPLE, 3> sample; // a column a coordinate: quick to go through
  for (std::size_t i = 0; i < SAMPLE; ++i)
    sample.row(Eigen::Index(i)) = pick();
  std::size_t best = 0;
  for (int k = 0; k < demand.iterations; ++k) {
    const Eigen::Vector3d a = pick(), b = pick(), c = pick();
    const Eigen::Vector3d normal = (b - a).cross(c - a);
    if (!(normal.norm() > 1e-12))
      continue;
    TableModel t;
    t.normal = normal.normalized();
    t.offset = -t.normal.dot(a);
    // given up once all that are left cannot make it the best
    constexpr std::size_t AT_ONCE = 60;
    static_assert(SAMPLE % AT_ONCE == 0, "whole blocks");
    std::size_t votes = 0;
    for (std::size_t i = 0; i < SAMPLE && votes + (SAMPLE - i) > best; i += AT_ONCE) {
      const auto block = sample.middleRows<AT_ONCE>(Eigen::Index(i));
      const Eigen::Array<double, AT_ONCE, 1> heights =
          (block.col(0) * t.normal.x() + block.col(1) * t.normal.y() +
           block.col(2) * t.normal.z())
              .array() +
          t.offset;
      votes += std::size_t((heights.abs() <= inlier_distance).count());
    }
    if (votes > best) {
      best = votes;
      plane = t;
    }
  }
  if (double(best) < demand.share * double(SAMPLE))
    return false;
  return refitPlane(points, inlier_distance, plane);
}

bool detail::refitPlane(const std::vector<Eigen::Vector3d>& points,
                        double inlier_distance,
                        TableModel& plane) {
  double rms = inlier_distance;
  for (int k = 0; k < 3; ++k)
    if (refit(points, std::min(inlier_distance, 3.0 * rms + 1e-6), plane, rms) <
        MIN_POINTS)
      return false;
  // neighbouring pixels share their errors: a tenth of the points counts
  plane.noise = rms;
  plane.sigma = std::max(3.0 * rms / std::sqrt(0.1 * double(points.size())), 0.1 * rms);
  return true;
}

} // namespace pcl_sq

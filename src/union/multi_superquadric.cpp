// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/multi_superquadric.h"

#include "union/surface_statistics.h"
#include "util/parallel_for.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace pcl_sq {

namespace {
constexpr double INFINITE = std::numeric_limits<double>::infinity();
}

double MultiSuperquadric::gauge(const Eigen::Vector3d& point) const {
  double smallest = INFINITE;
  for (const Superquadric& part : parts)
    smallest = std::min(smallest, part.gauge(point));
  return smallest;
}

std::size_t MultiSuperquadric::nearestPart(const Eigen::Vector3d& point) const {
  std::size_t nearest = 0;
  double smallest = INFINITE;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const double distance = std::abs(parts[k].footPointDistance(point));
    if (distance < smallest) {
      smallest = distance;
      nearest = k;
    }
  }
  return nearest;
}

double MultiSuperquadric::euclideanDistance(const Eigen::Vector3d& point) const {
  double smallest = INFINITE;
  for (const Superquadric& part : parts)
    smallest = std::min(smallest, part.euclideanDistance(point));
  return smallest;
}

Eigen::VectorXd
MultiSuperquadric::euclideanDistances(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                      unsigned int threads) const {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Superquadric& part : parts)
    boxes.push_back(part.boundingBox());
  constexpr Eigen::Index BLOCK = 64; // points for which a thread is asked
  Eigen::VectorXd distances(points.cols());
  const auto blocks = static_cast<std::size_t>((points.cols() + BLOCK - 1) / BLOCK);
  detail::parallelFor(blocks, threads, [&](std::size_t block) {
    std::vector<std::pair<double, std::size_t>> nearest_first(parts.size());
    const Eigen::Index first = static_cast<Eigen::Index>(block) * BLOCK;
    for (Eigen::Index i = first; i < std::min(first + BLOCK, points.cols()); ++i) {
      const Eigen::Vector3d point = points.col(i);
      for (std::size_t k = 0; k < parts.size(); ++k)
        nearest_first[k] = {boxes[k].exteriorDistance(point), k};
      std::sort(nearest_first.begin(), nearest_first.end());
      double smallest = INFINITE;
      for (const auto& [at_least, k] : nearest_first) {
        if (at_least > std::max(smallest, 0.0)) // a box around the point bounds nothing
          break;
        smallest = std::min(smallest, parts[k].euclideanDistance(point));
      }
      distances[i] = smallest;
    }
  });
  return distances;
}

double MultiSuperquadric::support(const Eigen::Vector3d& direction) const {
  double largest = -INFINITE;
  for (const Superquadric& part : parts)
    largest = std::max(largest, direction.dot(part.center) + part.support(direction));
  return largest;
}

Eigen::AlignedBox3d MultiSuperquadric::boundingBox() const {
  Eigen::AlignedBox3d box;
  for (const Superquadric& part : parts)
    box.extend(part.boundingBox());
  return box;
}

double MultiSuperquadric::distortion(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                     double unit) const {
  // sqrt(a1 a2 a3) is a length to the power of 1.5
  return detail::surfaceStatistics(*this, points).distortion * std::pow(unit, -1.5);
}

double MultiSuperquadric::distortion(const CloudPoints& points, double unit) const {
  return detail::surfaceStatistics(*this, points).distortion * std::pow(unit, -1.5);
}

SurfaceStatistics MultiSuperquadric::statistics(const CloudPoints& points) const {
  return detail::surfaceStatistics(*this, points);
}

double
MultiSuperquadric::rmsDistance(const Eigen::Ref<const Eigen::Matrix3Xd>& points) const {
  return detail::surfaceStatistics(*this, points).rms_distance;
}

double MultiSuperquadric::rmsDistance(const CloudPoints& points) const {
  return detail::surfaceStatistics(*this, points).rms_distance;
}

TriangleMesh MultiSuperquadric::meshParts(int divisions) const {
  TriangleMesh all;
  for (const Superquadric& part : parts) {
    const TriangleMesh mesh = meshSuperquadric(part, divisions);
    const auto offset = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& t : mesh.triangles)
      all.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  return all;
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#include "object_piece.h"
#include "order_statistic.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace pcl_sq::detail {

namespace {

constexpr Eigen::Index SAMPLES = 100;
constexpr Eigen::Index MAX_POINTS = 3000;
constexpr std::size_t FEWEST = 24, MOST = 96; ///< neighbours through which a plane goes
constexpr double SHARING = 5.0; ///< points of one error for which the fewest suffice

} // namespace

double localNoise(const Eigen::Matrix3Xd& points, double effective_points) {
  const Eigen::Index n = points.cols();
  // neighbours that share their error hide it: look further
  const double sharing = double(n) / std::max(1.0, effective_points);
  const auto neighbours = std::clamp(
      static_cast<std::size_t>(double(FEWEST) * sharing / SHARING), FEWEST, MOST);
  if (n < Eigen::Index(2 * neighbours))
    return 0.0;
  std::vector<double> deviations;
  const Eigen::Index step = std::max<Eigen::Index>(1, n / SAMPLES);
  const Eigen::Index stride = std::max<Eigen::Index>(1, n / MAX_POINTS);
  std::vector<double> square_distances, spare, values;
  std::vector<Eigen::Index> near;
  for (Eigen::Index i = 0; i < n; i += step) {
    square_distances.clear();
    for (Eigen::Index k = 0; k < n; k += stride)
      square_distances.push_back((points.col(k) - points.col(i)).squaredNorm());
    values = square_distances;
    spare.resize(values.size());
    const double farthest =
        orderStatistic(values.data(), spare.data(), values.size(), neighbours - 1);
    near.clear();
    const auto take = [&](const auto& wanted) {
      for (std::size_t k = 0; k < square_distances.size() && near.size() < neighbours;
           ++k)
        if (wanted(square_distances[k]))
          near.push_back(Eigen::Index(k) * stride);
    };
    take([farthest](double d) { return d < farthest; });
    take([farthest](double d) { return d == farthest; });
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < neighbours; ++k)
      mean += points.col(near[k]) / double(neighbours);
    for (std::size_t k = 0; k < neighbours; ++k) {
      const Eigen::Vector3d d = points.col(near[k]) - mean;
      square += d * d.transpose() / double(neighbours - 3);
    }
    const double smallest =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(square, Eigen::EigenvaluesOnly)
            .eigenvalues()[0];
    deviations.push_back(std::sqrt(std::max(smallest, 0.0)));
  }
  const auto middle =
      deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() / 2);
  std::nth_element(deviations.begin(), middle, deviations.end());
  return *middle;
}

} // namespace pcl_sq::detail

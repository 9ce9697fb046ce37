// SPDX-License-Identifier: BSD-3-Clause
#include "pieces/piece.h"
#include "sensor/local_quadric.h"
#include "tuning/parts_tuning.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace pcl_sq::detail {

namespace {

using namespace tuning::local_noise;

} // namespace

double localNoise(const Eigen::Matrix3Xd& points, double effective_points) {
  const Eigen::Index n = points.cols();
  // neighbours that share their error hide it: look further
  const double sharing = double(n) / std::max(1.0, effective_points);
  const auto neighbours =
      std::clamp(static_cast<std::size_t>(double(FEWEST) * sharing / SHARING),
                 FEWEST,
                 tuning::local_noise::MOST);
  if (n < Eigen::Index(2 * neighbours))
    return 0.0;
  std::vector<double> deviations;
  const Eigen::Index step = std::max<Eigen::Index>(1, n / SAMPLES);
  const Eigen::Index stride = std::max<Eigen::Index>(1, n / MAX_POINTS);
  Neighbourhood neighbourhood(points, stride);
  for (Eigen::Index i = 0; i < n; i += step) {
    const std::vector<Eigen::Index>& near = neighbourhood.of(i, neighbours);
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
  return median(std::move(deviations));
}

} // namespace pcl_sq::detail

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
constexpr std::size_t CURVED = 32; ///< neighbours through which a curved surface goes
constexpr double SHARING = 5.0;    ///< points of one error for which the fewest suffice

/** \brief Nearest neighbours among every stride-th point. */
class Neighbourhood {
public:
  Neighbourhood(const Eigen::Matrix3Xd& points, Eigen::Index stride)
      : points_(points), stride_(stride) {}

  /** \brief Columns of the \a count points nearest to the i-th one. */
  const std::vector<Eigen::Index>& of(Eigen::Index i, std::size_t count) {
    distances_.clear();
    for (Eigen::Index k = 0; k < points_.cols(); k += stride_)
      distances_.push_back((points_.col(k) - points_.col(i)).squaredNorm());
    values_ = distances_;
    spare_.resize(values_.size());
    const double farthest =
        orderStatistic(values_.data(), spare_.data(), values_.size(), count - 1);
    near_.clear();
    const auto take = [&](const auto& wanted) {
      for (std::size_t k = 0; k < distances_.size() && near_.size() < count; ++k)
        if (wanted(distances_[k]))
          near_.push_back(Eigen::Index(k) * stride_);
    };
    take([farthest](double d) { return d < farthest; });
    take([farthest](double d) { return d == farthest; });
    return near_;
  }

private:
  const Eigen::Matrix3Xd& points_;
  Eigen::Index stride_;
  std::vector<double> distances_, values_, spare_;
  std::vector<Eigen::Index> near_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace

double curvedNoise(const Eigen::Matrix3Xd& points) {
  const Eigen::Index n = points.cols();
  if (n < Eigen::Index(2 * CURVED))
    return 0.0;
  const Eigen::Index step = std::max<Eigen::Index>(1, n / SAMPLES);
  const Eigen::Index stride = std::max<Eigen::Index>(1, n / MAX_POINTS);
  std::vector<double> deviations;
  Neighbourhood neighbourhood(points, stride);
  for (Eigen::Index i = 0; i < n; i += step) {
    const std::vector<Eigen::Index>& near = neighbourhood.of(i, CURVED);
    Eigen::Matrix3Xd local(3, Eigen::Index(CURVED));
    for (std::size_t k = 0; k < CURVED; ++k)
      local.col(Eigen::Index(k)) = points.col(near[k]);
    local.colwise() -= local.rowwise().mean().eval();
    // across the smallest spread, the surface is a quadratic function
    local = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(local * local.transpose())
                .eigenvectors()
                .transpose() *
            local;
    if (!(local.norm() > 0.0)) // one place many times
      continue;
    const auto u = local.row(1).transpose().array() / local.norm();
    const auto v = local.row(2).transpose().array() / local.norm();
    Eigen::Matrix<double, Eigen::Dynamic, 6> terms(local.cols(), 6);
    terms << Eigen::VectorXd::Ones(local.cols()), u, v, u * u, u * v, v * v;
    const Eigen::VectorXd height = local.row(0).transpose();
    const Eigen::VectorXd residuals =
        height - terms * terms.colPivHouseholderQr().solve(height);
    deviations.push_back(residuals.norm() / std::sqrt(double(CURVED - 6)));
  }
  return deviations.empty() ? 0.0 : median(std::move(deviations));
}

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

// SPDX-License-Identifier: BSD-3-Clause
#include "object_piece.h"
#include "order_statistic.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>

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
    collect(i, near_enough_);
    if (found_.size() < count)
      collect(i, std::numeric_limits<double>::infinity());
    values_.clear();
    for (const Found& f : found_)
      values_.push_back(f.distance);
    spare_.resize(values_.size());
    const double farthest =
        orderStatistic(values_.data(), spare_.data(), values_.size(), count - 1);
    near_enough_ = WIDER * farthest;
    near_.clear();
    const auto take = [&](const auto& wanted) {
      for (std::size_t k = 0; k < found_.size() && near_.size() < count; ++k)
        if (wanted(found_[k].distance))
          near_.push_back(found_[k].column);
    };
    take([farthest](double d) { return d < farthest; });
    take([farthest](double d) { return d == farthest; });
    return near_;
  }

private:
  struct Found {
    double distance; ///< squared
    Eigen::Index column;
  };
  /** \brief The next point's neighbours are about as far as the last one's: of the
   * squared distances over those. */
  static constexpr double WIDER = 2.0;

  /** \brief Points nearer to the i-th one than a squared distance. */
  void collect(Eigen::Index i, double near_enough) {
    found_.clear();
    const Eigen::Vector3d p = points_.col(i);
    for (Eigen::Index k = 0; k < points_.cols(); k += stride_)
      if (const double d = (points_.col(k) - p).squaredNorm(); d < near_enough)
        found_.push_back({d, k});
  }

  const Eigen::Matrix3Xd& points_;
  Eigen::Index stride_;
  double near_enough_ = std::numeric_limits<double>::infinity();
  std::vector<Found> found_;
  std::vector<double> values_, spare_;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "sensor/local_quadric.h"

#include "util/order_statistic.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

/** \brief The next point's neighbours are about as far as the last one's: of the
 * squared distances over those. */
constexpr double WIDER = 2.0;

} // namespace

void Neighbourhood::collect(Eigen::Index i, double near_enough) {
  found_.clear();
  const Eigen::Vector3d p = points_.col(i);
  for (Eigen::Index k = 0; k < points_.cols(); k += stride_)
    if (const double d = (points_.col(k) - p).squaredNorm(); d < near_enough)
      found_.push_back({d, k});
}

const std::vector<Eigen::Index>& Neighbourhood::of(Eigen::Index i, std::size_t count) {
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

double LocalQuadric::scatter() const {
  return residuals.norm() / std::sqrt(double(residuals.size() - TERMS));
}

LocalQuadric localQuadric(const Eigen::Matrix3Xd& points,
                          const std::vector<Eigen::Index>& columns) {
  LocalQuadric patch;
  Eigen::Matrix3Xd local(3, Eigen::Index(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k)
    local.col(Eigen::Index(k)) = points.col(columns[k]);
  local.colwise() -= local.rowwise().mean().eval();
  // across the smallest spread, the surface is a quadratic function
  local = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(local * local.transpose())
              .eigenvectors()
              .transpose() *
          local;
  const double size = local.norm();
  if (!(size > 0.0))
    return patch;
  patch.across = local.bottomRows<2>();
  const auto u = patch.across.row(0).transpose().array() / size;
  const auto v = patch.across.row(1).transpose().array() / size;
  Eigen::Matrix<double, Eigen::Dynamic, LocalQuadric::TERMS> terms(local.cols(),
                                                                   LocalQuadric::TERMS);
  terms << Eigen::VectorXd::Ones(local.cols()), u, v, u * u, u * v, v * v;
  const Eigen::VectorXd height = local.row(0).transpose();
  patch.residuals = height - terms * terms.colPivHouseholderQr().solve(height);
  return patch;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace pcl_sq::detail

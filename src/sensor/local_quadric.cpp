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

Neighbourhood::Neighbourhood(const Eigen::Matrix3Xd& points, Eigen::Index stride)
    : points_(points) {
  if (points.cols() == 0)
    return;
  (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).maxCoeff(&axis_);
  std::vector<std::pair<double, Eigen::Index>> order;
  order.reserve(std::size_t(points.cols() / stride + 1));
  for (Eigen::Index k = 0; k < points.cols(); k += stride)
    order.emplace_back(points(axis_, k), k);
  std::sort(order.begin(), order.end());
  sorted_.resize(3, Eigen::Index(order.size()));
  for (std::size_t k = 0; k < order.size(); ++k) {
    along_.push_back(order[k].first);
    columns_.push_back(order[k].second);
    sorted_.col(Eigen::Index(k)) = points.col(order[k].second);
  }
}

void Neighbourhood::collect(const Eigen::Vector3d& place, double near_enough) {
  found_.clear();
  distances_.clear();
  const double reach = std::sqrt(near_enough), middle = place[axis_];
  const auto begin = std::lower_bound(along_.begin(), along_.end(), middle - reach);
  const auto end = std::upper_bound(begin, along_.end(), middle + reach);
  for (auto k = std::size_t(begin - along_.begin());
       k < std::size_t(end - along_.begin());
       ++k)
    if (const double d = (sorted_.col(Eigen::Index(k)) - place).squaredNorm();
        d < near_enough) {
      distances_.push_back(d);
      found_.push_back(k);
    }
}

const std::vector<Eigen::Index>& Neighbourhood::of(Eigen::Index i, std::size_t count) {
  const Eigen::Vector3d place = points_.col(i);
  collect(place, near_enough_);
  if (found_.size() < count)
    collect(place, std::numeric_limits<double>::infinity());
  values_ = distances_;
  spare_.resize(values_.size());
  const double farthest =
      orderStatistic(values_.data(), spare_.data(), values_.size(), count - 1);
  near_enough_ = WIDER * farthest;
  near_.clear();
  const auto take = [&](const auto& wanted) {
    for (std::size_t k = 0; k < found_.size() && near_.size() < count; ++k)
      if (wanted(distances_[k]))
        near_.push_back(columns_[found_[k]]);
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
  std::vector<double> spare(values.size());
  return orderStatistic(values.data(), spare.data(), values.size(), values.size() / 2);
}

} // namespace pcl_sq::detail

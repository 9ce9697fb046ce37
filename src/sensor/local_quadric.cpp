// SPDX-License-Identifier: BSD-3-Clause
#include "sensor/local_quadric.h"

#include "util/order_statistic.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

/** \brief Of points on a surface in a cell of the grid, about. */
constexpr double POINTS_A_CELL = 4.0;
/** \brief The next point's neighbours are about as far as the last one's: of the
 * squared distances over those. */
constexpr double WIDER = 2.0;
constexpr double SMALLEST = 0.1; ///< ball that is searched, in cells

std::vector<Eigen::Vector3d> everyOf(const Eigen::Matrix3Xd& points,
                                     Eigen::Index stride) {
  std::vector<Eigen::Vector3d> list;
  list.reserve(std::size_t(points.cols() / stride + 1));
  for (Eigen::Index k = 0; k < points.cols(); k += stride)
    list.emplace_back(points.col(k));
  return list;
}

/** \brief Side of a square on the surface of the points' box that holds so many of
 * them. */
double cellFor(const Eigen::Matrix3Xd& points, Eigen::Index stride) {
  if (points.cols() == 0)
    return 1.0;
  const Eigen::Vector3d size =
      points.rowwise().maxCoeff() - points.rowwise().minCoeff();
  const double area =
      2.0 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
  const Eigen::Index looked_at = points.cols() / stride + 1;
  const auto count = double(looked_at);
  // points on a line have no area
  const double cell =
      std::max(std::sqrt(POINTS_A_CELL * area / count), size.norm() / count);
  return cell > 0.0 ? cell : 1.0;
}

} // namespace

Neighbourhood::Neighbourhood(const Eigen::Matrix3Xd& points, Eigen::Index stride)
    : points_(points), stride_(stride),
      grid_(everyOf(points, stride), cellFor(points, stride)), radius_(grid_.cell()) {}

const std::vector<Eigen::Index>& Neighbourhood::of(Eigen::Index i, std::size_t count) {
  const Eigen::Vector3d place = points_.col(i);
  const std::vector<Eigen::Vector3d>& points = grid_.points();
  for (;; radius_ *= std::sqrt(WIDER)) {
    found_.clear();
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(radius_);
    grid_.any({place - reach, place + reach}, [&](std::size_t k) {
      if (const double d = (points[k] - place).squaredNorm(); d <= radius_ * radius_)
        found_.emplace_back(d, k);
      return false;
    });
    if (found_.size() >= count || found_.size() == points.size())
      break;
  }
  values_.resize(found_.size());
  spare_.resize(found_.size());
  for (std::size_t k = 0; k < found_.size(); ++k)
    values_[k] = found_[k].first;
  const double farthest =
      orderStatistic(values_.data(), spare_.data(), values_.size(), count - 1);
  found_.erase(std::remove_if(found_.begin(),
                              found_.end(),
                              [&](const auto& f) { return f.first > farthest; }),
               found_.end());
  for (auto& f : found_)
    f.second = grid_.given(f.second);
  std::sort(found_.begin(), found_.end());
  near_.clear();
  for (std::size_t k = 0; k < count; ++k)
    near_.push_back(Eigen::Index(found_[k].second) * stride_);
  // a ball that holds copies of one point grows from something
  radius_ = std::max(std::sqrt(WIDER * farthest), SMALLEST * grid_.cell());
  return near_;
}

double Neighbourhood::reach() const {
  return std::sqrt(found_[near_.size() - 1].first);
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

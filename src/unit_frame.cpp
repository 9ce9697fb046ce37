// SPDX-License-Identifier: BSD-3-Clause
#include "unit_frame.h"

#include "point_set.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstdint>

namespace pcl_sq::detail {

namespace {

std::size_t padded(std::size_t count) {
  return (count + kernels::BLOCK - 1) / kernels::BLOCK * kernels::BLOCK;
}

/** \brief Scatters the bits of coordinates on a grid of 1/1024 of the unit: fine enough
 * to tell points apart, coarse enough to survive a rotation's rounding. */
std::uint32_t hash(float x, float y, float z) {
  std::uint64_t h = 0;
  for (const float v : {x, y, z}) {
    const float scaled = std::clamp(v * 1024.0F, -1e9F, 1e9F);
    h = (h ^ static_cast<std::uint32_t>(static_cast<std::int32_t>(scaled))) *
        0x9e3779b97f4a7c15ULL;
    h ^= h >> 29;
  }
  return static_cast<std::uint32_t>(h >> 16);
}

} // namespace

void UnitPoints::reserve(std::size_t count) {
  for (std::vector<float>* v : {&x_, &y_, &z_})
    v->resize(padded(count), 0.0F);
}

void UnitPoints::setPrecision(const std::vector<float>& precision) {
  precision_ = precision;
  if (!precision_.empty())
    precision_.resize(padded(count_), 0.0F);
}

double UnitPoints::boxVolume() const {
  double volume = 1.0;
  for (const std::vector<float>* v : {&x_, &y_, &z_}) {
    const auto ends = std::minmax_element(
        v->begin(), v->begin() + static_cast<std::ptrdiff_t>(count_));
    volume *= std::max(double(*ends.second) - double(*ends.first), 0.1);
  }
  return volume;
}

bool principalFrame(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                    UnitFrame& frame) {
  const Moments moments = momentsOf(points);
  if (moments.count < 3 || !moments.covariance.allFinite())
    return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(moments.covariance);
  const double deviation = std::sqrt(std::max(eigen.eigenvalues()[2], 0.0));
  if (!(deviation > 1e-150) || !std::isfinite(deviation))
    return false;
  frame.origin = moments.mean;
  frame.scale = deviation;
  frame.axes = eigen.eigenvectors();
  Eigen::Vector3d third = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite())
      third += frame.toUnit(points.col(i)).array().cube().matrix();
  for (int k = 0; k < 2; ++k)
    if (third[k] < 0.0)
      frame.axes.col(k) *= -1.0;
  frame.axes.col(2) = frame.axes.col(0).cross(frame.axes.col(1));
  return true;
}

UnitPoints toUnit(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                  const UnitFrame& frame) {
  UnitPoints unit;
  unit.reserve(static_cast<std::size_t>(points.cols()));
  const Eigen::Matrix3d linear = frame.axes.transpose() / frame.scale;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d p = linear * (points.col(i) - frame.origin);
    if (p.allFinite())
      unit.add(
          static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]));
  }
  return unit;
}

UnitPoints subset(const UnitPoints& points, std::size_t count) {
  UnitPoints chosen;
  if (points.size() <= count)
    return points;
  // every hash below a bound is sure to be a candidate, so that a large cloud is
  // scanned once and only few are sorted
  const double share =
      std::min(1.0, 1.5 * (double(count) + 64.0) / double(points.size()));
  const auto bound = static_cast<std::uint32_t>(share * 4294967295.0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> candidates;
  candidates.reserve(static_cast<std::size_t>(1.2 * share * double(points.size())));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f p = points[i];
    const std::uint32_t h = hash(p[0], p[1], p[2]);
    if (h <= bound)
      candidates.emplace_back(h, static_cast<std::uint32_t>(i));
  }
  const std::size_t size = std::min(count, candidates.size());
  std::nth_element(candidates.begin(),
                   candidates.begin() + static_cast<std::ptrdiff_t>(size),
                   candidates.end());
  chosen.reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const Eigen::Vector3f p = points[candidates[i].second];
    chosen.add(p[0], p[1], p[2]);
  }
  return chosen;
}

kernels::Shape toShape(const Superquadric& s) {
  kernels::Shape shape;
  const Eigen::Vector3d offset = s.rotation.transpose() * s.center;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k)
      shape.axes[i][k] = static_cast<float>(s.rotation(k, i));
    shape.offset[i] = static_cast<float>(offset[i]);
    shape.inverse_axis[i] = static_cast<float>(1.0 / s.semi_axes[i]);
  }
  shape.epsilon1 = static_cast<float>(s.epsilon1);
  shape.epsilon2 = static_cast<float>(s.epsilon2);
  return shape;
}

} // namespace pcl_sq::detail

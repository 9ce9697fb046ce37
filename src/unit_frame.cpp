// SPDX-License-Identifier: BSD-3-Clause
#include "unit_frame.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cstdint>

namespace pcl_sq::detail {

namespace {

/** \brief Cheaper than three tests: a sum times zero is zero unless a term is none. */
template <typename Column>
bool isFinite(const Column& p) {
  return (p[0] + p[1] + p[2]) * 0.0 == 0.0;
}

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
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (isFinite(points.col(i))) {
      mean += points.col(i);
      ++count;
    }
  if (count < 3)
    return false;
  mean /= double(count);
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d third[3] = {second, second, second}; // sums of d d^T d_k
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (isFinite(points.col(i))) {
      const Eigen::Vector3d d = points.col(i) - mean;
      const Eigen::Matrix3d square = d * d.transpose();
      second += square;
      for (int k = 0; k < 3; ++k)
        third[k] += square * d[k];
    }
  if (!second.allFinite())
    return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(second / double(count));
  frame.deviations = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  if (!(frame.deviations[2] > 1e-150) || !std::isfinite(frame.deviations[2]))
    return false;
  frame.origin = mean;
  frame.scale = frame.deviations[2];
  frame.axes = eigen.eigenvectors();
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector3d axis = frame.axes.col(k);
    double cube = 0.0;
    for (int j = 0; j < 3; ++j)
      cube += axis[j] * axis.dot(third[j] * axis);
    if (cube < 0.0)
      frame.axes.col(k) *= -1.0;
  }
  frame.axes.col(2) = frame.axes.col(0).cross(frame.axes.col(1));
  return true;
}

bool isLine(const UnitFrame& frame) {
  const double largest = frame.origin.cwiseAbs().maxCoeff() + 3.0 * frame.scale;
  const double rounding = 4.0 * 6e-8 * largest; // of a float that holds a coordinate
  return frame.deviations[1] <= std::max(rounding, 1e-7 * frame.deviations[2]);
}

UnitPoints toUnit(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                  const UnitFrame& frame) {
  UnitPoints unit;
  unit.reserve(static_cast<std::size_t>(points.cols()));
  const Eigen::Matrix3d linear = frame.axes.transpose() / frame.scale;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d p = linear * (points.col(i) - frame.origin);
    if (isFinite(p))
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
  // scanned once and only few are sorted; where points coincide there may be too few
  std::vector<std::pair<std::uint32_t, std::uint32_t>> candidates;
  for (double share = 1.5 * (double(count) + 64.0) / double(points.size());
       candidates.size() < count;
       share *= 16.0) {
    const auto bound = static_cast<std::uint32_t>(std::min(share, 1.0) * 4294967295.0);
    candidates.clear();
    candidates.reserve(
        static_cast<std::size_t>(1.2 * std::min(share, 1.0) * double(points.size())));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3f p = points[i];
      const std::uint32_t h = hash(p[0], p[1], p[2]);
      if (h <= bound)
        candidates.emplace_back(h, static_cast<std::uint32_t>(i));
    }
  }
  std::nth_element(candidates.begin(),
                   candidates.begin() + static_cast<std::ptrdiff_t>(count),
                   candidates.end());
  chosen.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
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

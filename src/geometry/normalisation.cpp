// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/normalisation.h"

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

/** \brief Calls \a use with each finite point in a frame. */
template <typename Points, typename Use>
void forEachInUnit(const Points& points, const Normalisation& frame, const Use& use) {
  const Eigen::Matrix3d linear = frame.axes.transpose() / frame.scale;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d p =
        linear * (points.col(i).template cast<double>() - frame.origin);
    if (isFinite(p))
      use(p.cast<float>());
  }
}

/** \brief The \a count points of the smallest hashes among \a total.
 * \param[in] for_each calls its argument with each point \param[out] which the points'
 * places among all, unless nullptr */
template <typename ForEach>
UnitPoints smallestHashes(std::size_t total,
                          std::size_t count,
                          const ForEach& for_each,
                          std::vector<std::uint32_t>* which = nullptr) {
  struct Hashed {
    std::uint32_t hash, order;
    Eigen::Vector3f point;
    bool operator<(const Hashed& other) const {
      return std::pair(hash, order) < std::pair(other.hash, other.order);
    }
  };
  // every hash below a bound is sure to be a candidate, so that a large cloud is
  // scanned once and only few are sorted; where points coincide there may be too few
  std::vector<Hashed> candidates;
  for (double share = 1.5 * (double(count) + 64.0) / double(total);
       candidates.size() < count;
       share *= 16.0) {
    const auto bound = static_cast<std::uint32_t>(std::min(share, 1.0) * 4294967295.0);
    candidates.clear();
    candidates.reserve(
        static_cast<std::size_t>(1.2 * std::min(share, 1.0) * double(total)));
    std::uint32_t order = 0;
    for_each([&](const Eigen::Vector3f& p) {
      if (const std::uint32_t h = hash(p[0], p[1], p[2]); h <= bound)
        candidates.push_back({h, order, p});
      ++order;
    });
  }
  std::nth_element(candidates.begin(),
                   candidates.begin() + static_cast<std::ptrdiff_t>(count),
                   candidates.end());
  UnitPoints chosen;
  chosen.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f& p = candidates[i].point;
    chosen.add(p[0], p[1], p[2]);
    if (which)
      which->push_back(candidates[i].order);
  }
  return chosen;
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

template <typename Points>
std::size_t principalFrame(const Points& points, Normalisation& frame) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (isFinite(points.col(i))) {
      mean += points.col(i).template cast<double>();
      ++count;
    }
  if (count < 3)
    return 0;
  mean /= double(count);
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d third[3] = {second, second, second}; // sums of d d^T d_k
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (isFinite(points.col(i))) {
      const Eigen::Vector3d d = points.col(i).template cast<double>() - mean;
      const Eigen::Matrix3d square = d * d.transpose();
      second += square;
      for (int k = 0; k < 3; ++k)
        third[k] += square * d[k];
    }
  if (!second.allFinite())
    return 0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(second / double(count));
  frame.deviations = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  if (!(frame.deviations[2] > 1e-150) || !std::isfinite(frame.deviations[2]))
    return 0;
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
  return count;
}

bool isLine(const Normalisation& frame) {
  const double largest = frame.origin.cwiseAbs().maxCoeff() + 3.0 * frame.scale;
  const double rounding = 4.0 * 6e-8 * largest; // of a float that holds a coordinate
  return frame.deviations[1] <= std::max(rounding, 1e-7 * frame.deviations[2]);
}

template <typename Points>
UnitPoints toUnit(const Points& points, const Normalisation& frame) {
  UnitPoints unit;
  unit.reserve(static_cast<std::size_t>(points.cols()));
  forEachInUnit(
      points, frame, [&unit](const Eigen::Vector3f& p) { unit.add(p[0], p[1], p[2]); });
  return unit;
}

UnitPoints subset(const UnitPoints& points, std::size_t count) {
  if (points.size() <= count)
    return points;
  std::vector<std::uint32_t> order;
  UnitPoints chosen = smallestHashes(
      points.size(),
      count,
      [&points](const auto& use) {
        for (std::size_t i = 0; i < points.size(); ++i)
          use(points[i]);
      },
      &order);
  if (const float* precision = points.view().precision) {
    std::vector<float> taken;
    for (const std::uint32_t i : order)
      taken.push_back(precision[i]);
    chosen.setPrecision(taken);
  }
  return chosen;
}

template <typename Points>
UnitPoints subsetInUnit(const Points& points,
                        const Normalisation& frame,
                        std::size_t finite,
                        std::size_t count) {
  return smallestHashes(
      finite, count, [&](const auto& use) { forEachInUnit(points, frame, use); });
}

using DoublePoints = Eigen::Ref<const Eigen::Matrix3Xd>;
template std::size_t principalFrame(const DoublePoints&, Normalisation&);
template std::size_t principalFrame(const CloudPoints&, Normalisation&);
template UnitPoints toUnit(const DoublePoints&, const Normalisation&);
template UnitPoints toUnit(const CloudPoints&, const Normalisation&);
template UnitPoints toUnit(const Eigen::Matrix3Xd&, const Normalisation&);
template UnitPoints
subsetInUnit(const DoublePoints&, const Normalisation&, std::size_t, std::size_t);
template UnitPoints
subsetInUnit(const CloudPoints&, const Normalisation&, std::size_t, std::size_t);

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
  shape.kx = static_cast<float>(s.kx);
  shape.ky = static_cast<float>(s.ky);
  return shape;
}

} // namespace pcl_sq::detail

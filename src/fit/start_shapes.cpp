// SPDX-License-Identifier: BSD-3-Clause
#include "fit/start_shapes.h"

#include "solver/descriptions.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace pcl_sq::detail {

namespace {

constexpr double BOX = 0.3;          ///< exponents of a box that can still move
constexpr double OCTAHEDRON = 1.7;   ///< and of an octahedron
constexpr double FLAT = 0.05;        ///< smallest start's axis over the largest
constexpr std::size_t CUT = 100;     ///< one point in so many is left out at each end
constexpr std::size_t OUTLYING = 20; ///< among many outliers

/** \brief Axes, middle and half sides of the box around the points. */
struct Box {
  Eigen::Matrix3d axes;
  Eigen::Vector3d middle, half;
};

/** \brief Box along given axes, a few points left out at each end. */
Box boxAlong(const UnitPoints& points,
             const Eigen::Matrix3d& axes,
             std::size_t one_in = CUT) {
  const std::size_t n = points.size();
  const auto cut = static_cast<std::ptrdiff_t>(n / one_in);
  std::vector<float> along(n);
  Eigen::Vector3d low, high;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3f axis = axes.col(k).cast<float>();
    for (std::size_t i = 0; i < n; ++i)
      along[i] = axis.dot(points[i]);
    std::nth_element(along.begin(), along.begin() + cut, along.end());
    low[k] = along[cut];
    std::nth_element(along.begin(), along.end() - 1 - cut, along.end());
    high[k] = *(along.end() - 1 - cut);
  }
  const Eigen::Vector3d side = high - low;
  return {axes,
          axes * (0.5 * (low + high)),
          0.5 * side.cwiseMax(FLAT * side.maxCoeff()).cwiseMax(1e-3)};
}

Eigen::Matrix3d principalAxesOf(const UnitPoints& points) {
  const std::size_t n = points.size();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < n; ++i)
    mean += points[i].cast<double>();
  mean /= double(n);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d d = points[i].cast<double>() - mean;
    covariance += d * d.transpose();
  }
  Eigen::Matrix3d axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
  if (axes.determinant() < 0.0)
    axes.col(2) *= -1.0;
  return axes;
}

/** \brief Superquadric in a box; its axis k is the box's axis (k + shift) mod 3. */
Superquadric inBox(const Box& box, int shift, double epsilon) {
  Superquadric s;
  s.center = box.middle;
  s.rotation = box.axes;
  s.semi_axes = box.half;
  s.epsilon1 = s.epsilon2 = epsilon;
  return axesShifted(s, shift);
}

} // namespace

std::vector<Superquadric> startShapes(const UnitPoints& dense) {
  std::vector<Superquadric> starts;
  const Box box = boxAlong(dense, principalAxesOf(dense));
  for (int shift = 0; shift < 3; ++shift) {
    starts.push_back(inBox(box, shift, 1.0));
    starts.push_back(inBox(box, shift, BOX));
    starts.push_back(eighthTurn(starts.back()));
  }
  return starts;
}

std::vector<Superquadric> furtherStartShapes(const UnitPoints& dense,
                                             const Superquadric& fit) {
  std::vector<Superquadric> starts;
  const Box along_fit = boxAlong(dense, fit.rotation, OUTLYING);
  for (int shift = 0; shift < 3; ++shift)
    starts.push_back(inBox(along_fit, shift, BOX));
  const Eigen::Matrix3d axes = principalAxesOf(dense);
  const Box box = boxAlong(dense, axes);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double push : {-0.7, 0.7}) {
      Box pushed = box;
      pushed.middle += push * box.half[axis] * axes.col(axis);
      pushed.half[axis] *= 1.7;
      starts.push_back(inBox(pushed, axis, 1.0));
    }
    starts.push_back(inBox(box, axis, OCTAHEDRON));
    const Eigen::Matrix3d between =
        axes *
        Eigen::AngleAxisd(0.25 * M_PI, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
    const Box other = boxAlong(dense, between);
    for (int shift = 0; shift < 3; ++shift)
      starts.push_back(inBox(other, shift, BOX));
  }
  return starts;
}

std::vector<Superquadric> otherDescriptions(const Superquadric& model) {
  const Superquadric first = withAxis(model, 0), second = withAxis(model, 1);
  const Superquadric own_dual = dual(model);
  return {first,
          second,
          own_dual,
          withAxis(own_dual, 0),
          withAxis(own_dual, 1),
          dual(first),
          dual(second)};
}

} // namespace pcl_sq::detail

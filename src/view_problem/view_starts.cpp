// SPDX-License-Identifier: BSD-3-Clause
#include "solver/descriptions.h"
#include "view_problem/view_problem.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace pcl_sq::detail {

namespace {

/** \brief Rows: middle and half length of the points along each axis. */
struct Extent {
  Eigen::Vector3d middle, half;
};

Extent extentAlong(const UnitPoints& points, const Eigen::Matrix3d& axes) {
  Extent e;
  const std::size_t n = points.size();
  const auto cut = static_cast<std::ptrdiff_t>(n / 50);
  std::vector<float> along(n);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3f axis = axes.col(k).cast<float>();
    for (std::size_t i = 0; i < n; ++i)
      along[i] = axis.dot(points[i]);
    std::nth_element(along.begin(), along.begin() + cut, along.end());
    const double low = along[cut];
    std::nth_element(along.begin(), along.end() - 1 - cut, along.end());
    const double high = *(along.end() - 1 - cut);
    e.middle[k] = 0.5 * (low + high);
    e.half[k] = 0.5 * (high - low);
  }
  e.half = e.half.cwiseMax(0.05 * e.half.maxCoeff());
  return e;
}

/** \brief Axes of the points across \a up, with \a up as the third. */
Eigen::Matrix3d uprightAxes(const UnitPoints& points, const Eigen::Vector3d& up) {
  Eigen::Matrix3d axes;
  axes.col(0) = up.unitOrthogonal();
  axes.col(1) = up.cross(axes.col(0));
  axes.col(2) = up;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d q = axes.leftCols<2>().transpose() * points[i].cast<double>();
    mean += q;
    square += q * q.transpose();
  }
  mean /= double(points.size());
  square = square / double(points.size()) - mean * mean.transpose();
  const double angle =
      0.5 * std::atan2(2.0 * square(0, 1), square(0, 0) - square(1, 1));
  return axes * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

struct Kind {
  double epsilon1, epsilon2;
  bool turned; ///< by 45 degrees about z
};

void addStarts(const ViewProblem& p,
               const Eigen::Matrix3d& axes,
               int shift,
               const std::vector<Kind>& kinds,
               std::vector<Superquadric>& starts) {
  const Extent e = extentAlong(p.coarse(), axes);
  Eigen::Vector3d half = e.half, middle = axes * e.middle;
  if (p.hasView()) {
    // what the camera does not see: at least as deep as the body is wide across
    Eigen::Vector3d across = half;
    int deepest;
    (axes.transpose() * p.view()).cwiseAbs().maxCoeff(&deepest);
    across[deepest] = 1e300;
    const double width = across.minCoeff();
    const double missing = std::max(0.0, width - half[deepest]);
    half[deepest] += missing;
    middle += p.view() * missing;
  }
  for (const Kind& kind : kinds) {
    Superquadric s;
    s.center = middle;
    s.rotation = axes;
    s.semi_axes = half;
    s = axesShifted(s, shift);
    if (kind.turned)
      s = eighthTurn(s);
    s.epsilon1 = kind.epsilon1;
    s.epsilon2 = kind.epsilon2;
    starts.push_back(s);
  }
}

} // namespace

std::vector<Superquadric> viewStarts(const ViewProblem& p) {
  std::vector<Superquadric> starts;
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity(); // the principal axes
  if (p.hasUp()) {
    const Eigen::Matrix3d axes = uprightAxes(p.medium(), p.up());
    addStarts(
        p,
        axes,
        0,
        {{0.3, 1.0, false}, {0.3, 0.3, false}, {0.3, 0.3, true}, {1.0, 1.0, false}},
        starts);
    for (int shift = 1; shift < 3; ++shift)
      addStarts(p, axes, shift, {{0.3, 1.0, false}, {1.0, 1.0, false}}, starts);
    addStarts(p, identity, 0, {{0.5, 0.5, false}}, starts);
  } else
    for (const Kind& kind :
         {Kind{0.5, 0.5, false}, Kind{1.0, 1.0, false}, Kind{0.3, 0.3, true}})
      for (int shift = 0; shift < 3; ++shift)
        addStarts(p, identity, shift, {kind}, starts);
  return starts;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// Where the search for a bent rod begins.
#include "families/bent_problem.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr double CUT = 0.02;      ///< share of the points beyond an extent's end
constexpr double ONE_SIDED = 1.6; ///< depth over half the width of a rod seen whole
constexpr double START_EPSILON = 0.4;
constexpr double MOST_BENT = 0.9; ///< of what is valid

/** \brief Ends of sorted values without the outermost ones. */
std::pair<double, double> endsOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto cut = static_cast<std::size_t>(CUT * double(values.size()));
  return {values[cut], values[values.size() - 1 - cut]};
}

/** \brief The arc of the circle nearest to the points seen along a normal (Kasa 1976:
 * |p|^2 = 2 c.p + r^2 - |c|^2 is linear). */
Superquadric arcAcross(const ViewProblem& problem, const Eigen::Vector3d& normal) {
  const UnitPoints& points = problem.medium();
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::Matrix<double, 3, 2> plane;
  plane.col(0) = normal.unitOrthogonal();
  plane.col(1) = normal.cross(plane.col(0));
  Eigen::Matrix2Xd at(2, count);
  Eigen::MatrixX3d rows(count, 3);
  std::vector<double> heights;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d p = points[std::size_t(i)].cast<double>();
    at.col(i) = plane.transpose() * p;
    rows.row(i) << 2.0 * at.col(i).transpose(), 1.0;
    heights.push_back(normal.dot(p));
  }
  const Eigen::Vector3d solution =
      rows.colPivHouseholderQr().solve(at.colwise().squaredNorm().transpose());
  const Eigen::Vector2d center = solution.head<2>();
  const double radius = std::sqrt(std::max(solution[2] + center.squaredNorm(), 1e-12));
  const Eigen::Vector2d outwards = at.rowwise().mean() - center;
  const double middle_angle = std::atan2(outwards.y(), outwards.x());
  std::vector<double> angles, radii;
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector2d p = at.col(i) - center;
    angles.push_back(std::remainder(std::atan2(p.y(), p.x()) - middle_angle, 2 * M_PI));
    radii.push_back(p.norm());
  }
  const auto [first, last] = endsOf(std::move(angles));
  const auto [inner, outer] = endsOf(std::move(radii));
  const auto [low, high] = endsOf(std::move(heights));
  const double angle = middle_angle + 0.5 * (first + last);
  const Eigen::Vector2d away(std::cos(angle), std::sin(angle));
  const double half = std::max(0.5 * (outer - inner), 1e-3);
  const double circle = 0.5 * (outer + inner);
  // of a rod seen along the normal only the near half has points
  double height = 0.5 * (low + high);
  if (problem.hasView() && high - low < ONE_SIDED * half)
    height = problem.view().dot(normal) < 0.0 ? high - half : low + half;
  Superquadric s;
  s.rotation.col(0) = -(plane * away);
  s.rotation.col(1) = normal;
  s.rotation.col(2) = s.rotation.col(0).cross(normal);
  s.center = plane * (center + circle * away) + height * normal;
  s.bend = 1.0 / std::max(circle, half / (MOST_BENT * Superquadric::MAX_FOLD));
  s.semi_axes = {half,
                 half,
                 std::min(0.5 * (last - first) * radius,
                          MOST_BENT * Superquadric::MAX_BEND / s.bend)};
  s.semi_axes.z() = std::max(s.semi_axes.z(), half);
  s.epsilon1 = START_EPSILON;
  return s;
}

} // namespace

std::vector<Superquadric> bentStarts(const ViewProblem& problem) {
  // the frame's axes are the points' principal ones, the first the shortest
  std::vector<Superquadric> starts = {arcAcross(problem, Eigen::Vector3d::UnitX())};
  if (problem.hasUp())
    starts.push_back(arcAcross(problem, problem.up()));
  if (problem.hasView())
    starts.push_back(arcAcross(problem, problem.view()));
  return starts;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// Where the search for a bent rod begins.
#include "families/bent_problem.h"
#include "tuning/view_tuning.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::family;
using namespace tuning::bent_starts;

/** \brief Ends of sorted values without the outermost ones. */
std::pair<double, double> endsOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto cut = static_cast<std::size_t>(CUT * double(values.size()));
  return {values[cut], values[values.size() - 1 - cut]};
}

/** \brief Points seen along a normal, and how thick they are along it. */
struct Seen {
  Seen(const UnitPoints& points, const Eigen::Vector3d& along) : normal(along) {
    plane.col(0) = normal.unitOrthogonal();
    plane.col(1) = normal.cross(plane.col(0));
    at.resize(2, static_cast<Eigen::Index>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3d p = points[i].cast<double>();
      at.col(Eigen::Index(i)) = plane.transpose() * p;
      heights.push_back(normal.dot(p));
    }
  }
  /** \brief Where the middle of a rod is along the normal: of one that is seen along
   * it only the near half has points. */
  double middle(const ViewProblem& problem, double half) const {
    const auto [low, high] = endsOf(heights);
    if (problem.hasView() && high - low < ONE_SIDED * half)
      return problem.view().dot(normal) < 0.0 ? high - half : low + half;
    return 0.5 * (low + high);
  }

  Eigen::Vector3d normal;
  Eigen::Matrix<double, 3, 2> plane;
  Eigen::Matrix2Xd at;
  std::vector<double> heights;
};

/** \brief A rod from the middle of its arc.
 * \param[in] inwards to the circle's centre, in the plane */
Superquadric rodAt(const ViewProblem& problem,
                   const Seen& seen,
                   const Eigen::Vector2d& middle,
                   const Eigen::Vector2d& inwards,
                   double half,
                   double half_length,
                   double bend) {
  Superquadric s;
  s.rotation.col(0) = seen.plane * inwards;
  s.rotation.col(1) = seen.normal;
  s.rotation.col(2) = s.rotation.col(0).cross(seen.normal);
  s.center = seen.plane * middle + seen.middle(problem, half) * seen.normal;
  s.bend = std::min(bend, MOST_BENT * Superquadric::MAX_FOLD / half);
  s.semi_axes = {
      half, half, std::min(half_length, MOST_BENT * Superquadric::MAX_BEND / s.bend)};
  s.semi_axes.z() = std::max(s.semi_axes.z(), half);
  s.epsilon1 = START_EPSILON;
  return s;
}

/** \brief The arc of the parabola nearest to the points seen along a normal, which
 * their thickness does not bend more than they are, as it does the circle: for less
 * than about a third of one. */
Superquadric parabolaAcross(const ViewProblem& problem, const Seen& seen) {
  const Eigen::Vector2d mean = seen.at.rowwise().mean();
  const Eigen::Matrix2Xd apart = seen.at.colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(apart * apart.transpose());
  const Eigen::Vector2d along = axes.eigenvectors().col(1),
                        across(-along.y(), along.x());
  const Eigen::VectorXd x = apart.transpose() * along, y = apart.transpose() * across;
  Eigen::MatrixX3d rows(x.size(), 3);
  rows << Eigen::VectorXd::Ones(x.size()), x, x.cwiseAbs2();
  const Eigen::Vector3d c = rows.colPivHouseholderQr().solve(y);
  const Eigen::VectorXd off = y - rows * c;
  const auto [inner, outer] = endsOf({off.begin(), off.end()});
  const auto [first, last] = endsOf({x.begin(), x.end()});
  const double place = 0.5 * (first + last), slope = c[1] + 2.0 * c[2] * place;
  const double stretch = std::sqrt(1.0 + slope * slope);
  const double half = std::max(0.5 * (outer - inner) / stretch, 1e-3);
  const Eigen::Vector2d inwards =
      std::copysign(1.0, c[2]) * (across - slope * along) / stretch;
  return rodAt(problem,
               seen,
               mean + place * along + (c[0] + (c[1] + c[2] * place) * place) * across,
               inwards,
               half,
               0.5 * (last - first) * stretch,
               std::max(2.0 * std::abs(c[2]) / std::pow(stretch, 3), 1e-3));
}

/** \brief The arc of the circle nearest to the points seen along a normal (Kasa 1976:
 * |p|^2 = 2 c.p + r^2 - |c|^2 is linear). */
Superquadric arcAcross(const ViewProblem& problem, const Seen& seen) {
  Eigen::MatrixX3d rows(seen.at.cols(), 3);
  rows << 2.0 * seen.at.transpose(), Eigen::VectorXd::Ones(seen.at.cols());
  const Eigen::Vector3d solution =
      rows.colPivHouseholderQr().solve(seen.at.colwise().squaredNorm().transpose());
  const Eigen::Vector2d center = solution.head<2>();
  const double radius = std::sqrt(std::max(solution[2] + center.squaredNorm(), 1e-12));
  const Eigen::Vector2d outwards = seen.at.rowwise().mean() - center;
  const double middle_angle = std::atan2(outwards.y(), outwards.x());
  std::vector<double> angles, radii;
  for (Eigen::Index i = 0; i < seen.at.cols(); ++i) {
    const Eigen::Vector2d p = seen.at.col(i) - center;
    angles.push_back(std::remainder(std::atan2(p.y(), p.x()) - middle_angle, 2 * M_PI));
    radii.push_back(p.norm());
  }
  const auto [first, last] = endsOf(std::move(angles));
  const auto [inner, outer] = endsOf(std::move(radii));
  const double angle = middle_angle + 0.5 * (first + last);
  const Eigen::Vector2d away(std::cos(angle), std::sin(angle));
  const double circle = 0.5 * (outer + inner);
  return rodAt(problem,
               seen,
               center + circle * away,
               -away,
               std::max(0.5 * (outer - inner), 1e-3),
               0.5 * (last - first) * radius,
               1.0 / circle);
}

} // namespace

std::vector<Superquadric> bentStarts(const ViewProblem& problem) {
  // the frame's axes are the points' principal ones, the first the shortest
  std::vector<Eigen::Vector3d> normals = {Eigen::Vector3d::UnitX()};
  if (problem.hasUp())
    normals.push_back(problem.up());
  if (problem.hasView())
    normals.push_back(problem.view());
  std::vector<Superquadric> starts;
  for (const Eigen::Vector3d& normal : normals) {
    const Seen seen(problem.medium(), normal);
    starts.push_back(arcAcross(problem, seen));
    starts.push_back(parabolaAcross(problem, seen));
  }
  return starts;
}

} // namespace pcl_sq::detail

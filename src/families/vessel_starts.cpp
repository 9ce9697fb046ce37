// SPDX-License-Identifier: BSD-3-Clause
// Where the search for an open vessel begins.
#include "families/vessel_problem.h"
#include "tuning/view_tuning.h"
#include "view_problem/shape_spaces.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::family;

/** \brief Profiles of household vessels: cup, pot or plate, bowl. */
struct Kind {
  double epsilon1, taper, rim;
};
constexpr std::array<Kind, 4> KINDS = {
    {{0.15, 0.05, 0.9}, {0.2, 0.3, 0.9}, {0.5, 0.2, 0.6}, {1.0, 0.0, 0.05}}};

struct Interval {
  double low, high;
  double middle() const { return 0.5 * (low + high); }
  double half() const { return 0.5 * (high - low); }
};

Interval extentAlong(const UnitPoints& points, const Eigen::Vector3d& axis) {
  std::vector<double> along(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    along[i] = axis.dot(points[i].cast<double>());
  const auto cut = static_cast<std::ptrdiff_t>(CUT * double(along.size()));
  std::nth_element(along.begin(), along.begin() + cut, along.end());
  const double low = along[std::size_t(cut)];
  std::nth_element(along.begin(), along.end() - 1 - cut, along.end());
  return {low, *(along.end() - 1 - cut)};
}

} // namespace

std::vector<Superquadric> vesselStarts(const ViewProblem& p,
                                       const Eigen::Vector3d& up) {
  Superquadric s;
  s.rotation.col(2) = up;
  s.rotation.col(0) =
      p.hasView() ? up.cross(p.view()).stableNormalized() : up.unitOrthogonal();
  if (!(s.rotation.col(0).norm() > 0.5)) // seen along the axis
    s.rotation.col(0) = up.unitOrthogonal();
  s.rotation.col(1) = up.cross(s.rotation.col(0));
  // from the near outside to the far inside, and from side to side
  const Interval across = extentAlong(p.medium(), s.rotation.col(0)),
                 deep = extentAlong(p.medium(), s.rotation.col(1));
  Interval high = extentAlong(p.medium(), up);
  const Eigen::Vector3d middle =
      across.middle() * s.rotation.col(0) + deep.middle() * s.rotation.col(1);
  // down to the table, or to what hides the rest
  double lowest = high.high - 1e-3;
  bool ends = false;
  for (const TangentPlane& plane : p.tangents())
    if (const double down = plane.normal.dot(up); down < -UPRIGHT) {
      ends = true;
      lowest = std::min(lowest, (plane.offset - plane.normal.dot(middle)) / down);
    }
  if (ends)
    high.low = lowest;
  const double radius = std::max(across.half(), 1e-3);
  std::vector<Superquadric> starts;
  for (const Kind& kind : KINDS) {
    s.epsilon1 = kind.epsilon1;
    s.epsilon2 = 1.0;
    s.kx = s.ky = kind.taper;
    s.rim = kind.rim;
    const double growth =
        (1.0 + kind.taper * kind.rim) *
        std::pow(1.0 - std::pow(kind.rim, 2.0 / kind.epsilon1), 0.5 * kind.epsilon1);
    const double a3 = 2.0 * high.half() / (1.0 + kind.rim);
    s.semi_axes = {radius / growth, radius / growth, a3};
    s.wall = std::min(0.07 * radius, 0.3 * a3);
    s.center = middle + (high.low + a3) * up;
    starts.push_back(s);
  }
  return starts;
}

} // namespace pcl_sq::detail

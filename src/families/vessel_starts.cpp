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
using namespace tuning::vessel_starts;

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

/** \brief Where a vessel's axis may be across a direction, and its radius. */
struct Round {
  std::vector<Eigen::Vector3d> middles;
  double radius = 0.0;
};

/** \brief From the near outside to the far inside, and from side to side. */
Round seenRound(const UnitPoints& points, const Superquadric& s) {
  const Interval across = extentAlong(points, s.rotation.col(0)),
                 deep = extentAlong(points, s.rotation.col(1));
  return {{across.middle() * s.rotation.col(0) + deep.middle() * s.rotation.col(1)},
          across.half()};
}

/** \brief From all round: a handle makes it wider in one direction, not in the
 * narrowest one; the body is then at either end. */
Round wholeRound(const UnitPoints& points, const Superquadric& s) {
  Interval narrow{0.0, 1e300};
  Eigen::Vector3d direction = s.rotation.col(0);
  for (int k = 0; k < DIRECTIONS; ++k) {
    const double angle = M_PI * k / DIRECTIONS;
    const Eigen::Vector3d d =
        std::cos(angle) * s.rotation.col(0) + std::sin(angle) * s.rotation.col(1);
    const Interval width = extentAlong(points, d);
    if (width.half() < narrow.half()) {
      narrow = width;
      direction = d;
    }
  }
  const Eigen::Vector3d along = s.rotation.col(2).cross(direction);
  const Interval wide = extentAlong(points, along);
  Round round;
  round.radius = narrow.half();
  const double beside = wide.half() - round.radius;
  std::vector<double> places = {wide.middle() - beside, wide.middle() + beside};
  if (beside < NO_HANDLE * round.radius)
    places = {wide.middle()};
  for (const double at : places)
    round.middles.emplace_back(narrow.middle() * direction + at * along);
  return round;
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
  const Round round =
      p.hasView() ? seenRound(p.medium(), s) : wholeRound(p.medium(), s);
  Interval high = extentAlong(p.medium(), up);
  const Eigen::Vector3d& place = round.middles.front();
  // down to the table, or to what hides the rest
  double lowest = high.high - 1e-3;
  bool ends = false;
  for (const TangentPlane& plane : p.tangents())
    if (const double down = plane.normal.dot(up); down < -UPRIGHT) {
      ends = true;
      lowest = std::min(lowest, (plane.offset - plane.normal.dot(place)) / down);
    }
  if (ends)
    high.low = lowest;
  const double radius = std::max(round.radius, 1e-3);
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
    for (const Eigen::Vector3d& middle : round.middles) {
      s.center = middle + (high.low + a3) * up;
      starts.push_back(s);
    }
  }
  return starts;
}

} // namespace pcl_sq::detail

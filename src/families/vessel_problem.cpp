// SPDX-License-Identifier: BSD-3-Clause
#include "families/vessel_problem.h"

#include "families/family_step.h"
#include "tuning/view_tuning.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::family;
using namespace tuning::vessel_problem;
using namespace tuning::shared;

/** \brief The nearest place of a polyline. */
struct Foot {
  double square = 1e300;               ///< of the distance
  const ProfileVertex* from = nullptr; ///< of the chord
  double share = 0.0;                  ///< along it

  Eigen::Vector2d at() const { return (1.0 - share) * from[0].at + share * from[1].at; }
};

using OuterChords = Chords<VesselProfile::OUTER + 1>;
using InnerChords = Chords<VesselProfile::INNER + 1>;

template <std::size_t VERTICES, std::size_t COUNT>
void takeNearest(const std::array<ProfileVertex, VERTICES>& line,
                 const Chords<COUNT>& chords,
                 const Eigen::Vector2d& p,
                 Foot& foot) {
  std::array<double, COUNT> squares;
  chords.squaresTo(p, squares);
  const auto least = std::min_element(squares.begin(), squares.end());
  if (!(*least < foot.square))
    return;
  const auto i = std::size_t(least - squares.begin());
  foot.square = *least;
  foot.from = &line[i];
  foot.share = chords.shareAt(i, p.x() - chords.x[i], p.y() - chords.y[i]);
}

/** \brief A chord with the slopes of its ends, as the kernels want it. */
kernels::VesselChord chordOf(const ProfileVertex& from, const ProfileVertex& to) {
  const Eigen::Vector2d along = to.at - from.at;
  const double square = along.squaredNorm();
  kernels::VesselChord c{float(from.at.x()),
                         float(from.at.y()),
                         float(along.x()),
                         float(along.y()),
                         square > 0.0 ? float(1.0 / square) : 0.0F,
                         {},
                         {}};
  for (int row = 0; row < 2; ++row)
    for (int k = 0; k < kernels::VesselChord::SLOPES; ++k) {
      c.begin[row][k] = float(from.d(row, k));
      c.end[row][k] = float(to.d(row, k));
    }
  return c;
}

} // namespace

VesselProblem::VesselProblem(const ViewProblem& problem,
                             const UnitPoints& points,
                             double sigma,
                             PlaneCost planes)
    : points_(points), limits_(problem.limits(sigma)), planes_(std::move(planes)),
      others_(planes_), eye_(problem.eye()),
      pixel_(planes_.silhouette.empty() ? 0.0 : planes_.silhouette.front().sigma) {
  others_.silhouette.clear();
}

VesselProblem::Equations VesselProblem::evaluate(const Superquadric& s) const {
  const VesselProfile profile(s);
  Equations e = pointSums(s, profile);
  addPlanes(s, profile, e);
  Vector wall = Vector::Zero();
  wall[10] = 1.0;
  wall[5] = -1.0;
  const double prior = std::log(s.wall / s.semi_axes.x()) - LOG_WALL;
  e.addRow(planes_.unit / LOG_WALL_SIGMA * wall, planes_.unit / LOG_WALL_SIGMA * prior);
  return e;
}

double VesselProblem::insideShare(const Superquadric& s) const {
  const VesselProfile profile(s);
  const OuterChords outside(profile.outside);
  const InnerChords within(profile.inside);
  double inside = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Vector3d p = s.toLocal(points_[i].cast<double>());
    const Eigen::Vector2d place(p.head<2>().norm(), p.z());
    Foot outer, inner;
    takeNearest(profile.outside, outside, place, outer);
    takeNearest(profile.inside, within, place, inner);
    inside += inner.square < outer.square;
  }
  return inside / double(points_.size());
}

VesselProblem::Equations VesselProblem::pointSums(const Superquadric& s,
                                                  const VesselProfile& profile) const {
  constexpr int COUNT = VesselProfile::OUTER + VesselProfile::INNER + 2;
  std::array<kernels::VesselChord, COUNT> chords;
  auto next = chords.begin();
  const auto add = [&next](const auto& line) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      *next++ = chordOf(line[i], line[i + 1]);
  };
  add(profile.outside);
  add(profile.inside);
  kernels::Vessel vessel{};
  vessel.chords = chords.data();
  vessel.outer = VesselProfile::OUTER + 1;
  vessel.count = COUNT;
  vessel.has_eye = eye_.has_value();
  if (eye_)
    Eigen::Map<Eigen::Vector3f>(vessel.eye) = s.toLocal(*eye_).cast<float>();
  const double margin = 2.0 * pixel_;
  vessel.rim = float(profile.rimHeight());
  vessel.wide = float(profile.opening() + margin);
  vessel.narrow = float(profile.opening() - margin);
  kernels::Sums sums;
  kernels::kernels().vesselEquations(
      points_.view(), toShape(s), vessel, mixtureOf(limits_), sums);
  return squaresOf<N>(sums);
}

void VesselProblem::addPlanes(const Superquadric& s,
                              const VesselProfile& profile,
                              Equations& e) const {
  const auto touching = [&](const Eigen::Vector3d& n) {
    const double across = n.head<2>().norm();
    const ProfileVertex* farthest = nullptr;
    double most = -1e300;
    for (const ProfileVertex& v : profile.outside) {
      const double reach = across * v.at.x() + n.z() * v.at.y();
      if (reach > most) {
        most = reach;
        farthest = &v;
      }
    }
    return farthest;
  };
  const auto row = [&](const Eigen::Vector3d& normal) {
    const Eigen::Vector3d n = s.rotation.transpose() * normal;
    const double across = n.head<2>().norm();
    const ProfileVertex& v = *touching(n);
    Eigen::Vector3d at(0.0, 0.0, v.at.y());
    if (across > 0.0)
      at.head<2>() = v.at.x() / across * n.head<2>();
    PlaneRow<N> r;
    r.reach = normal.dot(s.center) + n.dot(at);
    r.derivatives.head<3>() = n;
    r.derivatives.segment<2>(3) = at.cross(n).head<2>();
    r.derivatives.tail<6>() = (across * v.d.row(0) + n.z() * v.d.row(1)).transpose();
    return r;
  };
  const auto reach = [&](const Eigen::Vector3d& n) { return row(n).reach; };
  addPlaneCost<N>(others_, row, reach, e);
  // the outline may be a handle's here and there: robust, as the points are
  const double unit = planes_.unit;
  const RobustCost density{1.0, OUTLIER};
  Vector slope = Vector::Zero();
  double sum = 0.0, weight_of_all = 0.0;
  for (const TangentPlane& plane : planes_.silhouette) {
    const PlaneRow<N> r = row(plane.normal);
    const double z = (r.reach - plane.offset) / plane.sigma;
    double share;
    e.cost += unit * unit * density.cost(z * z, share);
    const Vector weighted = unit / plane.sigma * r.derivatives;
    e.jtj.noalias() += share * weighted * weighted.transpose();
    e.jtr += share * unit * z * weighted;
    sum += share * unit * z / plane.sigma;
    weight_of_all += share / (plane.sigma * plane.sigma);
    slope += share / plane.sigma * weighted;
  }
  if (planes_.dilation_sigma > 0.0 && weight_of_all > 0.0) {
    const double precision =
        weight_of_all + 1.0 / (planes_.dilation_sigma * planes_.dilation_sigma);
    e.jtj.noalias() -= slope * slope.transpose() / precision;
    e.jtr -= slope * (sum / precision);
    e.cost -= sum * sum / precision;
  }
}

Superquadric
VesselProblem::moved(const Superquadric& m, const Vector& step, bool& limited) const {
  Vector s = step;
  limited = shorten({{0, 3, TRUST * m.semi_axes.maxCoeff()},
                     {3, 2, TRUST},
                     {5, 2, TRUST},
                     {7, 1, TRUST},
                     {8, 2, RIM_TRUST},
                     {10, 1, TRUST}},
                    s);
  Superquadric next = m;
  moveRigidly(s.head<3>(), {s[3], s[4], 0.0}, next);
  const auto axis = [&](double a, double ds) {
    return std::clamp(a * std::exp(ds), limits_.min_axis, limits_.max_axis);
  };
  next.semi_axes.x() = next.semi_axes.y() = axis(m.semi_axes.x(), s[5]);
  next.semi_axes.z() = axis(m.semi_axes.z(), s[6]);
  next.epsilon1 = std::clamp(m.epsilon1 + s[7], limits_.min_epsilon, MAX_EPSILON);
  next.kx = next.ky = std::clamp(m.kx + s[8], -MAX_TAPER, MAX_TAPER);
  next.rim = std::clamp(m.rim + s[9], MIN_RIM, MAX_RIM);
  next.wall = m.wall * std::exp(s[10]);
  // open at the rim, and deeper than its wall
  const double radius =
      next.semi_axes.x() * (1.0 + next.kx * next.rim) *
      std::pow(1.0 - std::pow(std::abs(next.rim), 2.0 / next.epsilon1),
               0.5 * next.epsilon1);
  next.wall = std::min({next.wall,
                        MOST_WALL * radius,
                        MOST_WALL * next.semi_axes.z() * (1.0 + next.rim)});
  return next;
}

bool VesselProblem::isActiveBound(const Superquadric& m,
                                  const Vector& direction) const {
  return leaves(m.semi_axes.x(), limits_.min_axis, limits_.max_axis, direction[5]) ||
         leaves(m.semi_axes.z(), limits_.min_axis, limits_.max_axis, direction[6]) ||
         leaves(m.epsilon1, limits_.min_epsilon, MAX_EPSILON, direction[7]) ||
         leaves(m.kx, -MAX_TAPER, MAX_TAPER, direction[8]) ||
         leaves(m.rim, MIN_RIM, MAX_RIM, direction[9]);
}

Basis<VesselProblem::N> vesselBasis(bool upright) {
  constexpr int N = VesselProblem::N;
  return upright ? basisWithout<N>({3, 4}) : basisWithout<N>({});
}

} // namespace pcl_sq::detail

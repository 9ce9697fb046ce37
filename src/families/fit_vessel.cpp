// SPDX-License-Identifier: BSD-3-Clause
// The family of open vessels: bowls, cups, pots, plates.
#include "families/families.h"
#include "families/vessel_problem.h"
#include "tuning/view_tuning.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::shared;
using namespace tuning::fit_vessel;
using namespace tuning::family;

struct Vessel {
  Superquadric model;
  double cost = 1e300; ///< over sigma^2
  bool upright = false;
};

class VesselFamily {
public:
  VesselFamily(const ViewProblem& problem, const UnitPoints& points, double sigma)
      : least_squares_(problem, points, sigma, problem.planes(sigma, points)) {}

  Vessel fit(const Vessel& start,
             int iterations = tuning::fit_vessel::ITERATIONS) const {
    LmLimits limits;
    limits.max_iterations = iterations;
    limits.cost_tolerance = 1e-5;
    auto found = minimiseSquares(
        least_squares_, start.model, vesselBasis(start.upright), limits);
    found.model.rotation =
        Eigen::Quaterniond(found.model.rotation).normalized().toRotationMatrix();
    if (!found.model.isValid())
      return {start.model, 1e300, start.upright};
    const double unit = least_squares_.planes().unit;
    return {found.model, found.equations.cost / (unit * unit), start.upright};
  }

  double insideShare(const Superquadric& model) const {
    return least_squares_.insideShare(model);
  }

private:
  VesselProblem least_squares_;
};

ShapeCandidate vesselCandidate(const Vessel& v, const ViewProblem& problem) {
  ShapeCandidate c;
  c.shape = ShapeClass::VESSEL;
  c.before = ShapeClass::ROTATIONAL;
  c.upright = v.upright;
  c.parameters = static_cast<int>(vesselBasis(v.upright).cols());
  c.cost = v.cost;
  c.bic = c.cost + c.parameters * std::log(problem.observations()) + VESSEL;
  c.model = v.model;
  return c;
}

/** \brief Distance of each point to a body. */
std::vector<float> distancesTo(const Superquadric& body, const UnitPoints& points) {
  std::vector<float> distances(points.size() + kernels::BLOCK);
  residualsOf(body, points, kernels::Residual::FOOT_POINT, distances.data());
  distances.resize(points.size());
  return distances;
}

/** \brief What a solid cannot explain: points behind the surface that the camera sees.
 */
struct Hidden {
  double share = 0.0; ///< of the points
  double cost = 0.0;  ///< by which they are no better than outliers
};

Hidden
hiddenPoints(const ViewProblem& problem, double sigma, const Superquadric& body) {
  Hidden hidden;
  if (!problem.eye())
    return hidden;
  const UnitPoints& points = problem.medium();
  UnitPoints nearer;
  nearer.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = points[i].cast<double>();
    const Eigen::Vector3f q =
        (p + BEHIND * sigma * (*problem.eye() - p).normalized()).cast<float>();
    nearer.add(q.x(), q.y(), q.z());
  }
  const std::vector<float> there = distancesTo(body, nearer),
                           here = distancesTo(body, points);
  const LmOptions limits = problem.limits(sigma);
  const RobustCost density{sigma, limits.outlier};
  const float* precision = points.view().precision;
  double cost = 0.0, count = 0.0, share;
  const double outlier = density.cost(1e6 * sigma * sigma, share);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(double(there[i]) < -sigma))
      continue;
    const double q = precision ? double(precision[i]) : 1.0;
    count += 1.0;
    cost += outlier - density.cost(q * double(here[i]) * double(here[i]), share);
  }
  const double unit = problem.planes(sigma, points).unit;
  hidden.share = count / double(points.size());
  hidden.cost = cost / (unit * unit);
  return hidden;
}

/** \brief Sigma of the points about a body: what the mixture makes of their distances.
 */
double scatterOf(const UnitPoints& points, double sigma, const Superquadric& body) {
  constexpr int ROUNDS = 8;
  std::vector<double> squares;
  for (const float distance : distancesTo(body, points))
    squares.push_back(std::pow(double(distance), 2));
  for (int round = 0; round < ROUNDS; ++round) {
    const RobustCost density{sigma, OUTLIER};
    double shares = 0.0, weighted = 0.0, share;
    for (const double square : squares) {
      density.cost(square, share);
      shares += share;
      weighted += share * square;
    }
    sigma = std::max(std::sqrt(weighted / std::max(shares, 1.0)), MIN_SIGMA);
  }
  return sigma;
}

/** \brief Share of the points that are near a body. */
double nearShare(const UnitPoints& points, double reach, const Superquadric& body) {
  const std::vector<float> distances = distancesTo(body, points);
  const auto near = std::count_if(distances.begin(), distances.end(), [&](float d) {
    return std::abs(double(d)) <= reach;
  });
  return double(near) / double(points.size());
}

/** \brief Beyond the points of all sides is nothing: lowers a rim to the highest of
 * them, from where the fit may raise it, for no point holds down one that is above. */
void lowerRim(const UnitPoints& points, Superquadric& s) {
  std::vector<double> heights(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    heights[i] = s.toLocal(points[i].cast<double>()).z() / s.semi_axes.z();
  const auto top = heights.end() - 1 - std::ptrdiff_t(CUT * double(heights.size()));
  std::nth_element(heights.begin(), top, heights.end());
  const double lowest = std::min(tuning::vessel_problem::MIN_RIM, s.rim);
  s.rim = std::clamp(*top, lowest, s.rim);
}

/** \brief A vessel beside a solid where nobody knows the noise: that of points on both
 * sides of a wall looks as large as the wall is thick. Each has the noise that it
 * leaves, sigma, and -2 ln L is 2 n ln sigma. */
std::optional<ShapeCandidate> fromAllRound(const ViewProblem& problem,
                                           double sigma,
                                           Vessel vessel,
                                           const ShapeCandidate& solid) {
  constexpr int ROUNDS = 3;
  const UnitPoints& points = problem.medium();
  // most vessels are none to within the noise: foot and rim are thicker than the wall
  double own = std::max(sigma, WIDE);
  vessel = VesselFamily(problem, points, 2.0 * own).fit(vessel);
  for (int round = 0; round < ROUNDS; ++round) {
    lowerRim(points, vessel.model);
    own = std::min(own, scatterOf(points, own, vessel.model));
    vessel = VesselFamily(problem, points, own).fit(vessel);
  }
  const double inside = VesselFamily(problem, points, own).insideShare(vessel.model);
  if (!(vessel.cost < 1e299) || std::min(inside, 1.0 - inside) < BOTH_SIDES ||
      vessel.model.wall < RESOLVED * own ||
      nearShare(points, STANDS_OFF * std::max(own, MODEL_ERROR), vessel.model) <
          EXPLAINED)
    return std::nullopt;
  // a solid between the two sides of a wall is off the points by as much; its cost
  // about that is one an observation
  const double gain =
      2.0 * problem.observations() *
          std::log(scatterOf(points, std::max(sigma, vessel.model.wall), solid.model) /
                   own) +
      problem.observations() - vessel.cost;
  ShapeCandidate c = vesselCandidate(vessel, problem);
  c.bic += solid.cost - gain - c.cost;
  c.cost = std::min(problem.observations(), solid.cost);
  return c;
}

bool cheaperVessel(const Vessel& a, const Vessel& b) {
  return a.cost < b.cost;
}

/** \brief Whether a vessel is better than all solids, which pay for what they hide. It
 * is compared as scaleEvidence() will do. \param[in,out] solids where it is, their
 * costs become those */
bool beatsSolids(const ViewProblem& problem,
                 double sigma,
                 const ShapeCandidate& vessel,
                 std::vector<ShapeCandidate>& solids) {
  std::vector<ShapeCandidate> paying = solids;
  double least = vessel.cost;
  for (ShapeCandidate& c : paying) {
    const double cost = hiddenPoints(problem, sigma, c.model).cost;
    c.cost += cost;
    c.bic += cost;
    least = std::min(least, c.cost);
  }
  const double inflation = std::max(1.0, least / problem.observations());
  const auto scaled = [&](const ShapeCandidate& c) {
    return c.bic - c.cost * (1.0 - 1.0 / inflation);
  };
  for (const ShapeCandidate& c : paying)
    if (!(scaled(vessel) < scaled(c)))
      return false;
  solids = std::move(paying);
  return true;
}

} // namespace

std::optional<ShapeCandidate> fitVessel(const ViewProblem& problem,
                                        double sigma,
                                        std::vector<ShapeCandidate>& candidates) {
  const ShapeCandidate* best = nullptr;
  for (const ShapeCandidate& c : candidates)
    if (!best || c.cost < best->cost)
      best = &c;
  if (!best)
    return std::nullopt;
  if (problem.eye() && !(hiddenPoints(problem, sigma, best->model).share > SEEN_BEHIND))
    return std::nullopt;
  // it goes between the wall's two sides, or along one of them
  if (!problem.eye() &&
      1.0 - nearShare(problem.medium(), 0.5 * RESOLVED * sigma, best->model) <
          BOTH_SIDES)
    return std::nullopt;
  std::vector<Eigen::Vector3d> axes;
  if (problem.hasUp())
    axes.push_back(problem.up());
  else
    for (int k = 0; k < 3; ++k)
      for (const double sign : {1.0, -1.0})
        axes.emplace_back(sign * best->model.rotation.col(k));
  const VesselFamily rough(
      problem, problem.coarse(), std::max(WIDE, 2.0 * problem.noise()));
  std::vector<Vessel> found;
  for (const Eigen::Vector3d& axis : axes)
    for (const Superquadric& start : vesselStarts(problem, axis))
      found.push_back(rough.fit({start, 0.0, problem.hasUp()}, 0));
  std::sort(found.begin(), found.end(), cheaperVessel);
  found.resize(std::min(found.size(), ROUGH));
  for (Vessel& v : found)
    v = rough.fit(v, SEARCH_ITERATIONS);
  std::sort(found.begin(), found.end(), cheaperVessel);
  const VesselFamily thorough(problem, problem.medium(), sigma);
  if (!problem.eye()) { // only the noise that each leaves tells them apart
    const double wide = std::max(WIDE, 2.0 * problem.noise());
    const auto cost = [&](const Superquadric& body) {
      return pointsCost(problem.coarse(), wide, body);
    };
    // by one more for each point: a thin wall makes no difference yet
    const double most = cost(best->model) + double(problem.coarse().size());
    std::optional<ShapeCandidate> chosen;
    for (const Vessel& v : found)
      if (!(cost(v.model) < most))
        continue; // a solid is nearer to the points
      else if (const auto c = fromAllRound(problem, sigma, thorough.fit(v), *best))
        if (!chosen || c->bic < chosen->bic)
          chosen = c;
    return chosen;
  }
  found.resize(std::min(found.size(), tuning::fit_vessel::KEPT));
  for (Vessel& v : found)
    v = thorough.fit(v);
  const Vessel& vessel = *std::min_element(found.begin(), found.end(), cheaperVessel);
  if (!(vessel.cost < 1e299))
    return std::nullopt;
  const ShapeCandidate c = vesselCandidate(vessel, problem);
  if (!beatsSolids(problem, sigma, c, candidates))
    return std::nullopt;
  return c;
}

void fitVesselAgain(const ViewProblem& problem,
                    const UnitPoints& points,
                    double sigma,
                    ShapeCandidate& chosen) {
  if (!problem.eye())
    sigma = std::min(sigma, scatterOf(points, sigma, chosen.model));
  const Vessel fitted =
      VesselFamily(problem, points, sigma).fit({chosen.model, 0.0, chosen.upright});
  chosen.bic += fitted.cost - chosen.cost;
  chosen.cost = fitted.cost;
  chosen.model = fitted.model;
}

} // namespace pcl_sq::detail

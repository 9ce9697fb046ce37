// SPDX-License-Identifier: BSD-3-Clause
// The family of bent rods: bananas, handles.
#include "families/bent_problem.h"
#include "families/families.h"
#include "families/family_step.h"
#include "geometry/bend.h"
#include "tuning/view_tuning.h"
#include "view_problem/shape_spaces.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::family;
using namespace tuning::fit_bent;
using namespace tuning::shared;

struct Rod {
  Superquadric model;
  double cost = 1e300; ///< over sigma^2
  bool round = true;
  bool held = false; ///< it lies on the table
  bool thick = true; ///< or its section is known
};

Rod fitRod(const BentProblem& problem, const Rod& start, int iterations) {
  LmLimits limits;
  limits.max_iterations = iterations;
  limits.cost_tolerance = 1e-5;
  auto found = minimiseSquares(problem,
                               start.model,
                               start.thick ? bentBasis(start.round, start.held)
                                           : basisWithout<BentProblem::N>({6, 7}),
                               limits);
  Rod rod = start;
  rod.model = found.model;
  rod.model.rotation =
      Eigen::Quaterniond(found.model.rotation).normalized().toRotationMatrix();
  rod.cost = rod.model.isValid()
                 ? found.equations.cost / (problem.unit() * problem.unit())
                 : 1e300;
  return rod;
}

ShapeCandidate rodCandidate(const Rod& rod, const ViewProblem& problem) {
  ShapeCandidate c;
  c.shape = ShapeClass::BENT;
  c.before = rod.round ? ShapeClass::ROTATIONAL : ShapeClass::GENERIC;
  c.upright = rod.held;
  c.parameters = static_cast<int>(bentBasis(rod.round, rod.held).cols());
  c.cost = rod.cost;
  c.bic = c.cost + c.parameters * std::log(problem.observations()) + BENT;
  c.model = rod.model;
  return c;
}

/** \brief A straight rod about to bend, to either side of either axis across. */
std::vector<Superquadric> straightStarts(const Superquadric& body) {
  Eigen::Index longest;
  body.semi_axes.maxCoeff(&longest);
  std::vector<Superquadric> starts;
  Superquadric s = withAxis(body, int(longest));
  s.kx = s.ky = 0.0;
  s.epsilon1 = std::min(s.epsilon1, 1.0);
  s.epsilon2 = 1.0;
  for (int turn = 0; turn < 4; ++turn) {
    s.bend = SLIGHT / s.semi_axes.z();
    starts.push_back(s);
    s.rotation *=
        Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    std::swap(s.semi_axes.x(), s.semi_axes.y());
  }
  return starts;
}

/** \brief A bent sheet is none. */
bool isRod(const Superquadric& s) {
  return s.semi_axes.z() > SLENDER * s.semi_axes.head<2>().maxCoeff();
}

/** \brief The heights of a rod between which it has points. */
struct Stretch {
  double low, high;
};

Stretch seenOf(const UnitPoints& points, const Superquadric& s) {
  std::vector<double> along;
  for (std::size_t i = 0; i < points.size(); ++i)
    along.push_back(unbent(s, s.toLocal(points[i].cast<double>())).z());
  const auto cut = std::ptrdiff_t(STRAY * double(along.size()));
  std::nth_element(along.begin(), along.begin() + cut, along.end());
  const double low = along[std::size_t(cut)];
  std::nth_element(along.begin(), along.end() - 1 - cut, along.end());
  return {low, *(along.end() - 1 - cut)};
}

/** \brief Whether a rod is seen along most of its length: what is seen of a short
 * stretch of it may be anything's. */
bool isSeenAlong(const UnitPoints& points, const Superquadric& s) {
  const Stretch seen = seenOf(points, s);
  return seen.high - seen.low > SEEN_LENGTH * 2.0 * s.semi_axes.z();
}

/** \brief A rod without what reaches on by more than its width beyond its points, into
 * the body that it is a handle of. */
Superquadric trimmed(const UnitPoints& points, const Superquadric& s) {
  const Stretch seen = seenOf(points, s);
  const double a3 = s.semi_axes.z(), width = s.semi_axes.head<2>().maxCoeff();
  const double low = std::max(seen.low - width, -a3),
               high = std::min(seen.high + width, a3);
  const BentFrame middle = bentFrame(s, 0.5 * (low + high));
  Superquadric t = s;
  t.center = s.toWorld(middle.middle);
  t.rotation = s.rotation * middle.axes;
  t.semi_axes.z() = 0.5 * (high - low);
  return t;
}

bool cheaperRod(const Rod& a, const Rod& b) {
  return a.cost < b.cost;
}

} // namespace

std::optional<ShapeCandidate>
fitBent(const ViewProblem& problem,
        double sigma,
        const std::vector<ShapeCandidate>& candidates,
        const std::function<double(const Superquadric&)>& against,
        double profile) {
  const bool is_handle = profile > 0.0;
  const ShapeCandidate* best = nullptr;
  double least = 1e300, filled = 0.0;
  // a vessel without a camera has the likelihood of a noise of its own
  for (const ShapeCandidate& c : candidates)
    if (problem.eye() || c.shape != ShapeClass::VESSEL)
      if (const double more = against(c.model); c.cost + more < least) {
        best = &c;
        least = c.cost + more;
        filled = more;
      }
  if (!best || !(least > MISFIT * problem.observations()))
    return std::nullopt;
  std::vector<Superquadric> starts = bentStarts(problem);
  if (!best->model.isCut())
    for (const Superquadric& s : straightStarts(best->model))
      starts.push_back(s);
  const double wide = std::max(WIDE, 2.0 * problem.noise());
  const BentProblem rough(problem, problem.coarse(), wide, true);
  std::vector<Rod> found;
  for (const Superquadric& s : starts)
    if (s.isValid() && isRod(s)) {
      Rod start{s};
      start.model.semi_axes.head<2>().setConstant(
          is_handle ? 0.25 * profile / s.semi_axes.z()
                    : std::sqrt(s.semi_axes.x() * s.semi_axes.y()));
      start.thick = !is_handle;
      found.push_back(fitRod(rough, start, FIRST_ITERATIONS));
    }
  std::sort(found.begin(), found.end(), cheaperRod);
  found.resize(std::min(found.size(), PROMISING));
  for (Rod& rod : found)
    rod = fitRod(rough, rod, SEARCH_ITERATIONS - FIRST_ITERATIONS);
  std::sort(found.begin(), found.end(), cheaperRod);
  // from all round the rough fits tell more of a rod than from one side
  found.resize(std::min(found.size(), problem.eye() ? tuning::fit_bent::KEPT : 1));
  // of what is not bent, a bottle for instance, no arc is nearer to the points
  if (found.empty() ||
      (!is_handle && !(pointsCost(problem.coarse(), wide, found.front().model) +
                           against(found.front().model) <
                       pointsCost(problem.coarse(), wide, best->model) + filled)))
    return std::nullopt;
  const BentProblem thorough(problem, problem.medium(), sigma);
  std::optional<ShapeCandidate> chosen;
  const auto take = [&](const Rod& start) {
    Rod rod = fitRod(thorough, start, tuning::fit_bent::ITERATIONS);
    if (is_handle && rod.cost < 1e299) {
      Rod shorter = rod;
      shorter.model = trimmed(problem.medium(), rod.model);
      rod = fitRod(thorough, shorter, 0);
    }
    const ShapeCandidate c = rodCandidate(rod, problem);
    if (rod.cost < 1e299 && isRod(rod.model) &&
        isSeenAlong(problem.medium(), rod.model) && (!chosen || c.bic < chosen->bic))
      chosen = c;
    return rod;
  };
  for (Rod& rod : found)
    rod = take(rod);
  if (is_handle)
    return chosen;
  // flat or lying down, from the better one
  Rod rod = *std::min_element(found.begin(), found.end(), cheaperRod);
  rod.round = false;
  rod = take(rod);
  if (!problem.hasUp() ||
      !(std::abs(rod.model.rotation.col(1).dot(problem.up())) > UPRIGHT))
    return chosen;
  rod.held = true;
  rod.model = upright(rod.model, 1, problem.up());
  take(rod);
  rod.round = true;
  rod.model.semi_axes.head<2>().setConstant(
      std::sqrt(rod.model.semi_axes.x() * rod.model.semi_axes.y()));
  take(rod);
  return chosen;
}

void fitBentAgain(const ViewProblem& problem,
                  const UnitPoints& points,
                  double sigma,
                  ShapeCandidate& chosen) {
  const Rod start{
      chosen.model, 0.0, chosen.before == ShapeClass::ROTATIONAL, chosen.upright};
  const Rod rod =
      fitRod(BentProblem(problem, points, sigma),
             start,
             problem.eye() ? tuning::fit_bent::ITERATIONS : ALL_ROUND_ITERATIONS);
  if (!(rod.cost < 1e299))
    return;
  chosen.bic += rod.cost - chosen.cost;
  chosen.cost = rod.cost;
  chosen.model = rod.model;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "fit/full_fit.h"

#include "fit/density_filter.h"
#include "fit/start_shapes.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

using kernels::Residual;

constexpr int COARSE_ITERATIONS = 4; ///< per round, with the radial distance
constexpr int FINE_ITERATIONS = 5;   ///< per round, with the foot point's
constexpr int FINE_ROUNDS = 3;
constexpr int SWITCH_ROUNDS = 2;
constexpr std::size_t SWITCHES = 2;  ///< other descriptions that are refined
constexpr double MARGIN = 0.1;       ///< of the likelihood's between coarse and fine
constexpr double EXACT_START = 1e-4; ///< a sigma that only the right shape has
constexpr double NOTABLE = 1e-3;     ///< smallest gain that starts another round
constexpr double SETTLED = 0.05;     ///< relative change of sigma that ends the rounds
constexpr double COARSE_SHRINKAGE = 0.3;
constexpr double FINE_SHRINKAGE = 0.05;

bool better(const Candidate& a, const Candidate& b) {
  return a.nll < b.nll;
}

/** \brief Options of one Levenberg-Marquardt run for a mixture. */
LmOptions runOptions(const FitSetting& s,
                     const Candidate& c,
                     Residual residual,
                     std::size_t count) {
  LmOptions o = s.lm;
  o.residual = residual;
  if (s.limits.robust) {
    o.sigma = c.mixture.sigma;
    o.outlier = c.mixture.outlier(surfaceArea(c.model));
  }
  if (s.size_prior && residual == Residual::FOOT_POINT) {
    const Contributor prior =
        sizePrior(c.mixture.sigma, (1.0 - c.mixture.outlier_share) * double(count));
    const Contributor other = s.lm.contributor;
    o.contributor = [prior, other](const Superquadric& m, NormalEquations& e) {
      prior(m, e);
      if (other)
        other(m, e);
    };
  }
  return o;
}

} // namespace

Candidate anneal(const UnitPoints& points,
                 const Candidate& start,
                 Residual residual,
                 int rounds,
                 FitSetting& s) {
  const bool coarse = residual == Residual::RADIAL;
  const double shrinkage = coarse ? COARSE_SHRINKAGE : FINE_SHRINKAGE;
  Candidate c = start;
  for (int k = 0; k < rounds; ++k) {
    LmOptions o = runOptions(s, c, residual, points.size());
    o.max_iterations = coarse ? COARSE_ITERATIONS : FINE_ITERATIONS;
    o.cost_tolerance = 1e-3;
    const LmResult r = levenbergMarquardt(points, c.model, o);
    s.iterations += r.iterations;
    c.model = r.model;
    const double before = c.mixture.sigma;
    c.mixture = estimated(
        c.mixture, r.equations.share, r.equations.weighted, points.size(), s.limits);
    c.mixture.sigma = std::max(c.mixture.sigma, shrinkage * before);
    if (std::abs(c.mixture.sigma - before) < SETTLED * before &&
        r.termination == Termination::COST_CHANGE_TOO_SMALL)
      break;
  }
  const double cost =
      evaluateCost(points, c.model, runOptions(s, c, residual, points.size()));
  c.nll = c.mixture.negativeLogLikelihood(cost, points.size(), surfaceArea(c.model));
  return c;
}

Candidate search(const UnitPoints& points, const Superquadric* doubted, FitSetting& s) {
  const bool thorough = doubted != nullptr;
  const UnitPoints medium = subset(points, MEDIUM_POINTS);
  const UnitPoints coarse = thorough ? medium : subset(medium, COARSE_POINTS);
  const UnitPoints dense = subset(densePoints(points), 2 * MEDIUM_POINTS);
  // a tournament: few iterations for all starts, more for the best
  std::vector<Superquadric> starts = startShapes(dense);
  if (thorough)
    for (const Superquadric& start : furtherStartShapes(dense, *doubted))
      starts.push_back(start);
  std::vector<Candidate> candidates;
  Candidate best;
  best.mixture.volume = points.boxVolume();
  for (const Superquadric& start : starts) {
    best.model = start;
    candidates.push_back(anneal(coarse, best, Residual::RADIAL, 1, s));
  }
  for (const std::size_t keep : {4, 2}) {
    std::sort(candidates.begin(), candidates.end(), better);
    candidates.resize(std::min(candidates.size(), thorough ? 2 * keep : keep));
    for (Candidate& c : candidates)
      c = anneal(coarse, c, Residual::RADIAL, 1, s);
  }
  std::sort(candidates.begin(), candidates.end(), better);
  double coarse_nll = candidates.front().nll;
  best.nll = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates) {
    if (!thorough && c.nll > coarse_nll + 2.0 * MARGIN)
      break;
    const Candidate fine = anneal(medium, c, Residual::FOOT_POINT, FINE_ROUNDS, s);
    if (fine.nll < best.nll)
      best = fine;
    if (best.mixture.sigma < EXACT_START)
      return best;
  }
  // the same body described otherwise may be a better start than any of the above
  for (int round = 0; round < SWITCH_ROUNDS; ++round) {
    std::vector<Candidate> others;
    for (const Superquadric& m : otherDescriptions(best.model)) {
      Candidate c = best;
      c.model = m;
      c.mixture.sigma = std::max(3.0 * c.mixture.sigma, 0.03);
      others.push_back(anneal(coarse, c, Residual::RADIAL, 2, s));
    }
    std::sort(others.begin(), others.end(), better);
    others.resize(thorough ? 2 * SWITCHES : SWITCHES);
    const double before = best.nll;
    for (const Candidate& c : others) {
      if (!thorough && c.nll > coarse_nll + MARGIN)
        break;
      coarse_nll = std::min(coarse_nll, c.nll);
      const Candidate fine = anneal(medium, c, Residual::FOOT_POINT, FINE_ROUNDS, s);
      if (fine.nll < best.nll)
        best = fine;
    }
    if (best.nll > before - NOTABLE)
      break;
  }
  return best;
}

Candidate refine(const UnitPoints& points,
                 const Candidate& start,
                 FitSetting& s,
                 LmResult& last) {
  Candidate c = start;
  double damping = s.lm.initial_damping;
  for (int left = s.max_iterations; left > 0;) {
    LmOptions o = runOptions(s, c, Residual::FOOT_POINT, points.size());
    o.initial_damping = damping;
    o.max_iterations = std::min(left, FINE_ITERATIONS + 1);
    last = levenbergMarquardt(points, c.model, o);
    damping = last.damping;
    s.iterations += last.iterations;
    left -= std::max(last.iterations, 1);
    c.model = last.model;
    const double before = c.mixture.sigma;
    c.mixture = estimated(c.mixture,
                          last.equations.share,
                          last.equations.weighted,
                          points.size(),
                          s.limits);
    if (std::abs(c.mixture.sigma - before) < 0.01 * before &&
        last.termination != Termination::MAX_ITERATIONS)
      break;
  }
  c.nll = c.mixture.negativeLogLikelihood(
      last.equations.points_cost, points.size(), surfaceArea(c.model));
  return c;
}

} // namespace pcl_sq::detail

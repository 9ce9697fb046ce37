// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_tapered.h"

#include "density_filter.h"
#include "start_shapes.h"
#include "taper_problem.h"

#include <algorithm>

namespace pcl_sq {

namespace {

using namespace detail;

constexpr std::size_t FINAL_POINTS = 16384;
constexpr std::size_t DECIDING_POINTS = 2048;
constexpr std::size_t MEDIUM_POINTS = 512;
constexpr std::size_t COARSE_POINTS = 256;
constexpr double WIDE = 0.1; ///< sigma of the starts, in the cloud's deviation

/** \brief The untapered fit in its three axis orders, and the search's own starts. */
std::vector<Superquadric> startsFor(const UnitPoints& points,
                                    const Superquadric& untapered) {
  std::vector<Superquadric> starts = startShapes(densePoints(points));
  starts.push_back(untapered);
  for (const Superquadric& s : otherDescriptions(untapered))
    starts.push_back(s);
  return starts;
}

/** \brief The best tapered body of all starts. */
TaperCandidate search(const UnitPoints& points,
                      const Superquadric& untapered,
                      const FitSetting& setting) {
  const double area = surfaceArea(untapered);
  const UnitPoints medium = subset(points, MEDIUM_POINTS);
  const TaperProblem coarse_problem(subset(medium, COARSE_POINTS), setting, area);
  const TaperProblem medium_problem(medium, setting, area);
  std::vector<TaperCandidate> candidates;
  for (const Superquadric& start : startsFor(points, untapered)) {
    TaperCandidate c;
    c.model.shape = start;
    c.mixture.sigma = WIDE;
    c.mixture.volume = points.boxVolume();
    if (!setting.limits.robust)
      c.mixture.outlier_share = 0.0;
    candidates.push_back(coarse_problem.anneal(c, true, 2, 4, 1e-3));
  }
  const auto better = [](const TaperCandidate& a, const TaperCandidate& b) {
    return a.nll < b.nll;
  };
  for (const std::size_t keep : {4, 2}) {
    std::sort(candidates.begin(), candidates.end(), better);
    candidates.resize(std::min(candidates.size(), keep));
    const TaperProblem& problem = keep == 4 ? coarse_problem : medium_problem;
    for (TaperCandidate& c : candidates)
      c = problem.anneal(c, true, 4, 5, 1e-3);
  }
  return *std::min_element(candidates.begin(), candidates.end(), better);
}

TaperCandidate converged(const TaperProblem& problem,
                         const TaperCandidate& start,
                         bool free,
                         const FitSetting& setting) {
  return problem.anneal(start, free, 10, 6, setting.lm.cost_tolerance);
}

} // namespace

TaperedFit fitTapered(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                      const FitOptions& options,
                      Tapering tapering) {
  TaperedFit result;
  result.untapered = fitSuperquadric(points, options);
  result.model.shape = result.untapered.model;
  result.sigma = result.untapered.sigma;
  result.outlier_share = result.untapered.outlier_share;
  result.rms_distance = result.untapered.rms_distance;
  UnitFrame frame;
  if (!result.untapered.ok() || !principalFrame(points, frame))
    return result;
  const UnitPoints all = subset(toUnit(points, frame), FINAL_POINTS);
  const UnitPoints unit = subset(all, DECIDING_POINTS);
  FitSetting setting = settingOf(options, unit.size());
  setting.limits.fixed_sigma = options.noise / frame.scale;
  setting.size_prior = false; // only the distances decide whether there is a taper
  const double area = surfaceArea(frame.toUnit(result.untapered.model));
  const TaperProblem problem(unit, setting, area);

  TaperCandidate plain;
  plain.model.shape = frame.toUnit(result.untapered.model);
  plain.mixture = {result.sigma / frame.scale, result.outlier_share, unit.boxVolume()};
  TaperCandidate tapered =
      converged(problem, search(unit, plain.model.shape, setting), true, setting);
  // the same with its taper taken away: what another start is worth without any
  TaperCandidate without = tapered;
  without.model.kx = without.model.ky = 0.0;
  without.mixture.sigma = std::max(without.mixture.sigma, 0.3 * WIDE);
  plain = converged(problem, plain, false, setting);
  without = converged(problem, without, false, setting);
  const double best = std::min(plain.nll, without.nll);

  const auto n = double(problem.size());
  result.margin = n * (best - tapered.nll) - std::log(n); // two parameters, half each
  if (tapering == Tapering::AUTOMATIC && !(result.margin > TaperedFit::DEMAND))
    return result;
  setting.size_prior = options.size_prior;
  const TaperProblem final_problem(all, setting, area);
  tapered = converged(final_problem, tapered, true, setting);
  result.model = tapered.model;
  result.model.shape = frame.toCloud(tapered.model.shape);
  const Eigen::Vector2d deviations = final_problem.taperDeviations(tapered);
  result.kx_deviation = deviations.x();
  result.ky_deviation = deviations.y();
  result.sigma = tapered.mixture.sigma * frame.scale;
  result.outlier_share = tapered.mixture.outlier_share;
  result.rms_distance = final_problem.rmsDistance(tapered.model) * frame.scale;
  return result;
}

} // namespace pcl_sq

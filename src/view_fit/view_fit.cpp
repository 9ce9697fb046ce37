// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/view_fit.h"

#include "families/families.h"
#include "pcl_sq/multi_superquadric.h"
#include "tuning/view_tuning.h"
#include "union/surface_statistics.h"
#include "util/option_check.h"
#include "util/parallel_for.h"
#include "view_fit/search_view.h"

#include <algorithm>

namespace pcl_sq {

namespace {

using namespace detail;

using namespace tuning::view_fit;

bool cheaper(const Trial& a, const Trial& b) {
  return a.cost < b.cost;
}

/** \brief M14: coarse fits of all starts, the best of them refined; sorted by cost. */
std::vector<Trial> search(const ViewProblem& p, int& iterations) {
  std::vector<Superquadric> starts;
  if (p.options().start)
    starts.push_back(p.frame().toUnit(*p.options().start));
  else
    starts = viewStarts(p);
  if (p.options().starts > 0 && starts.size() > std::size_t(p.options().starts))
    starts.resize(std::size_t(p.options().starts));
  const double wide = std::max(0.3 * START_SIGMA, 2.0 * p.noise());
  std::vector<Trial> trials(starts.size());
  const auto forEachTrial = [&](const auto& work) {
    parallelFor(
        trials.size(), p.options().threads, [&](std::size_t i) { work(trials[i], i); });
  };
  forEachTrial([&](Trial& t, std::size_t i) {
    t.model = starts[i];
    t.sigma = std::max(START_SIGMA, p.noise());
    t = p.minimise(t, p.coarse(), kernels::Residual::RADIAL, 6, {}, true);
    t.sigma = wide;
    t = p.minimise(t, p.coarse(), kernels::Residual::RADIAL, 6, {}, true);
  });
  std::sort(trials.begin(), trials.end(), cheaper);
  const bool quick = !p.options().choose_shape && p.options().starts > 0;
  const std::size_t kept = quick ? 1 : KEPT;
  if (trials.size() > kept)
    trials.resize(kept);
  std::vector<double> sigmas(trials.size());
  forEachTrial([&](Trial& t, std::size_t i) {
    t = p.minimise(t, p.medium(), kernels::Residual::FOOT_POINT, 8, {}, quick);
    sigmas[i] = p.sigmaOf(t, p.medium());
  });
  // compared at one sigma, or the widest would win
  const double sigma = *std::min_element(sigmas.begin(), sigmas.end());
  forEachTrial([&](Trial& t, std::size_t) {
    t.sigma = sigma;
    t = p.minimise(t, p.medium(), kernels::Residual::FOOT_POINT, 12, {}, quick);
  });
  for (const Trial& t : trials)
    iterations += t.iterations;
  std::sort(trials.begin(), trials.end(), cheaper);
  const double again = p.sigmaOf(trials.front(), p.medium());
  for (Trial& t : trials)
    t.sigma = again;
  return trials;
}

/** \brief Where no family fits to within the noise, what is left is the model's error,
 * not the noise's, and no evidence for one family or the other: all costs are divided
 * by how many times the best one exceeds what noise leaves (the variance inflation of
 * quasi-likelihood; Burnham & Anderson 2002, section 2.5). */
void scaleEvidence(std::vector<ShapeCandidate>& candidates, double observations) {
  double least = 1e300;
  for (const ShapeCandidate& c : candidates)
    least = std::min(least, c.cost);
  const double inflation = std::max(1.0, least / observations);
  for (ShapeCandidate& c : candidates)
    c.bic -= c.cost * (1.0 - 1.0 / inflation);
}

} // namespace

namespace detail {

ViewFit searchView(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                   const ViewEvidence& evidence,
                   const ViewFitOptions& options,
                   const Objection& objection) {
  ViewFit result;
  ViewProblem problem;
  if (!problem.prepare(points, evidence, options)) {
    result.fit.points = problem.all().size();
    result.fit.termination = problem.all().size() > 0 ? Termination::TOO_FEW_POINTS
                                                      : Termination::DEGENERATE;
    return result;
  }
  const std::vector<Trial> general = search(problem, result.fit.iterations);
  result.candidates = fitShapes(problem, general.front());
  if (options.taper && options.choose_shape)
    if (const auto tapered =
            fitTaper(problem, general.front().sigma, result.candidates))
      result.candidates.push_back(*tapered);
  if (options.vessel && options.choose_shape)
    if (const auto vessel =
            fitVessel(problem, general.front().sigma, result.candidates))
      result.candidates.push_back(*vessel);
  const auto against = [&](const Superquadric& body) {
    return objection ? objection(problem.frame().toCloud(body)) : 0.0;
  };
  if (options.bend && options.choose_shape)
    if (const auto bent =
            fitBent(problem, general.front().sigma, result.candidates, against))
      result.candidates.push_back(*bent);
  if (options.choose_shape)
    if (const auto tin = fitLid(problem, general.front().sigma, result.candidates))
      result.candidates.push_back(*tin);
  for (ShapeCandidate& c : result.candidates) {
    const double covers = against(c.model);
    c.cost += covers;
    c.bic += covers;
  }
  scaleEvidence(result.candidates, problem.observations());
  std::sort(
      result.candidates.begin(),
      result.candidates.end(),
      [](const ShapeCandidate& a, const ShapeCandidate& b) { return a.bic < b.bic; });
  if (options.all_points)
    fitAgain(problem, problem.all(), general.front().sigma, result.candidates.front());
  for (ShapeCandidate& c : result.candidates)
    c.model = problem.frame().toCloud(c.model);
  result.chosen = result.candidates.front();
  for (const ShapeCandidate& c : result.candidates)
    if (c.shape != result.chosen.shape) {
      result.margin = c.bic - result.chosen.bic;
      break;
    }
  result.noise = general.front().sigma * problem.frame().scale;
  FitSummary& fit = result.fit;
  fit.model = result.chosen.model;
  fit.termination = general.front().termination;
  fit.points = problem.all().size();
  fit.sigma = result.noise;
  return result;
}

ViewFit fitSameFamily(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                      const ViewEvidence& evidence,
                      const ViewFitOptions& options,
                      ViewFit fit) {
  ViewProblem problem;
  if (!problem.prepare(points, evidence, options)) {
    fit.fit.termination = Termination::TOO_FEW_POINTS;
    return fit;
  }
  ShapeCandidate& chosen = fit.candidates.front();
  chosen = fit.chosen;
  chosen.model = problem.frame().toUnit(chosen.model);
  fitAgain(problem, problem.medium(), problem.noise(), chosen);
  chosen.model = problem.frame().toCloud(chosen.model);
  fit.chosen = chosen;
  fit.fit.model = chosen.model;
  fit.fit.points = problem.all().size();
  return fit;
}

void addDistances(const Eigen::Ref<const Eigen::Matrix3Xd>& points, FitSummary& fit) {
  MultiSuperquadric single;
  single.parts.push_back(fit.model);
  const SurfaceStatistics statistics = surfaceStatistics(single, points);
  fit.distortion = statistics.distortion;
  fit.rms_distance = statistics.rms_distance;
}

} // namespace detail

bool ViewFitOptions::isValid(std::string* why) const {
  OptionCheck check(why);
  check.inRange("noise", noise, 0.0, 1e9);
  check.inRange("effective_points", effective_points, 0.0, 1e15);
  check.inRange("max_semi_axis", max_semi_axis, 0.0, 1e9);
  check.inRange(
      "min_epsilon", min_epsilon, Superquadric::MIN_EPSILON, Superquadric::MAX_EPSILON);
  check.inRange("max_epsilon", max_epsilon, min_epsilon, Superquadric::MAX_EPSILON);
  check.inRange("starts", starts, 0, 24);
  return check.passed();
}

const ShapeCandidate& ViewFit::straight() const {
  const auto found =
      std::find_if(candidates.begin(), candidates.end(), [](const auto& c) {
        return c.shape < ShapeClass::TAPERED; // those of the paper come first
      });
  return found == candidates.end() ? chosen : *found;
}

const char* toString(ShapeClass shape) {
  switch (shape) {
  case ShapeClass::GENERIC:
    return "generic";
  case ShapeClass::ROTATIONAL:
    return "rotational";
  case ShapeClass::BOX:
    return "box";
  case ShapeClass::ELLIPSOID:
    return "ellipsoid";
  case ShapeClass::TAPERED:
    return "tapered";
  case ShapeClass::BENT:
    return "bent";
  case ShapeClass::VESSEL:
    return "vessel";
  }
  return "unknown";
}

ViewFit fitView(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                const ViewEvidence& evidence,
                const ViewFitOptions& options) {
  ViewFit result = detail::searchView(points, evidence, options);
  if (result.fit.ok())
    detail::addDistances(points, result.fit);
  return result;
}

} // namespace pcl_sq

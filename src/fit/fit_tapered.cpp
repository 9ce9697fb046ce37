// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_tapered.h"

#include "fit/density_filter.h"
#include "fit/full_fit.h"
#include "fit/start_shapes.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace pcl_sq {

namespace {

using namespace detail;

constexpr std::size_t FINAL_POINTS = 16384;
constexpr std::size_t DECIDING_POINTS = 2048;
constexpr double WIDE = 0.1; ///< sigma of the starts, in the cloud's deviation

constexpr double SHRINKAGE = 0.2; ///< of sigma in a round, at most
constexpr double TAPER_SETTLED =
    0.01; ///< relative change of sigma that ends the rounds

/** \brief Points and what tapered bodies are fitted to them with.
 *
 * One density on the surface, that of a given area, holds for all bodies: what they are
 * compared by is how close they come to the points and nothing else. With each body's
 * own area a single view would be won by the taper that makes the hidden side small. */
class TaperProblem {
public:
  TaperProblem(const UnitPoints& points, const FitSetting& setting, double area)
      : points_(points), setting_(setting), area_(area) {}

  std::size_t size() const { return points_.size(); }

  /** \brief Fits from a start, the mixture estimated anew after each round, until both
   * have settled. \param[in] free whether the taper is estimated too
   * \param[in] rounds at most \param[in] iterations in each \param[in] tolerance
   * relative decrease of the cost that ends a round */
  Candidate
  anneal(Candidate c, bool free, int rounds, int iterations, double tolerance) const {
    Basis<13> basis = Eigen::Matrix<double, 13, 13>::Identity();
    if (!free)
      basis.conservativeResize(13, 11);
    for (int k = 0; k < rounds; ++k) {
      LmOptions o = optionsFor(c.mixture);
      o.max_iterations = iterations;
      o.cost_tolerance = tolerance;
      const auto r = fitTaperedBody(points_, c.model, basis, o, priorFor(c.mixture));
      c.model = r.model;
      const double before = c.mixture.sigma;
      c.mixture = estimated(
          c.mixture, r.equations.share, r.equations.weighted, size(), setting_.limits);
      c.mixture.sigma = std::max(c.mixture.sigma, SHRINKAGE * before);
      if (std::abs(c.mixture.sigma - before) < TAPER_SETTLED * before)
        break;
    }
    c.nll = c.mixture.negativeLogLikelihood(
        sumsOf<13>(points_, c.model, optionsFor(c.mixture)).points_cost, size(), area_);
    return c;
  }

  /** \brief Standard deviations of kx and ky at a minimum. */
  Eigen::Vector2d taperDeviations(const Candidate& c) const {
    const LmOptions o = optionsFor(c.mixture);
    const ContributorOf<13> prior = priorFor(c.mixture);
    Eigen::Matrix<double, 13, 13> information =
        PointsProblem<13>{points_, o, prior}.evaluate(c.model).jtj;
    const double largest = information.diagonal().maxCoeff();
    if (!(largest > 0.0))
      return Eigen::Vector2d::Zero();
    const Vector13 size =
        information.diagonal().cwiseMax(1e-12 * largest).cwiseSqrt().cwiseInverse();
    information = size.asDiagonal() * information * size.asDiagonal();
    information.diagonal().array() += 1e-9; // a direction that nothing determines
    const auto inverse =
        information.ldlt().solve(Eigen::Matrix<double, 13, 13>::Identity()).eval();
    return c.mixture.sigma * size.tail<2>().cwiseProduct(
                                 inverse.diagonal().tail<2>().cwiseAbs().cwiseSqrt());
  }

  /** \brief Root mean square of the distances. */
  double rmsDistance(const Superquadric& model) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < size(); ++i)
      sum += std::pow(model.footPointDistance(points_[i].cast<double>()), 2);
    return std::sqrt(sum / double(size()));
  }

private:
  LmOptions optionsFor(const Mixture& mixture) const {
    LmOptions o = setting_.lm;
    o.sigma = mixture.sigma;
    o.outlier = mixture.outlier(area_);
    return o;
  }
  ContributorOf<13> priorFor(const Mixture& mixture) const {
    if (!setting_.size_prior)
      return {};
    const double inliers = (1.0 - mixture.outlier_share) * double(size());
    return [prior = sizePrior(mixture.sigma, inliers)](const Superquadric& m,
                                                       SquareSums<13>& sums) {
      NormalEquations own;
      prior(m, own);
      sums.jtj.topLeftCorner<11, 11>() += own.jtj;
      sums.jtr.head<11>() += own.jtr;
      sums.cost += own.cost;
    };
  }

  UnitPoints points_;
  FitSetting setting_;
  double area_;
};

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
Candidate searchTaper(const UnitPoints& points,
                      const Superquadric& untapered,
                      const FitSetting& setting) {
  const double area = surfaceArea(untapered);
  const UnitPoints medium = subset(points, MEDIUM_POINTS);
  const TaperProblem coarse_problem(subset(medium, COARSE_POINTS), setting, area);
  const TaperProblem medium_problem(medium, setting, area);
  std::vector<Candidate> candidates;
  for (const Superquadric& start : startsFor(points, untapered)) {
    Candidate c;
    c.model = start;
    c.mixture.sigma = WIDE;
    c.mixture.volume = points.boxVolume();
    if (!setting.limits.robust)
      c.mixture.outlier_share = 0.0;
    candidates.push_back(coarse_problem.anneal(c, true, 2, 4, 1e-3));
  }
  const auto better = [](const Candidate& a, const Candidate& b) {
    return a.nll < b.nll;
  };
  for (const std::size_t keep : {4, 2}) {
    std::sort(candidates.begin(), candidates.end(), better);
    candidates.resize(std::min(candidates.size(), keep));
    const TaperProblem& problem = keep == 4 ? coarse_problem : medium_problem;
    for (Candidate& c : candidates)
      c = problem.anneal(c, true, 4, 5, 1e-3);
  }
  return *std::min_element(candidates.begin(), candidates.end(), better);
}

Candidate converged(const TaperProblem& problem,
                    const Candidate& start,
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
  result.model = result.untapered.model;
  result.sigma = result.untapered.sigma;
  result.outlier_share = result.untapered.outlier_share;
  result.rms_distance = result.untapered.rms_distance;
  Normalisation frame;
  if (!result.untapered.ok() || !principalFrame(points, frame))
    return result;
  const UnitPoints all = subset(toUnit(points, frame), FINAL_POINTS);
  const UnitPoints unit = subset(all, DECIDING_POINTS);
  FitSetting setting = settingOf(options, unit.size());
  setting.limits.fixed_sigma = options.noise / frame.scale;
  setting.size_prior = false; // only the distances decide whether there is a taper
  const double area = surfaceArea(frame.toUnit(result.untapered.model));
  const TaperProblem problem(unit, setting, area);

  Candidate plain;
  plain.model = frame.toUnit(result.untapered.model);
  plain.mixture = {result.sigma / frame.scale, result.outlier_share, unit.boxVolume()};
  Candidate tapered =
      converged(problem, searchTaper(unit, plain.model, setting), true, setting);
  // the same with its taper taken away: what another start is worth without any
  Candidate without = tapered;
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
  result.model = frame.toCloud(tapered.model);
  const Eigen::Vector2d deviations = final_problem.taperDeviations(tapered);
  result.kx_deviation = deviations.x();
  result.ky_deviation = deviations.y();
  result.sigma = tapered.mixture.sigma * frame.scale;
  result.outlier_share = tapered.mixture.outlier_share;
  result.rms_distance = final_problem.rmsDistance(tapered.model) * frame.scale;
  return result;
}

} // namespace pcl_sq

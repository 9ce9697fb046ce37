// SPDX-License-Identifier: BSD-3-Clause
#include "full_fit.h"

#include "density_filter.h"
#include "surface_area.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace pcl_sq::detail {

namespace {

constexpr double SQRT_TWO_PI = 2.5066282746310002;
constexpr std::size_t COARSE_POINTS = 256;
constexpr std::size_t MEDIUM_POINTS = 512;

using kernels::Residual;

LmOptions baseOptions(const FitSetting& s) {
  LmOptions o;
  o.min_epsilon = s.options.min_epsilon;
  o.max_epsilon = s.options.max_epsilon;
  o.max_axis = s.max_axis;
  o.min_axis = 1e-5;
  o.contributor = s.contributor;
  return o;
}

double areaOf(const Superquadric& m) {
  return std::exp(logArea(m.semi_axes, m.epsilon1, m.epsilon2).value);
}

/** \brief New width and share from the sums of the last evaluation. */
void update(Mixture& m, const NormalEquations& e, std::size_t n, const FitSetting& s) {
  if (e.share > 0.0)
    m.sigma = std::max(std::sqrt(e.weighted / e.share), s.min_sigma);
  if (s.fixed_sigma > 0.0)
    m.sigma = s.fixed_sigma;
  m.outlier_share =
      std::clamp(1.0 - e.share / double(n), 1e-4, s.options.max_outlier_share);
}

/** \brief Negative log-likelihood per point up to a constant, from the mixture's cost.
 */
double nll(double cost, std::size_t n, const Mixture& m, double area) {
  const double c = m.outlier(area);
  const double peak = (1.0 - m.outlier_share) / (area * SQRT_TWO_PI * m.sigma);
  return 0.5 * cost / (m.sigma * m.sigma * double(n)) - std::log(peak * (1.0 + c));
}

double DEVK() {
  static double k = getenv("K") ? atof(getenv("K")) : 1.0;
  return k;
}

/** \brief The density of points on a surface of area A is 1/A: its logarithm as a cost,
 * in squared lengths. It vanishes with the noise. */
Contributor sizePrior(double weight, const Contributor& other) {
  return [weight, other](const Superquadric& m, NormalEquations& e) {
    const LogArea area = logArea(m.semi_axes, m.epsilon1, m.epsilon2);
    e.cost += 2.0 * weight * area.value;
    e.jtr.tail<5>() += weight * area.gradient;
    e.jtj.bottomRightCorner<5, 5>() +=
        weight * area.gradient * area.gradient.transpose();
    if (other)
      other(m, e);
  };
}

void setPrior(LmOptions& o, const Mixture& m, std::size_t n, const FitSetting& s) {
  o.contributor = s.contributor;
  if (s.options.size_prior)
    o.contributor =
        sizePrior(DEVK() * m.sigma * m.sigma * (1.0 - m.outlier_share) * double(n),
                  s.contributor);
}

void setMixture(LmOptions& o,
                const Mixture& m,
                const Superquadric& model,
                bool robust) {
  o.sigma = robust ? m.sigma : 0.0;
  o.outlier = robust ? m.outlier(areaOf(model)) : 0.0;
}

/** \brief Annealed fit of one start: the mixture is estimated anew after every few
 * iterations. */
Candidate anneal(const UnitPoints& points,
                 const Superquadric& start,
                 Mixture mixture,
                 Residual residual,
                 int rounds,
                 int iterations,
                 FitSetting& s) {
  LmOptions o = baseOptions(s);
  o.residual = residual;
  o.max_iterations = iterations;
  o.cost_tolerance = 1e-4;
  Candidate c;
  c.model = start;
  c.mixture = mixture;
  NormalEquations e;
  for (int k = 0; k < rounds; ++k) {
    setMixture(o, c.mixture, c.model, s.options.robust);
    if (residual == Residual::FOOT_POINT)
      setPrior(o, c.mixture, points.size(), s);
    const LmResult r = levenbergMarquardt(points, c.model, o);
    s.iterations += r.iterations;
    c.model = r.model;
    e = r.equations;
    const double before = c.mixture.sigma;
    update(c.mixture, e, points.size(), s);
    // no faster than a third a round: the basin narrows with the width
    c.mixture.sigma = std::max(c.mixture.sigma, 0.3 * before);
  }
  setMixture(o, c.mixture, c.model, s.options.robust);
  const double cost = evaluateCost(points, c.model, o);
  c.nll = nll(cost, points.size(), c.mixture, areaOf(c.model));
  return c;
}

/** \brief The same body with its axes permuted cyclically and the exponents exchanged;
 * exact where both exponents agree. */
Superquadric axisSwitched(const Superquadric& m, int shift) {
  Superquadric s = m;
  for (int k = 0; k < 3; ++k) {
    s.rotation.col(k) = m.rotation.col((k + shift) % 3);
    s.semi_axes[k] = m.semi_axes[(k + shift) % 3];
  }
  std::swap(s.epsilon1, s.epsilon2);
  return s;
}

/** \brief The dual description of a cross-section: turned by 45 degrees, e2 -> 2 - e2.
 * Exact for a square against a rotated square (Liu et al. 2022). */
Superquadric dualSwitched(const Superquadric& m) {
  Superquadric s = m;
  const double factor =
      m.epsilon2 <= 1.0
          ? (1.0 - std::sqrt(2.0)) * m.epsilon2 + std::sqrt(2.0)
          : 1.0 / ((1.0 - std::sqrt(2.0)) * (2.0 - m.epsilon2) + std::sqrt(2.0));
  s.semi_axes[0] = s.semi_axes[1] = factor * std::sqrt(m.semi_axes[0] * m.semi_axes[1]);
  s.epsilon2 = std::max(2.0 - m.epsilon2, 0.05);
  s.rotation =
      m.rotation *
      Eigen::AngleAxisd(0.25 * M_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return s;
}

} // namespace

double Mixture::outlier(double area) const {
  return outlier_share / (1.0 - outlier_share) * area / volume * SQRT_TWO_PI * sigma;
}

std::vector<Superquadric> startShapes(const UnitPoints& dense) {
  std::vector<Superquadric> starts;
  const std::size_t n = dense.size();
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < n; ++i)
    mean += dense[i];
  mean /= float(n);
  Eigen::Matrix3f covariance = Eigen::Matrix3f::Zero();
  for (std::size_t i = 0; i < n; ++i)
    covariance += (dense[i] - mean) * (dense[i] - mean).transpose();
  Eigen::Matrix3d axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance.cast<double>())
          .eigenvectors();
  if (axes.determinant() < 0.0)
    axes.col(2) *= -1.0;
  std::vector<float> along(n);
  Eigen::Vector3d low, high;
  const auto cut = static_cast<std::ptrdiff_t>(n / 100);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3f axis = axes.col(k).cast<float>();
    for (std::size_t i = 0; i < n; ++i)
      along[i] = axis.dot(dense[i]);
    std::nth_element(along.begin(), along.begin() + cut, along.end());
    low[k] = along[cut];
    std::nth_element(along.begin(), along.end() - 1 - cut, along.end());
    high[k] = *(along.end() - 1 - cut);
  }
  const Eigen::Vector3d middle = axes * (0.5 * (low + high));
  const Eigen::Vector3d half =
      (0.5 * (high - low)).cwiseMax(0.05 * (high - low).maxCoeff());
  for (int shift = 0; shift < 3; ++shift)
    for (int kind = 0; kind < 3; ++kind) {
      Superquadric s;
      s.center = middle;
      for (int k = 0; k < 3; ++k) {
        s.rotation.col(k) = axes.col((k + shift) % 3);
        s.semi_axes[k] = half[(k + shift) % 3];
      }
      if (kind > 0)
        s.epsilon1 = s.epsilon2 = 0.3;
      if (kind == 2)
        s.rotation *=
            Eigen::AngleAxisd(0.25 * M_PI, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      starts.push_back(s);
    }
  return starts;
}

Candidate search(const UnitPoints& points, FitSetting& s) {
  const UnitPoints medium = subset(points, MEDIUM_POINTS);
  const UnitPoints coarse = subset(medium, COARSE_POINTS);
  const UnitPoints dense = densePoints(subset(points, 8192));
  Mixture wide;
  wide.sigma = 0.1;
  wide.outlier_share = 0.1;
  wide.volume = s.volume;
  std::vector<Candidate> candidates;
  for (const Superquadric& start : startShapes(dense))
    candidates.push_back(anneal(coarse, start, wide, Residual::RADIAL, 3, 4, s));
  const auto better = [](const Candidate& a, const Candidate& b) {
    return a.nll < b.nll;
  };
  std::sort(candidates.begin(), candidates.end(), better);
  Candidate best;
  best.nll = 1e300;
  for (std::size_t i = 0; i < 4 && i < candidates.size(); ++i) {
    const Candidate c = anneal(medium,
                               candidates[i].model,
                               candidates[i].mixture,
                               Residual::FOOT_POINT,
                               4,
                               5,
                               s);
    if (c.nll < best.nll)
      best = c;
  }
  for (int round = 0; round < 3; ++round) {
    std::vector<Superquadric> switched;
    for (int k = 0; k < 3; ++k) {
      const Superquadric turned = k == 0 ? best.model : axisSwitched(best.model, k);
      if (k > 0)
        switched.push_back(turned);
      const Superquadric dual = dualSwitched(turned);
      switched.push_back(dual);
      if (k == 0) {
        switched.push_back(axisSwitched(dual, 1));
        switched.push_back(axisSwitched(dual, 2));
      }
    }
    Candidate next = best;
    for (const Superquadric& m : switched) {
      Mixture mixture = best.mixture;
      mixture.sigma = std::max(3.0 * mixture.sigma, 0.03);
      Candidate c = anneal(coarse, m, mixture, Residual::RADIAL, 3, 4, s);
      c = anneal(medium, c.model, c.mixture, Residual::FOOT_POINT, 3, 5, s);
      if (c.nll < next.nll)
        next = c;
    }
    if (next.nll > best.nll - 1e-3)
      break;
    best = next;
  }
  return best;
}

Candidate refine(const UnitPoints& points,
                 const Candidate& start,
                 FitSetting& s,
                 LmResult& last) {
  LmOptions o = baseOptions(s);
  o.residual = Residual::FOOT_POINT;
  o.max_iterations = 5;
  o.space = ParameterSpace::without(s.options.fixed);
  Candidate c = start;
  if (s.fixed_sigma > 0.0)
    c.mixture.sigma = s.fixed_sigma;
  int left = s.options.max_iterations;
  for (int round = 0; left > 0; ++round) {
    setMixture(o, c.mixture, c.model, s.options.robust);
    setPrior(o, c.mixture, points.size(), s);
    o.max_iterations = std::min(left, 6);
    last = levenbergMarquardt(points, c.model, o);
    s.iterations += last.iterations;
    left -= last.iterations;
    c.model = last.model;
    const Mixture before = c.mixture;
    update(c.mixture, last.equations, points.size(), s);
    const bool settled = std::abs(c.mixture.sigma - before.sigma) < 0.02 * before.sigma;
    if (settled && last.termination != Termination::MAX_ITERATIONS)
      break;
  }
  c.nll = nll(last.equations.points_cost, points.size(), c.mixture, areaOf(c.model));
  return c;
}

} // namespace pcl_sq::detail

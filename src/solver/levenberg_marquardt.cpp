// SPDX-License-Identifier: BSD-3-Clause
#include "solver/levenberg_marquardt.h"

namespace pcl_sq::detail {

namespace {

/** \brief A point's share in what rounding alone changes in a cost: single-precision
 * residuals of points of size one, squared. Exact points would else keep a fit busy. */
constexpr double ROUNDING = 1e-14;
constexpr double TRUST = 0.7; ///< largest step of an angle, a logarithm, an exponent
constexpr double TAPER_TRUST = 0.3; ///< largest step of a taper

/** \brief Shortens a part of a step. \return whether it did */
template <int N>
bool shorten(Eigen::Matrix<double, N, 1>& step, int begin, int size, double trust) {
  const double largest = step.segment(begin, size).cwiseAbs().maxCoeff();
  if (!(largest > trust))
    return false;
  step.segment(begin, size) *= trust / largest;
  return true;
}

bool outOf(double value, double low, double high, double direction) {
  return (value <= low && direction < 0.0) || (value >= high && direction > 0.0);
}

} // namespace

ParameterSpace ParameterSpace::without(unsigned fixed) {
  ParameterSpace space;
  int columns = 0;
  for (int i = 0; i < 11; ++i)
    if (!(fixed >> i & 1U))
      space.basis.col(columns++) = Vector11::Unit(i);
  space.basis.conservativeResize(11, columns);
  return space;
}

ParameterSpace ParameterSpace::rotational() {
  ParameterSpace space = without(1U << 5 | 1U << 7 | 1U << 10);
  space.basis.col(5)[7] = 1.0; // the column of ln a1 moves ln a2 as well
  return space;
}

kernels::Mixture mixtureOf(const LmOptions& o) {
  kernels::Mixture m;
  if (o.sigma > 0.0 && o.outlier > 0.0) {
    m.inverse_two_sigma_squared = static_cast<float>(0.5 / (o.sigma * o.sigma));
    m.outlier = static_cast<float>(std::clamp(o.outlier, 1e-12, 1e6));
  }
  return m;
}

template <>
SquareSums<11> sumsOf<11>(const UnitPoints& points,
                          const Superquadric& model,
                          const LmOptions& options) {
  kernels::Sums sums;
  kernels::kernels().normalEquations(
      points.view(), toShape(model), options.residual, mixtureOf(options), sums);
  return squaresOf<11>(sums);
}

template <>
SquareSums<13> sumsOf<13>(const UnitPoints& points,
                          const Superquadric& model,
                          const LmOptions& options) {
  kernels::SumsOf<kernels::TAPERED_ROWS> sums;
  kernels::kernels().taperedEquations(
      points.view(), toShape(model), mixtureOf(options), sums);
  return squaresOf<13>(sums);
}

double evaluateCost(const UnitPoints& points,
                    const Superquadric& model,
                    const LmOptions& options,
                    double* share) {
  kernels::Sums sums;
  kernels::kernels().evaluate(
      points.view(), toShape(model), options.residual, mixtureOf(options), sums);
  if (share)
    *share = sums.share;
  return sums.cost;
}

Superquadric
moved(const Superquadric& model, const Vector11& step, const LmOptions& o) {
  Superquadric m = model;
  m.center += m.rotation * step.head<3>();
  const double angle = step.segment<3>(3).norm();
  if (angle > 0.0)
    m.rotation *=
        Eigen::AngleAxisd(angle, step.segment<3>(3) / angle).toRotationMatrix();
  for (int k = 0; k < 3; ++k)
    m.semi_axes[k] =
        std::clamp(m.semi_axes[k] * std::exp(step[6 + k]), o.min_axis, o.max_axis);
  m.epsilon1 = std::clamp(m.epsilon1 + step[9], o.min_epsilon, o.max_epsilon);
  m.epsilon2 = std::clamp(m.epsilon2 + step[10], o.min_epsilon, o.max_epsilon);
  return m;
}

template <int N>
SquareSums<N> PointsProblem<N>::evaluate(const Superquadric& model) const {
  Equations e = sumsOf<N>(points, model, options);
  if (contributor)
    contributor(model, e);
  return e;
}

template <int N>
Superquadric PointsProblem<N>::moved(const Superquadric& m,
                                     const Vector& step,
                                     bool& limited) const {
  Vector s = step;
  limited = shorten(s, 0, 3, TRUST * m.semi_axes.maxCoeff());
  limited = shorten(s, 3, 3, TRUST) || limited;
  limited = shorten(s, 6, 3, TRUST) || limited;
  limited = shorten(s, 9, 2, TRUST) || limited;
  Superquadric next = detail::moved(m, s.template head<11>(), options);
  if constexpr (N == 13) {
    constexpr double MOST = Superquadric::MAX_TAPER;
    limited = shorten(s, 11, 2, TAPER_TRUST) || limited;
    next.kx = std::clamp(m.kx + s[11], -MOST, MOST);
    next.ky = std::clamp(m.ky + s[12], -MOST, MOST);
  }
  return next;
}

template <int N>
bool PointsProblem<N>::isActiveBound(const Superquadric& m,
                                     const Vector& direction) const {
  const LmOptions& o = options;
  for (int k = 0; k < 3; ++k)
    if (outOf(m.semi_axes[k], o.min_axis, o.max_axis, direction[6 + k]))
      return true;
  if (outOf(m.epsilon1, o.min_epsilon, o.max_epsilon, direction[9]) ||
      outOf(m.epsilon2, o.min_epsilon, o.max_epsilon, direction[10]))
    return true;
  if constexpr (N == 13) {
    constexpr double MOST = Superquadric::MAX_TAPER;
    return outOf(m.kx, -MOST, MOST, direction[11]) ||
           outOf(m.ky, -MOST, MOST, direction[12]);
  }
  return false;
}

template <int N>
double PointsProblem<N>::rounding() const {
  return ROUNDING * double(points.size());
}

template struct PointsProblem<11>;
template struct PointsProblem<13>;

namespace {

template <int N>
LmSummary<PointsProblem<N>> minimise(const PointsProblem<N>& problem,
                                     const Superquadric& start,
                                     const Basis<N>& basis) {
  auto r = minimiseSquares(
      problem, moved(start, Vector11::Zero(), problem.options), basis, problem.options);
  r.model.rotation =
      Eigen::Quaterniond(r.model.rotation).normalized().toRotationMatrix();
  return r;
}

} // namespace

LmResult levenbergMarquardt(const UnitPoints& points,
                            const Superquadric& start,
                            const LmOptions& o) {
  return minimise(PointsProblem<11>{points, o, o.contributor}, start, o.space.basis);
}

LmSummary<PointsProblem<13>> fitTaperedBody(const UnitPoints& points,
                                            const Superquadric& start,
                                            const Basis<13>& basis,
                                            const LmOptions& options,
                                            const ContributorOf<13>& contributor) {
  return minimise(PointsProblem<13>{points, options, contributor}, start, basis);
}

} // namespace pcl_sq::detail

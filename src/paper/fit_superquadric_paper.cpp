// SPDX-License-Identifier: BSD-3-Clause
// The paper's fit, III-B: pose, a1 and a2 are known, (e1, e2, a3) by
// Levenberg-Marquardt.
#include "paper/paper_problem.h"
#include "pcl_sq/fit_superquadric.h"

#include "solver/descriptions.h"
#include "solver/lm.h"
#include "union/surface_statistics.h"
#include "util/point_set.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace pcl_sq {

namespace {

constexpr std::size_t MIN_POINTS = 10; ///< for three parameters and some noise
/** \brief Exponents and ln a3 are of order one. */
constexpr double STEP_TOLERANCE = 2e-7;
constexpr double ROUNDING = 1e-6; ///< of a cost, relative

using detail::PaperProblem;

FitSummary minimise(const PaperProblem& problem,
                    const Superquadric& start,
                    const PaperFitOptions& options) {
  detail::LmLimits limits;
  limits.max_iterations = options.max_iterations;
  limits.step_tolerance = STEP_TOLERANCE;
  limits.cost_rounding = ROUNDING;
  const auto found = detail::minimiseSquares(problem,
                                             problem.clamp(problem.parametersOf(start)),
                                             Eigen::Matrix3d::Identity(),
                                             limits);
  FitSummary summary;
  summary.model = problem.superquadricAt(found.model);
  summary.distortion = found.equations.cost;
  summary.iterations = found.iterations;
  summary.termination = found.termination;
  return summary;
}

/** \brief Half the points' extent along a direction, a share cut off at each end. */
double halfExtent(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                  const Eigen::Vector3d& direction,
                  double cut) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::vector<float> along; // only quantiles need all of them
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (!points.col(i).allFinite())
      continue;
    const double value = direction.dot(points.col(i));
    low = std::min(low, value);
    high = std::max(high, value);
    if (cut > 0.0)
      along.push_back(float(value));
  }
  if (!along.empty()) {
    const auto skip = static_cast<std::ptrdiff_t>(cut * double(along.size() - 1));
    std::nth_element(along.begin(), along.begin() + skip, along.end());
    low = double(along[skip]);
    std::nth_element(along.begin(), along.end() - 1 - skip, along.end());
    high = double(*(along.end() - 1 - skip));
  }
  return high > low ? 0.5 * (high - low) : 0.0;
}

/** \brief Where a turned body has the depth, the paper's a3. */
int freeAxis(int shift) {
  return (2 - shift + 3) % 3;
}

} // namespace

Superquadric initialSuperquadric(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                 const Eigen::Vector3d& center,
                                 const Eigen::Matrix3d& rotation,
                                 double depth,
                                 const PaperFitOptions& options) {
  Superquadric s;
  s.center = center;
  s.rotation = rotation;
  s.semi_axes.setConstant(0.5 * depth);
  const double cut =
      options.extents == Extents::QUANTILES ? std::max(options.quantile, 0.0) : 0.0;
  for (int axis = 0; axis < 2; ++axis)
    s.semi_axes[axis] = halfExtent(points, rotation.col(axis), cut);
  // no axis may vanish: a face seen head-on has no depth of its own
  const double floor = 1e-3 * s.semi_axes.maxCoeff();
  s.semi_axes = s.semi_axes.cwiseMax(floor);
  return s;
}

FitSummary fitSuperquadricPaper(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                const Superquadric& initial,
                                const PaperFitOptions& options) {
  FitSummary best;
  best.model = initial;
  const auto stop = [&best](Termination termination) {
    best.termination = termination;
    return best;
  };
  if (!options.isValid())
    return stop(Termination::INVALID_OPTIONS);
  best.points = detail::momentsOf(points).count;
  if (best.points < MIN_POINTS)
    return stop(Termination::TOO_FEW_POINTS);
  if (detail::spannedDimensions(points) < 3)
    return stop(Termination::DEGENERATE);
  if (!initial.isValid())
    return stop(Termination::INVALID_OPTIONS);
  detail::Normalisation frame; // that of the start, its longest semi-axis as the unit
  frame.origin = initial.center;
  frame.axes = initial.rotation;
  frame.scale = initial.semi_axes.maxCoeff();
  const detail::UnitPoints local = detail::toUnit(points, frame);
  const int turns = options.axis_assignment == AxisAssignment::BEST_OF_3 ? 3 : 1;
  int iterations = 0, best_shift = 0;
  for (int shift = 0; shift < turns; ++shift) {
    const Superquadric start = detail::axesShifted(frame.toUnit(initial), shift);
    const PaperProblem problem(local, start, freeAxis(shift), options);
    FitSummary summary = minimise(problem, start, options);
    iterations += summary.iterations;
    if (shift == 0 || summary.distortion < best.distortion) {
      best = summary;
      best_shift = shift;
    }
  }
  best.iterations = iterations;
  best.points = local.size();
  // back in metres; what was given stays to the last bit
  const Superquadric unit = best.model;
  best.model = detail::axesShifted(initial, best_shift);
  best.model.epsilon1 = unit.epsilon1;
  best.model.epsilon2 = unit.epsilon2;
  const int free_axis = freeAxis(best_shift);
  best.model.semi_axes[free_axis] = unit.semi_axes[free_axis] * frame.scale;
  if (options.keep_front)
    best.model.center += (best.model.semi_axes[free_axis] - initial.semi_axes[2]) *
                         initial.rotation.col(2);
  const auto statistics = detail::surfaceStatistics({{best.model}}, points);
  best.distortion = statistics.distortion;
  best.rms_distance = statistics.rms_distance;
  return best;
}

bool FitSummary::ok() const {
  return termination != Termination::NOT_RUN &&
         termination != Termination::TOO_FEW_POINTS &&
         termination != Termination::DEGENERATE &&
         termination != Termination::INVALID_OPTIONS;
}

const char* toString(Termination termination) {
  switch (termination) {
  case Termination::NOT_RUN:
    return "NOT_RUN";
  case Termination::COST_CHANGE_TOO_SMALL:
    return "COST_CHANGE_TOO_SMALL";
  case Termination::STEP_TOO_SMALL:
    return "STEP_TOO_SMALL";
  case Termination::GRADIENT_TOO_SMALL:
    return "GRADIENT_TOO_SMALL";
  case Termination::MAX_ITERATIONS:
    return "MAX_ITERATIONS";
  case Termination::DAMPING_TOO_LARGE:
    return "DAMPING_TOO_LARGE";
  case Termination::GIVEN_UP:
    return "GIVEN_UP";
  case Termination::TOO_FEW_POINTS:
    return "TOO_FEW_POINTS";
  case Termination::DEGENERATE:
    return "DEGENERATE";
  case Termination::INVALID_OPTIONS:
    return "INVALID_OPTIONS";
  }
  return "UNKNOWN";
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
// M29, cans and tins: a solid of revolution whose lid lies somewhat below its rim. The
// rim makes the outline, the lid has the points.
#include "families/families.h"
#include "tuning/view_tuning.h"
#include "view_problem/shape_spaces.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::fit_lid;

/** \brief Which points lie on the lid of an upright body, and how far below its top
 * most of them are. */
struct Lid {
  std::vector<std::size_t> points;
  double depth = 0.0;
};

Lid lidOf(const UnitPoints& points, const Superquadric& body, double sigma) {
  Lid lid;
  const double a3 = body.semi_axes.z(), radius = body.semi_axes.x();
  std::vector<double> depths;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d q =
        body.rotation.transpose() * (points[i].cast<double>() - body.center);
    if (q.head<2>().norm() > WITHIN * radius ||
        q.z() < a3 - DEEPEST * radius - 3.0 * sigma)
      continue;
    lid.points.push_back(i);
    depths.push_back(a3 - q.z());
  }
  if (double(depths.size()) < LEAST_SHARE * double(points.size())) {
    lid.points.clear();
    return lid;
  }
  const auto middle = depths.begin() + std::ptrdiff_t(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  lid.depth = std::clamp(*middle, 0.0, DEEPEST * radius);
  return lid;
}

/** \brief The points with those of the lid lifted to the rim; without them where there
 * is no depth of the lid yet. */
UnitPoints lifted(const UnitPoints& points,
                  const Lid& lid,
                  const std::optional<Eigen::Vector3d>& lift) {
  const kernels::Points all = points.view();
  std::vector<bool> on_lid(points.size(), false);
  for (const std::size_t i : lid.points)
    on_lid[i] = true;
  UnitPoints result;
  result.reserve(points.size());
  std::vector<float> precision;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (on_lid[i] && !lift)
      continue;
    const Eigen::Vector3f p =
        on_lid[i] ? Eigen::Vector3f(points[i] + lift->cast<float>()) : points[i];
    result.add(p.x(), p.y(), p.z());
    if (all.precision)
      precision.push_back(all.precision[i]);
  }
  if (all.precision)
    result.setPrecision(precision);
  return result;
}

} // namespace

std::optional<ShapeCandidate> fitLid(const ViewProblem& problem,
                                     double sigma,
                                     const std::vector<ShapeCandidate>& candidates) {
  const ShapeCandidate *best = nullptr, *round = nullptr;
  for (const ShapeCandidate& c : candidates) {
    if (!best || c.bic < best->bic)
      best = &c;
    if (c.shape == ShapeClass::ROTATIONAL && c.upright && !c.on_axis)
      round = &c;
  }
  if (!round || !problem.hasUp() || !problem.eye() ||
      (best == round && round->cost < problem.observations()))
    return std::nullopt;
  Trial t;
  t.model = round->model;
  t.sigma = sigma;
  if (t.model.rotation.col(2).dot(problem.up()) < 0.0) { // its z axis up: half a turn
    t.model.rotation.col(2) *= -1.0;
    t.model.rotation.col(1) *= -1.0;
  }
  const ParameterSpace space = standing(spaceOf(ShapeClass::ROTATIONAL), 2);
  // The body that they belong to ends at the lid: in the first round the rim's outline
  // and the wall tell where it ends, without them. Which points are the lid's follows
  // from the body, so that the cost may rise again: the best round counts.
  std::optional<Trial> tin;
  for (int i = 0; i < ROUNDS; ++i) {
    const Lid lid = lidOf(problem.medium(), t.model, sigma);
    if (lid.points.empty())
      break;
    std::optional<Eigen::Vector3d> lift;
    if (i > 0)
      lift = lid.depth * problem.up();
    t = problem.minimise(t,
                         lifted(problem.medium(), lid, lift),
                         kernels::Residual::FOOT_POINT,
                         tuning::fit_lid::ITERATIONS,
                         space);
    // a rim is an edge
    const bool is_tin = lift && lid.depth > 0.0 && t.model.epsilon1 <= EDGE;
    if (is_tin && (!tin || t.cost < tin->cost))
      tin = t;
  }
  if (!tin)
    return std::nullopt;
  ShapeCandidate c = *round;
  c.model = tin->model;
  c.cost = tin->cost;
  c.parameters = static_cast<int>(space.basis.cols()) + 1;
  c.bic = c.cost + c.parameters * std::log(problem.observations());
  return c;
}

} // namespace pcl_sq::detail

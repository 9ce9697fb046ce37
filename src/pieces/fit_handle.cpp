// SPDX-License-Identifier: BSD-3-Clause
// M22: the shape of a handle.
#include "families/families.h"
#include "pieces/free_space.h"
#include "pieces/handle.h"
#include "pieces/piece_outline.h"
#include "tuning/parts_tuning.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::shared;
using namespace tuning::fit_handle;

/** \brief Mean cost of points, none more than an outlier's. */
double
costPerPoint(const Superquadric& s, const Eigen::Matrix3Xd& points, double noise) {
  double cost = 0.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    cost += std::min(std::pow(s.footPointDistance(points.col(i)) / noise, 2), MAX_COST);
  return cost / double(points.cols());
}

void choose(Piece& handle, const ShapeCandidate& c) {
  handle.fit.candidates = {c};
  handle.fit.chosen = c;
  handle.fit.fit.model = c.model;
  handle.fit.fit.points = handle.points.size();
  handle.fit.fit.termination = Termination::COST_CHANGE_TOO_SMALL;
}

/** \brief The area that a handle covers, seen from the camera [m^2]; 0 without one. */
double profileOf(const PieceContext& context, const Piece& handle) {
  const ObservedObject& o = context.observed;
  if (!o.hasCamera() || handle.pixels.empty())
    return 0.0;
  const double pixel = context.pixel_step * o.depth;
  return double(handle.pixels.size()) * pixel * pixel / (o.camera.fx * o.camera.fy);
}

/** \brief The bent rod nearest to a handle's points. */
std::optional<ShapeCandidate>
rodAlong(const PieceContext& context, const Piece& handle, const Superquadric& around) {
  const ObservedObject& o = context.observed;
  const Eigen::Matrix3Xd points = gather(context, handle.points);
  ViewFitOptions options = context.options.fit;
  options.precision.clear();
  options.noise = context.noise;
  options.effective_points = std::max(
      12.0, o.effective_points * double(points.cols()) / double(o.points.cols()));
  options.max_semi_axis = 1.5 * halfDiagonal(points);
  ViewEvidence evidence =
      o.evidence(outlineBesideJoints(o, handle, halfDiagonal(points)),
                 context.options.silhouette_lines,
                 false);
  evidence.limits.insert(
      evidence.limits.end(), context.limits.begin(), context.limits.end());
  ViewProblem problem;
  if (!problem.prepare(points, evidence, options))
    return std::nullopt;
  ShapeCandidate nothing_near; // so that a rod is looked for
  nothing_near.cost = 1e299;
  nothing_near.model = problem.frame().toUnit(around);
  const double unit = problem.frame().scale;
  std::optional<ShapeCandidate> rod = fitBent(
      problem,
      problem.noise(),
      {nothing_near},
      [](const Superquadric&) { return 0.0; },
      profileOf(context, handle) / (unit * unit));
  if (rod)
    rod->model = problem.frame().toCloud(rod->model);
  return rod;
}

/** \brief Whether a body is a rod: twice as long as wide, whichever axis that is. */
bool isSlender(const Superquadric& s) {
  Eigen::Vector3d half = s.semi_axes;
  std::sort(half.data(), half.data() + 3);
  return half[2] > 2.0 * half[1] && half[1] < 2.0 * half[0];
}

/** \brief Makes a handle that is no rod, a disc around its points for instance, a bent
 * one where that explains the points as well. */
void preferRod(const PieceContext& context, Piece& handle, const Superquadric& around) {
  if (handle.fit.chosen.shape == ShapeClass::BENT || isSlender(handle.fit.chosen.model))
    return;
  std::optional<ShapeCandidate> rod = rodAlong(context, handle, around);
  if (!rod || !rod->model.isValid() ||
      !(rod->model.boundingBox().sizes().norm() <
        2.0 * LARGER * around.semi_axes.norm()))
    return;
  const Eigen::Matrix3Xd points = gather(context, handle.points);
  const double effective = context.observed.effective_points * double(points.cols()) /
                           double(context.observed.points.cols());
  const auto scoreOf = [&](const ShapeCandidate& c) {
    return effective * costPerPoint(c.model, points, context.noise) +
           coveredFreeSpace(context, c.model).cost +
           c.parameters * std::log(1.0 + context.observed.effective_points);
  };
  if (!(scoreOf(*rod) - ROD < scoreOf(handle.fit.chosen)))
    return;
  choose(handle, *rod);
}

} // namespace

Eigen::Vector3d meanOf(const Eigen::Matrix3Xd& points,
                       const std::vector<int>& columns) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int i : columns)
    mean += points.col(i) / double(columns.size());
  return mean;
}

Superquadric aroundPoints(const Eigen::Matrix3Xd& points,
                          const std::vector<int>& columns,
                          const Superquadric& body) {
  Superquadric s;
  const Eigen::Vector3d up = body.rotation.col(2);
  Eigen::Vector3d away = meanOf(points, columns) - body.center;
  away = (away - up * up.dot(away)).normalized();
  s.rotation << away, up.cross(away), up;
  Eigen::Vector3d low, high;
  const auto cut = std::ptrdiff_t(STRAY * double(columns.size()));
  for (int k = 0; k < 3; ++k) {
    std::vector<double> along;
    for (const int i : columns)
      along.push_back(s.rotation.col(k).dot(points.col(i)));
    std::sort(along.begin(), along.end());
    low[k] = *(along.begin() + cut);
    high[k] = *(along.end() - 1 - cut);
  }
  s.center = s.rotation * (0.5 * (low + high));
  s.semi_axes = 0.5 * (high - low).cwiseMax(0.05 * (high - low).maxCoeff());
  return s;
}

void fitHandle(const PieceContext& context, Piece& handle, const Superquadric& body) {
  fitPiece(context, handle, Effort::FULL);
  const Eigen::Matrix3Xd points = gather(context, handle.points);
  const Superquadric& found = handle.fit.fit.model;
  const Superquadric around =
      aroundPoints(context.observed.points, handle.points, body);
  const auto costOf = [&](const Superquadric& s) {
    return costPerPoint(s, points, context.noise);
  };
  const Eigen::Vector3d size = found.boundingBox().sizes();
  const bool near = handle.fit.fit.ok() &&
                    (found.center - around.center).norm() <
                        around.semi_axes.norm() + STANDS_OFF * context.noise &&
                    size.norm() < 2.0 * LARGER * around.semi_axes.norm() &&
                    costOf(found) < 0.5 * MAX_COST;
  if (near) {
    preferRod(context, handle, around);
    return;
  }
  ShapeCandidate c;
  c.shape = ShapeClass::ELLIPSOID;
  c.model = around;
  c.parameters = 9;
  c.cost = costOf(around) * context.observed.effective_points * double(points.cols()) /
           double(context.observed.points.cols());
  choose(handle, c);
  handle.misfit = c.cost;
  handle.score =
      c.cost + c.parameters * std::log(1.0 + context.observed.effective_points);
  preferRod(context, handle, around);
}

} // namespace pcl_sq::detail

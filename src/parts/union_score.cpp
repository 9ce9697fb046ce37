// SPDX-License-Identifier: BSD-3-Clause
#include "parts/union_score.h"

#include "tuning/parts_tuning.h"
#include "union/exposed_area.h"
#include "util/point_grid.h"
#include "view_problem/plane_cost.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>

namespace pcl_sq::detail {

namespace {

using namespace tuning::part;
using namespace tuning::shared;
using namespace tuning::union_score;

} // namespace

struct BodyTrace {
  Superquadric model;
  Eigen::AlignedBox3d box;
  Eigen::VectorXd distances; ///< signed, of all points [m]
  SurfaceCells cells;
  Eigen::ArrayXd half; ///< of the cells' width, on either side of another surface [m]
  double sticks_out = 0.0; ///< of the points' box [m]

  /** \brief Distances of the cells to another body, where those are near. */
  const Eigen::VectorXd& to(const BodyTrace& other) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    Eigen::VectorXd& beyond = met_[other.number_];
    if (beyond.size() == 0) {
      beyond = half;
      keepNearer(other.model, cells.middles, half, beyond);
    }
    return beyond;
  }

  std::size_t number() const { return number_; }

private:
  static inline std::atomic<std::size_t> made_{1};
  const std::size_t number_ = made_++; ///< tells bodies apart, also those that are gone
  mutable std::mutex mutex_;
  mutable std::map<std::size_t, Eigen::VectorXd> met_;
};

namespace {

std::shared_ptr<const BodyTrace> traceOf(const PieceContext& context,
                                         const Superquadric& model) {
  auto trace = std::make_shared<BodyTrace>();
  const Eigen::Matrix3Xd& points = context.observed.points;
  trace->model = model;
  trace->box = model.boundingBox();
  trace->distances = surfaceDistances(model, points);
  trace->cells = surfaceCells(model);
  // one width for both of two surfaces that run side by side, or the area between them
  // would depend on the sizes of their cells
  trace->half = (0.5 * trace->cells.areas.sqrt()).min(SIDE_BY_SIDE * context.noise);
  trace->sticks_out =
      std::max((trace->box.max() - points.rowwise().maxCoeff()).maxCoeff(),
               (points.rowwise().minCoeff() - trace->box.min()).maxCoeff());
  return trace;
}

/** \brief The sides of the points' box as half-spaces. */
std::vector<TangentPlane> sidesOfBox(const ObservedObject& o) {
  std::vector<TangentPlane> sides;
  for (int k = 0; k < 3; ++k)
    for (const double sign : {1.0, -1.0}) {
      TangentPlane side;
      side.normal = sign * Eigen::Vector3d::Unit(k);
      side.offset = (sign * o.points.row(k)).maxCoeff();
      side.sigma = BOX_SIGMA * o.extent;
      sides.push_back(side);
    }
  return sides;
}

/** \brief Cost of the points' distances to the union, summed over all of them. */
double costOf(const PieceContext& context, const std::vector<const Part*>& parts) {
  // the smallest signed distance is that to the union
  Eigen::ArrayXd distances =
      Eigen::ArrayXd::Constant(context.observed.points.cols(), 1e300);
  for (const Part* part : parts)
    distances = distances.min(part->trace->distances.array());
  const Eigen::ArrayXd z = distances / context.noise;
  return -2.0 * (((-0.5 * z.square()).max(-700.0).exp() + OUTLIER) / (1.0 + OUTLIER))
                    .log()
                    .sum();
}

} // namespace

void traceAgain(const PieceContext& context, Part& part) {
  part.trace.reset();
  if (part.piece.fit.fit.ok())
    part.trace = traceOf(context, part.piece.fit.fit.model);
}

double distanceOf(const Part& part, int column) {
  return part.trace->distances[column];
}

std::size_t traceNumber(const Part& part) {
  return part.trace ? part.trace->number() : 0;
}

std::vector<std::size_t> nearestParts(const std::vector<Part>& parts,
                                      const std::vector<int>& points) {
  std::vector<std::size_t> nearest;
  for (const int i : points) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < parts.size(); ++k)
      if (std::abs(distanceOf(parts[k], i)) < std::abs(distanceOf(parts[best], i)))
        best = k;
    nearest.push_back(best);
  }
  return nearest;
}

void fitPart(const PieceContext& context, Part& part, Effort effort) {
  fitPiece(context, part.piece, effort);
  traceWithinBox(context, part);
}

void traceWithinBox(const PieceContext& context, Part& part) {
  traceAgain(context, part);
  if (part.trace && part.trace->sticks_out > SLACK * context.observed.extent) {
    PieceContext within = context;
    const std::vector<TangentPlane> sides = sidesOfBox(context.observed);
    within.limits.insert(within.limits.end(), sides.begin(), sides.end());
    Part held = part;
    fitPiece(within, held.piece, Effort::SAME);
    traceAgain(context, held);
    if (held.trace && held.trace->sticks_out < part.trace->sticks_out)
      part = std::move(held);
  }
}

namespace {

/** \brief What a body is worse by that leaves the points' box: far more than any part
 * can gain, and yet one such description can be compared with another. */
double outsideCost(const ObservedObject& o, const BodyTrace& trace) {
  const double out = trace.sticks_out / (BEYOND * o.extent);
  return out > 1.0 ? OUTSIDE * out * o.effective_points : 0.0;
}

} // namespace

double scoreOf(const PieceContext& context, const std::vector<const Part*>& parts) {
  const ObservedObject& o = context.observed;
  double parameters = 0.0, demand = 0.0, area = 0.0;
  for (const Part* part : parts) {
    if (!part->trace)
      return 1e300;
    demand += outsideCost(o, *part->trace);
    parameters += part->piece.fit.chosen.parameters;
    if (part->trace->model.isTapered())
      demand += TAPER;
    if (part->trace->model.isBent())
      demand += BENT;
  }
  for (const Part* part : parts) {
    const BodyTrace& own = *part->trace;
    Eigen::VectorXd beyond = own.half;
    for (const Part* other : parts)
      if (other != part && own.box.intersects(other->trace->box))
        beyond = beyond.cwiseMin(own.to(*other->trace));
    // a cell that another part's surface crosses counts in part
    area += ((0.5 + 0.5 * beyond.array() / own.half).max(0.0) * own.cells.areas).sum();
  }
  return (costOf(context, parts) / double(o.points.cols()) +
          2.0 * std::log(area / (o.extent * o.extent))) *
             o.effective_points +
         parameters * std::log(1.0 + o.effective_points) + demand;
}

double mostGain(const PieceContext& context, const Part& part) {
  const ObservedObject& o = context.observed;
  if (!part.trace || outsideCost(o, *part.trace) > 0.0)
    return 1e300;
  const double off = costOf(context, {&part}) / double(o.points.cols()) - 1.0;
  const double bare =
      -2.0 * std::log(std::max(covered(context, part.trace->model), 1e-6));
  return (std::max(off, 0.0) + bare) * o.effective_points;
}

double covered(const PieceContext& context, const Superquadric& body) {
  std::vector<Eigen::Vector3d> points;
  for (Eigen::Index i = 0; i < context.observed.points.cols(); ++i)
    points.emplace_back(context.observed.points.col(i));
  const SurfaceCells cells = surfaceCells(body);
  const double area = cells.areas.sum();
  // where points are spread evenly, hardly any place is farther from all than this
  const double reach = FARTHEST * std::sqrt(area / double(points.size()));
  const PointGrid grid(std::move(points), reach);
  double beside = 0.0;
  for (Eigen::Index i = 0; i < cells.areas.size(); ++i)
    if (grid.anyNear(cells.middles.col(i), reach))
      beside += cells.areas[i];
  return beside / area;
}

bool assignPoints(const PieceContext& context, std::vector<Part>& parts) {
  const Eigen::Index n = context.observed.points.cols();
  Eigen::VectorXd nearest = Eigen::VectorXd::Constant(n, 1e300);
  std::vector<std::size_t> owner(static_cast<std::size_t>(n), 0);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    Eigen::VectorXd distances = parts[k].trace->distances.cwiseAbs();
    for (const int i : parts[k].piece.points)
      distances[i] -= context.noise;
    for (Eigen::Index i = 0; i < n; ++i)
      if (distances[i] < nearest[i]) {
        nearest[i] = distances[i];
        owner[static_cast<std::size_t>(i)] = k;
      }
  }
  std::vector<std::vector<int>> points(parts.size());
  bool changed = false;
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (const int i : parts[k].piece.points) {
      points[owner[static_cast<std::size_t>(i)]].push_back(i);
      changed = changed || owner[static_cast<std::size_t>(i)] != k;
    }
  for (const auto& list : points)
    if (list.size() < MIN_POINTS)
      return false;
  for (std::size_t k = 0; k < parts.size(); ++k)
    parts[k].piece.points.swap(points[k]);
  return changed;
}

} // namespace pcl_sq::detail

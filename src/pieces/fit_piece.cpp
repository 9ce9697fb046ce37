// SPDX-License-Identifier: BSD-3-Clause
// One piece, one superquadric: fitted, and scored so that pieces compare (M17).
#include "families/families.h"
#include "pieces/free_space.h"
#include "pieces/piece_outline.h"
#include "tuning/parts_tuning.h"
#include "view_fit/search_view.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

using namespace tuning::fit_piece;
using tuning::odds::THIN_SIGMA;

/** \brief Heights above the table of points, of all but a few. */
struct Heights {
  double low, high;
};

Heights heightsOf(const TableModel& table, const Eigen::Matrix3Xd& points) {
  std::vector<double> heights;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    heights.push_back(table.height(points.col(i)));
  const auto few = static_cast<std::ptrdiff_t>(heights.size() / 33);
  const auto low = heights.begin() + few, high = heights.end() - 1 - few;
  std::nth_element(heights.begin(), low, heights.end());
  const double lowest = *low;
  std::nth_element(heights.begin(), high, heights.end());
  return {lowest, *high};
}

/** \brief Half the diagonal of what is seen of a piece, with its points or without, at
 * their depth: where an image does not show its neighbour's left edge nothing is
 * matched. */
double halfSeen(const PieceContext& context,
                const Piece& piece,
                const Eigen::Matrix3Xd& points) {
  const double of_points = halfDiagonal(points);
  const ObservedObject& o = context.observed;
  if (o.pixels.cells.empty() || piece.pixels.empty())
    return of_points;
  Eigen::Vector2d low = piece.pixels.front(), high = low;
  for (const Eigen::Vector2d& p : piece.pixels) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Eigen::Vector2d focal(o.camera.fx, o.camera.fy);
  return std::max(of_points, 0.5 * o.depth * (high - low).cwiseQuotient(focal).norm());
}

/** \brief -2 ln of how rarely things are so thin (M17): next to nothing beside what
 * shows a thickness, but two faces that are seen are hardly two sheets. */
double priceOfThinness(const Superquadric& body) {
  if (body.isCut())
    return 0.0; // its wall has a price of its own
  Eigen::Vector3d a = body.semi_axes;
  std::sort(a.data(), a.data() + 3);
  return std::pow(std::log(a[0] / a[1]) / THIN_SIGMA, 2);
}

/** \brief Whether a piece reaches the table: its lowest points are on it, or, where
 * nobody sees the object's foot, they are its lowest. */
bool reachesTable(const PieceContext& context, const Heights& heights) {
  const ObservedObject& o = context.observed;
  const double floor = o.hidden_below ? heightsOf(*o.table, o.points).low : 0.0;
  // the lowest visible points of a body lie somewhat above its bottom's far edge
  return heights.low - floor < 0.18 * o.extent + 3.0 * context.noise + o.foot;
}

} // namespace

void fitPiece(const PieceContext& context,
              Piece& piece,
              Effort effort,
              const Superquadric* coaxial) {
  const ObservedObject& o = context.observed;
  const Eigen::Matrix3Xd points = gather(context, piece.points);
  const double share = double(points.cols()) / double(o.points.cols());
  ViewFitOptions options = context.options.fit;
  if (!o.pixels.cells.empty() && !piece.ends.empty())
    options.max_epsilon = std::min(options.max_epsilon, PART_EPSILON);
  options.noise = context.noise;
  options.effective_points = std::max(12.0, share * o.effective_points);
  options.max_semi_axis = 1.5 * halfSeen(context, piece, points);
  options.precision.clear(); // fitObject() knows it of each point, see isValid()
  if (!context.precision.empty())
    for (const int i : piece.points)
      options.precision.push_back(context.precision[std::size_t(i)]);
  bool reaches = false;
  if (o.table && piece.stands) {
    const Heights heights = heightsOf(*o.table, points);
    reaches = reachesTable(context, heights);
    if (reaches && o.hidden_below) // from the top that is seen down to the table
      options.max_semi_axis = std::max(options.max_semi_axis, 0.75 * heights.high);
  }
  const bool general = effort == Effort::QUICK || effort == Effort::START;
  options.choose_shape = options.choose_shape && !general;
  options.vessel = options.vessel && piece.stands; // a handle is none
  options.taper = options.taper && piece.stands;   // nor is it a cone
  if (effort == Effort::STRAIGHT)
    options.vessel = options.taper = false;
  // from a wrong place the far side of a solid is its inside
  if (o.hasCamera() && !o.viewpoint_known && !piece.ends.empty())
    options.vessel = false;
  if (effort == Effort::UNBENT || effort == Effort::STRAIGHT ||
      (effort == Effort::FINAL && piece.fit.chosen.shape != ShapeClass::BENT))
    options.bend = false;
  options.all_points = !o.hasCamera() && !general;
  if (coaxial)
    options.coaxial = *coaxial;
  if (effort == Effort::QUICK)
    options.starts = QUICK_STARTS;
  const bool goes_on = effort != Effort::FULL && !general;
  if (goes_on && piece.fit.fit.ok())
    options.start = piece.fit.straight().model;
  ViewEvidence evidence =
      o.evidence(outlineBesideJoints(o, piece, halfDiagonal(points)),
                 context.options.silhouette_lines,
                 reaches);
  evidence.tangents.insert(
      evidence.tangents.end(), piece.ends.begin(), piece.ends.end());
  evidence.limits.insert(
      evidence.limits.end(), context.limits.begin(), context.limits.end());
  const double price = std::log(1.0 + o.effective_points); // of a parameter
  const FreeSpaceCost free_space(context, piece);
  const auto against = [&](const Superquadric& body) {
    return free_space(body) + priceOfThinness(body);
  };
  const auto assess = [&](ViewFit fit, double hinges) {
    Piece assessed;
    assessed.fit = std::move(fit);
    if (!assessed.fit.fit.ok())
      return assessed;
    assessed.covered = coveredFreeSpace(context, assessed.fit.fit.model).cost;
    assessed.misfit = assessed.fit.chosen.cost - hinges;
    assessed.score =
        assessed.misfit - (assessed.fit.chosen.on_axis ? SHARED_AXIS : 0.0) +
        demandOf(assessed.fit.chosen.shape) + assessed.fit.chosen.parameters * price -
        0.5 * double(evidence.silhouette.size());
    assessed.straight_misfit = assessed.misfit;
    assessed.straight_score = assessed.score;
    const ShapeCandidate &chosen = assessed.fit.chosen,
                         &straight = assessed.fit.straight();
    // a vessel that fits is no two parts, whatever a solid makes of it
    if (chosen.shape == ShapeClass::TAPERED || chosen.shape == ShapeClass::BENT) {
      assessed.straight_misfit += straight.cost - chosen.cost;
      assessed.straight_score += straight.cost - chosen.cost - demandOf(chosen.shape) -
                                 (chosen.parameters - straight.parameters) * price;
    }
    return assessed;
  };
  const bool same = effort == Effort::SAME && piece.fit.fit.ok();
  Piece best =
      assess(same ? fitSameFamily(points, evidence, options, std::move(piece.fit))
                  : searchView(points, evidence, options, against),
             0.0);
  const int rounds = effort == Effort::FINAL ? FREE_ROUNDS : 0;
  for (int round = 0; round < rounds && best.fit.fit.ok(); ++round) {
    if (!coversFreeSpace(best))
      break;
    const Covered covered = coveredFreeSpace(context, best.fit.fit.model);
    ViewEvidence more = evidence;
    more.limits.insert(more.limits.end(), covered.limits.begin(), covered.limits.end());
    options.start = best.fit.straight().model;
    ViewFit next = searchView(points, more, options, against);
    const double hinges = hingeCost(covered.limits, next.fit.model);
    Piece assessed = assess(std::move(next), hinges);
    if (!(assessed.score < best.score))
      break;
    best = std::move(assessed);
  }
  piece.fit = std::move(best.fit);
  piece.covered = best.covered;
  piece.misfit = best.misfit;
  piece.score = best.score;
  piece.straight_misfit = best.straight_misfit;
  piece.straight_score = best.straight_score;
}

bool coversFreeSpace(const Piece& piece) {
  return piece.covered >= WORTH_A_ROUND;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "parts/whole_cloud.h"

#include "util/parallel_for.h"
#include "view_problem/plane_cost.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t TRIED = 3; ///< best proposals that are fitted in full
constexpr std::size_t MIN_POINTS = 24;
constexpr int ROUNDS = 3; ///< of assigning points and fitting again
/** \brief Density of outliers over the Gaussian's peak, as in the fits. */
constexpr double OUTLIER = 0.01;
/** \brief Distance over the noise from which on a point costs the same, to the last
 * digit. */
constexpr double OUTLYING = 9.0;
/** \brief Score by which a quick fit, to a sample of the points, may be worse than what
 * the full one is to beat. */
constexpr double QUICK_SLACK = 60.0;

/** \brief A description of the object and its score, smaller is better. */
struct Parts {
  std::vector<Piece> pieces;
  double score = 1e300;
  std::size_t cut = 0; ///< the piece that was cut last, the last one being its rest
};

/** \brief M19: minus twice the logarithm of the likelihood, plus the parameters' price.
 *
 * Points are spread evenly over the outer surface, with noise: a surface without points
 * costs as much as points without a surface. */
double scoreOf(const PieceContext& context, const std::vector<Piece>& pieces) {
  const ObservedObject& o = context.observed;
  // the smallest signed distance is that to the union
  Eigen::VectorXd distances = Eigen::VectorXd::Constant(o.points.cols(), 1e300);
  const Eigen::ArrayXd reach =
      Eigen::ArrayXd::Constant(distances.size(), OUTLYING * context.noise);
  std::vector<Superquadric> bodies;
  double parameters = 0.0, demand = 0.0;
  for (const Piece& piece : pieces) {
    if (!piece.fit.fit.ok())
      return 1e300;
    bodies.push_back(piece.fit.fit.model);
    keepNearer(bodies.back(), o.points, reach, distances);
    parameters += piece.fit.chosen.parameters;
    if (bodies.back().isTapered())
      demand += TAPER;
    if (bodies.back().isBent())
      demand += BENT;
  }
  double cost = 0.0;
  for (Eigen::Index i = 0; i < distances.size(); ++i) {
    const double z = distances[i] / context.noise;
    cost -= 2.0 * std::log((std::exp(-0.5 * z * z) + OUTLIER) / (1.0 + OUTLIER));
  }
  const double area = exposedArea(bodies) / (o.extent * o.extent);
  return (cost / double(distances.size()) + 2.0 * std::log(area)) * o.effective_points +
         parameters * std::log(1.0 + o.effective_points) + demand;
}

/** \brief Gives each point to the part with the nearest surface; a part keeps what
 * noise cannot tell. \return whether a point changed its part and no part lost nearly
 * all */
bool assignPoints(const PieceContext& context, std::vector<Piece>& pieces) {
  const Eigen::Index n = context.observed.points.cols();
  Eigen::VectorXd nearest = Eigen::VectorXd::Constant(n, 1e300);
  std::vector<std::size_t> owner(static_cast<std::size_t>(n), 0);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    Eigen::VectorXd distances =
        surfaceDistances(pieces[k].fit.fit.model, context.observed.points).cwiseAbs();
    for (const int i : pieces[k].points)
      distances[i] -= context.noise;
    for (Eigen::Index i = 0; i < n; ++i)
      if (distances[i] < nearest[i]) {
        nearest[i] = distances[i];
        owner[static_cast<std::size_t>(i)] = k;
      }
  }
  std::vector<std::vector<int>> points(pieces.size());
  bool changed = false;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    for (const int i : pieces[k].points) {
      points[owner[static_cast<std::size_t>(i)]].push_back(i);
      changed = changed || owner[static_cast<std::size_t>(i)] != k;
    }
  for (const auto& list : points)
    if (list.size() < MIN_POINTS)
      return false;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    pieces[k].points.swap(points[k]);
  return changed;
}

/** \brief Gives points to the nearest part and fits the parts again while that pays. */
void settle(const PieceContext& context, Parts& parts) {
  parts.score = scoreOf(context, parts.pieces);
  for (int round = 0; round < ROUNDS && parts.score < 1e299; ++round) {
    Parts next = parts;
    if (!assignPoints(context, next.pieces))
      return;
    for (std::size_t k = 0; k < next.pieces.size(); ++k)
      if (next.pieces[k].points != parts.pieces[k].points)
        fitPiece(context, next.pieces[k], Effort::AGAIN);
    next.score = scoreOf(context, next.pieces);
    if (!(next.score < parts.score))
      return;
    parts = std::move(next);
  }
}

/** \brief The best way to cut one of the parts in two; score 1e300 if there is none. */
Parts bestSplit(const PieceContext& context,
                const Parts& parts,
                std::size_t which,
                double limit) {
  const std::vector<Cut> cuts = proposeCuts(context, parts.pieces[which]);
  const unsigned int threads = context.options.fit.threads;
  std::vector<Parts> tries(cuts.size());
  parallelFor(cuts.size(), threads, [&](std::size_t i) {
    Piece first = cutPiece(context, parts.pieces[which], cuts[i]);
    Piece second = cutPiece(context, parts.pieces[which], cuts[i].flipped());
    if (first.points.empty() || second.points.empty())
      return;
    fitPiece(context, first, Effort::QUICK);
    fitPiece(context, second, Effort::QUICK);
    tries[i] = parts;
    tries[i].cut = which;
    tries[i].pieces[which] = std::move(first);
    tries[i].pieces.push_back(std::move(second));
    tries[i].score = scoreOf(context, tries[i].pieces);
  });
  const auto better = [](const Parts& a, const Parts& b) { return a.score < b.score; };
  std::sort(tries.begin(), tries.end(), better);
  while (!tries.empty() && (tries.size() > TRIED || tries.back().score > limit))
    tries.pop_back();
  // half a try at a time: few are left, and the threads should end together
  parallelFor(2 * tries.size(), threads, [&](std::size_t i) {
    std::vector<Piece>& pieces = tries[i / 2].pieces;
    fitPiece(context, i % 2 == 0 ? pieces[which] : pieces.back(), Effort::FULL);
  });
  parallelFor(tries.size(), threads, [&](std::size_t i) { settle(context, tries[i]); });
  const auto best = std::min_element(tries.begin(), tries.end(), better);
  return best == tries.end() ? Parts() : std::move(*best);
}

/** \brief Cuts the part for which that pays most, or one twice where only that pays:
 * one cut of a handle with two corners helps little. \param[in] room how many parts may
 * be added \return whether one was cut */
bool splitOnce(
    const PieceContext& context, Parts& parts, int room, bool forced, double min_gain) {
  Parts best;
  for (std::size_t k = 0; k < parts.pieces.size(); ++k) {
    if (parts.pieces[k].final && !forced)
      continue;
    Parts split =
        bestSplit(context, parts, k, forced ? 1e299 : parts.score + QUICK_SLACK);
    if (split.score < best.score)
      best = split;
    if (!(split.score < parts.score - min_gain))
      parts.pieces[k].final = true;
  }
  const double limit = forced ? 1e299 : parts.score - min_gain;
  if (best.pieces.empty() || !(best.score <= limit)) {
    if (forced || room < 2 || best.pieces.empty())
      return false;
    const std::size_t second = best.pieces.size() - 1;
    Parts twice;
    for (const std::size_t k : {best.cut, second})
      if (Parts split = bestSplit(context, best, k, best.score);
          split.score < twice.score)
        twice = std::move(split);
    if (twice.score > limit - min_gain)
      return false;
    best = std::move(twice);
  }
  for (std::size_t k = 0; k < parts.pieces.size(); ++k)
    best.pieces[k].final =
        parts.pieces[k].final && best.pieces[k].points == parts.pieces[k].points;
  parts = std::move(best);
  return true;
}

/** \brief Makes two parts one where that costs less than the gain of one more part.
 * \return whether it did */
bool mergeOnce(const PieceContext& context, Parts& parts, double min_gain) {
  Parts best;
  for (std::size_t i = 0; i < parts.pieces.size(); ++i)
    for (std::size_t j = i + 1; j < parts.pieces.size(); ++j) {
      Parts next = parts;
      next.pieces[i] = mergePieces(parts.pieces[i], parts.pieces[j]);
      next.pieces.erase(next.pieces.begin() + std::ptrdiff_t(j));
      fitPiece(context, next.pieces[i], Effort::QUICK);
      next.score = scoreOf(context, next.pieces);
      if (next.score > parts.score + min_gain + QUICK_SLACK)
        continue;
      fitPiece(context, next.pieces[i], Effort::FULL);
      settle(context, next);
      if (next.score < best.score)
        best = std::move(next);
    }
  if (!(best.score < parts.score + min_gain))
    return false;
  parts = std::move(best);
  return true;
}

} // namespace

std::vector<Piece> splitWholeCloud(const PieceContext& context,
                                   Piece whole,
                                   int wanted,
                                   bool exactly,
                                   double min_gain) {
  Parts parts;
  parts.pieces.push_back(std::move(whole));
  parts.score = scoreOf(context, parts.pieces);
  while (
      int(parts.pieces.size()) < wanted &&
      splitOnce(context, parts, wanted - int(parts.pieces.size()), exactly, min_gain)) {
  }
  while (!exactly && parts.pieces.size() > 1 && mergeOnce(context, parts, min_gain)) {
  }
  return std::move(parts.pieces);
}

} // namespace pcl_sq::detail

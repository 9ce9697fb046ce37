// SPDX-License-Identifier: BSD-3-Clause
// M30: what sticks out of the outline of all parts is a rod.
#include "outlines/stalk.h"

#include "outlines/left_over.h"
#include "outlines/outline_cost.h"
#include "pieces/body_outline.h"
#include "pieces/free_space.h"
#include "sensor/local_quadric.h"
#include "tuning/parts_tuning.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::shared;
using namespace tuning::stalk;

using Pixels = std::vector<Eigen::Vector2d>;

/** \brief Pixels of an object, as a set. */
CellMask maskOf(const Pixels& pixels, int width, int height) {
  CellMask mask(width, height);
  for (const Eigen::Vector2d& p : pixels)
    mask.cells[mask.indexOf(int(p.x()), int(p.y()))] = 1;
  return mask;
}

/** \brief The piece whose body a place in the image is nearest to. */
std::size_t nearestPiece(const PieceContext& context,
                         const std::vector<Piece>& pieces,
                         const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d eye = context.observed.camera.center;
  const Eigen::Vector3d ray = context.observed.camera.ray(pixel);
  std::size_t nearest = 0;
  double least = 1e300;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const BodyOutline outline(
        pieces[k].fit.fit.model, eye, tuning::free_space::OUTLINE_PLANES);
    if (const double beyond = outline.sineBeyond(ray); beyond < least) {
      least = beyond;
      nearest = k;
    }
  }
  return nearest;
}

/** \brief Where a stalk is in the image: its middle, its direction away from the body,
 * its length and its mean width [px]. */
struct Strip {
  Eigen::Vector2d middle, along;
  double length, width;
};

Strip stripOf(const Pixels& pixels, const Eigen::Vector2d& body) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : pixels)
    mean += p / double(pixels.size());
  for (const Eigen::Vector2d& p : pixels)
    square += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(square);
  const Eigen::Vector2d away = (mean - body).normalized();
  Strip strip;
  strip.along = axes.eigenvectors().col(1);
  // a stump is as wide as long; it leaves the body
  const bool is_stump = axes.eigenvalues()[1] < STUMP * STUMP * axes.eigenvalues()[0];
  if (is_stump && std::abs(strip.along.dot(away)) < M_SQRT1_2)
    strip.along = axes.eigenvectors().col(0);
  if (strip.along.dot(away) < 0.0)
    strip.along *= -1.0;
  double low = 1e300, high = -1e300;
  for (const Eigen::Vector2d& p : pixels) {
    low = std::min(low, strip.along.dot(p - mean));
    high = std::max(high, strip.along.dot(p - mean));
  }
  strip.middle = mean + 0.5 * (low + high) * strip.along;
  strip.length = high - low + 1.0;
  strip.width = double(pixels.size()) / strip.length;
  return strip;
}

/** \brief How depth grows along a strip, and the inverse variance of that. */
struct Slope {
  double slope = 0.0, weight = 0.0;
};

/** \brief From the medians of both thirds at the ends: mixed pixels are many there. */
Slope slopeOf(const PieceContext& context,
              const Eigen::Matrix3Xd& points,
              const Eigen::Vector3d& middle,
              const Eigen::Vector3d& across,
              const Eigen::Vector3d& view) {
  std::vector<std::pair<double, double>> places; // along the strip, and depth
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    places.emplace_back(across.dot(points.col(i) - middle),
                        view.dot(points.col(i) - middle));
  std::sort(places.begin(), places.end());
  const std::size_t third = places.size() / 3;
  const auto medianOf = [&](std::size_t from, bool depth) {
    std::vector<double> values;
    for (std::size_t i = from; i < from + third; ++i)
      values.push_back(depth ? places[i].second : places[i].first);
    return median(std::move(values));
  };
  const std::size_t last = places.size() - third;
  const double run = medianOf(last, false) - medianOf(0, false);
  if (!(run > 0.0))
    return {};
  const ObservedObject& o = context.observed;
  const double independent =
      std::max(1.0, o.effective_points * double(third) / double(o.points.cols()));
  return {(medianOf(last, true) - medianOf(0, true)) / run,
          run * run * independent / (2.0 * context.noise * context.noise)};
}

/** \brief The rod that a strip of the image shows.
 * \param[in] points of the strip */
Superquadric rodOf(const PieceContext& context,
                   const Strip& strip,
                   const Eigen::Matrix3Xd& points,
                   const Superquadric& body) {
  const ObservedObject& o = context.observed;
  const double focal = std::sqrt(o.camera.fx * o.camera.fy);
  const Eigen::Vector3d view = o.camera.ray(strip.middle);
  Eigen::Vector3d across = o.camera.ray(strip.middle + strip.along) - view;
  across = (across - view * view.dot(across)).normalized();
  std::vector<double> depths;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    depths.push_back(view.dot(points.col(i) - o.camera.center));
  const double depth = median(std::move(depths));
  const double scale = depth / focal;
  const Eigen::Vector3d middle = o.camera.center + depth * view;
  // it leaves the body about as the body's surface does, unless its points say more
  const Eigen::Vector3d away = middle - body.center;
  const double guess = view.dot(away) / std::max(across.dot(away), 1e-9);
  const Slope seen = slopeOf(context, points, middle, across, view);
  const double prior = 1.0 / (ASKEW * ASKEW);
  const double slope = std::clamp(
      (prior * std::clamp(guess, -STEEPEST, STEEPEST) + seen.weight * seen.slope) /
          (prior + seen.weight),
      -STEEPEST,
      STEEPEST);
  const Eigen::Vector3d axis = (across + slope * view).normalized();
  Superquadric rod;
  const double radius = 0.5 * scale * strip.width;
  const double half = 0.5 * scale * strip.length * std::sqrt(1.0 + slope * slope);
  // its root is in the body
  rod.semi_axes = {radius, radius, half + 0.5 * radius};
  rod.center = middle - 0.5 * radius * axis + radius * view;
  const Eigen::Vector3d side = axis.unitOrthogonal();
  rod.rotation << side, axis.cross(side), axis;
  rod.epsilon1 = ROUNDED;
  rod.epsilon2 = 1.0;
  return rod;
}

/** \brief Mean cost of points, none more than an outlier's, as observations. */
double costOf(const PieceContext& context,
              const Superquadric& rod,
              const Eigen::Matrix3Xd& points) {
  double cost = 0.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    cost += std::min(std::pow(rod.footPointDistance(points.col(i)) / context.noise, 2),
                     MAX_COST);
  return cost * context.observed.effective_points /
         double(context.observed.points.cols());
}

/** \brief Leaves a piece what is not under a mask. */
Piece without(const PieceContext& context, const Piece& piece, const CellMask& mask) {
  const auto isUnder = [&](const Eigen::Vector2d& p) {
    return mask(int(std::lround(p.x())), int(std::lround(p.y())));
  };
  Piece rest = piece;
  rest.points.clear();
  for (const int i : piece.points)
    if (!isUnder(context.observed.camera.project(context.observed.points.col(i))))
      rest.points.push_back(i);
  const auto drop = [&](auto& list, const auto& pixelOf) {
    list.erase(std::remove_if(list.begin(),
                              list.end(),
                              [&](const auto& p) { return isUnder(pixelOf(p)); }),
               list.end());
  };
  drop(rest.pixels, [](const Eigen::Vector2d& p) { return p; });
  drop(rest.contour, [](const ContourPoint& p) { return p.pixel; });
  return rest;
}

/** \brief One stalk. \return whether there is one that pays */
bool addStalk(const PieceContext& context, std::vector<Piece>& pieces) {
  const ObservedObject& o = context.observed;
  const LeftOver left = leftOver(context, pieces);
  // a parameter costs what the observations weigh that bear on it (Berger, Bayarri and
  // Pericchi 2014), which are few
  const double price = PARAMETERS * std::log(1.0 + left.worth / MAX_COST);
  if (!(left.worth > price + ODDS))
    return false;
  const std::size_t k = nearestPiece(context, pieces, left.cells.front());
  const Superquadric body = pieces[k].fit.fit.model;
  const Pixels pixels = pixelsOf(context, left, body);
  if (pixels.empty())
    return false;
  const CellMask mask = maskOf(pixels, o.pixels.width, o.pixels.height);
  std::vector<Piece> next = pieces;
  Piece stalk;
  for (Piece& piece : next) {
    Piece rest = without(context, piece, mask);
    std::set_difference(piece.points.begin(),
                        piece.points.end(),
                        rest.points.begin(),
                        rest.points.end(),
                        std::back_inserter(stalk.points));
    if (rest.points.size() < tuning::part::MIN_POINTS)
      return false;
    piece = std::move(rest);
  }
  if (stalk.points.size() < FEWEST)
    return false;
  std::sort(stalk.points.begin(), stalk.points.end());
  const Eigen::Matrix3Xd points = gather(context, stalk.points);
  const Strip strip = stripOf(pixels, o.camera.project(body.center));
  ShapeCandidate rod;
  rod.model = rodOf(context, strip, points, body);
  if (!rod.model.isValid() ||
      (o.table && o.table->height(rod.model.center) < rod.model.semi_axes.x()))
    return false;
  rod.parameters = PARAMETERS;
  rod.cost =
      costOf(context, rod.model, points) + coveredFreeSpace(context, rod.model).cost;
  stalk.pixels = pixels;
  stalk.stands = false;
  stalk.fit.candidates = {rod};
  stalk.fit.chosen = rod;
  stalk.fit.fit.model = rod.model;
  stalk.fit.fit.points = stalk.points.size();
  stalk.fit.fit.termination = Termination::COST_CHANGE_TOO_SMALL;
  stalk.misfit = rod.cost;
  stalk.score = rod.cost + price;
  if (next[k].stands) // of a handle fitHandle() knows more than its points tell
    fitPiece(context, next[k], Effort::FINAL);
  next.push_back(std::move(stalk));
  if (!(scoreOf(context, next) < scoreOf(context, pieces) - ODDS))
    return false;
  pieces = std::move(next);
  return true;
}

} // namespace

void addStalks(const PieceContext& context, std::vector<Piece>& pieces, int wanted) {
  if (context.observed.outline != OutlineSource::MASK)
    return;
  while (int(pieces.size()) < wanted && addStalk(context, pieces))
    ;
}

} // namespace pcl_sq::detail

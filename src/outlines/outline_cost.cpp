// SPDX-License-Identifier: BSD-3-Clause
#include "outlines/outline_cost.h"

#include "pieces/body_outline.h"
#include "tuning/parts_tuning.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::shared;
using namespace tuning::outline_gaps;

/** \brief The parts, larger or smaller by a margin on all sides. */
std::vector<Superquadric> grown(const std::vector<Piece>& pieces, double margin) {
  std::vector<Superquadric> parts;
  for (const Piece& piece : pieces) {
    Superquadric s = piece.fit.fit.model;
    s.semi_axes = (s.semi_axes.array() + margin).max(0.2 * s.semi_axes.array());
    parts.push_back(s);
  }
  return parts;
}

/** \brief Which pixels see one of several bodies. */
class Sight {
public:
  Sight(std::vector<Superquadric> bodies, const PinholeCamera& camera)
      : bodies_(std::move(bodies)), camera_(camera) {
    for (const Superquadric& body : bodies_)
      tests_.emplace_back(body, camera.center);
  }
  bool meets(const Eigen::Vector2d& pixel) const {
    const Eigen::Vector3d ray = camera_.ray(pixel);
    return std::any_of(
        tests_.begin(), tests_.end(), [&](const RayTest& t) { return t.hits(ray); });
  }

private:
  std::vector<Superquadric> bodies_;
  std::vector<RayTest> tests_;
  const PinholeCamera& camera_;
};

/** \brief How far parts may miss the outline [m]. */
double marginOf(const ObservedObject& o) {
  const double pixel = o.depth / std::sqrt(o.camera.fx * o.camera.fy); // [m]
  return std::max(o.outline_sigma * pixel, TOLERANCE * o.extent);
}

} // namespace

std::vector<Eigen::Vector2d> pixelsLeft(const PieceContext& context,
                                        const std::vector<Piece>& pieces) {
  const ObservedObject& o = context.observed;
  const Sight larger(grown(pieces, marginOf(o)), o.camera);
  std::vector<Eigen::Vector2d> left;
  const CellRect box = boundingRect(o.pixels);
  for (int y = box.y; y < box.y + box.height; y += STEP)
    for (int x = box.x; x < box.x + box.width; x += STEP)
      if (o.pixels(x, y) && o.pixels(x - MARGIN, y) && o.pixels(x + MARGIN, y) &&
          o.pixels(x, y - MARGIN) && o.pixels(x, y + MARGIN) &&
          !larger.meets({double(x), double(y)}))
        left.emplace_back(x, y);
  return left;
}

double contradictionCost(const ObservedObject& observed) {
  return MAX_COST * std::min(1.0, std::pow(STEP / observed.outline_correlation, 2));
}

double outlineCost(const PieceContext& context, const std::vector<Piece>& pieces) {
  const ObservedObject& o = context.observed;
  const Sight smaller(grown(pieces, -marginOf(o)), o.camera);
  const auto covered =
      std::count_if(o.gap.begin(), o.gap.end(), [&](const Eigen::Vector2d& p) {
        return int(p.x()) % STEP == 0 && int(p.y()) % STEP == 0 && smaller.meets(p);
      });
  return contradictionCost(o) *
         (double(pixelsLeft(context, pieces).size()) + double(covered));
}

double scoreOf(const PieceContext& context, const std::vector<Piece>& pieces) {
  double score = outlineCost(context, pieces);
  for (const Piece& piece : pieces)
    score += piece.score;
  return score;
}

} // namespace pcl_sq::detail

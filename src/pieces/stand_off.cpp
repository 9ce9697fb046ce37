// SPDX-License-Identifier: BSD-3-Clause
// M22: a handle is what stands off a vessel.
#include "pcl_sq/fit_superquadric.h"
#include "pieces/body_outline.h"
#include "pieces/handle.h"
#include "pieces/piece.h"
#include "sensor/local_quadric.h"
#include "tuning/parts_tuning.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::part;
using namespace tuning::stand_off;
using namespace tuning::shared;

/** \brief The body, larger by a margin on all sides. */
Superquadric grown(Superquadric body, double margin) {
  body.semi_axes.array() += margin;
  return body;
}

/** \brief Sets of columns that hang together, the largest first. */
std::vector<std::vector<int>> clustersOf(const Eigen::Matrix3Xd& points,
                                         const std::vector<int>& columns,
                                         double radius) {
  std::vector<std::vector<int>> clusters;
  std::vector<bool> taken(columns.size(), false);
  for (std::size_t first = 0; first < columns.size(); ++first) {
    if (taken[first])
      continue;
    taken[first] = true;
    std::vector<int> cluster = {columns[first]};
    for (std::size_t k = 0; k < cluster.size(); ++k)
      for (std::size_t j = 0; j < columns.size(); ++j)
        if (!taken[j] &&
            (points.col(columns[j]) - points.col(cluster[k])).squaredNorm() <
                radius * radius) {
          taken[j] = true;
          cluster.push_back(columns[j]);
        }
    clusters.push_back(std::move(cluster));
  }
  std::sort(clusters.begin(), clusters.end(), [](const auto& a, const auto& b) {
    return a.size() > b.size();
  });
  return clusters;
}

/** \brief The points that stand off a body on one side: the largest cluster, and those
 * on the same side of the axis, the other arm of a handle. */
std::vector<int> oneSide(const Eigen::Matrix3Xd& points,
                         const Superquadric& body,
                         const std::vector<std::vector<int>>& clusters) {
  std::vector<int> side;
  // what is nearer to the axis stands on the body: a bottle's neck
  const double beside = body.semi_axes.head<2>().minCoeff() *
                        (1.0 - std::max(std::abs(body.kx), std::abs(body.ky)));
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  for (const std::vector<int>& cluster : clusters) {
    Eigen::Vector3d away = body.toLocal(meanOf(points, cluster));
    away.z() = 0.0;
    away.normalize();
    if (side.empty())
      direction = away;
    else if (cluster.size() < MIN_CLUSTER || away.dot(direction) < SAME_SIDE)
      continue;
    for (const int i : cluster) {
      const Eigen::Vector2d at = body.toLocal(points.col(i)).head<2>();
      if (at.norm() > beside && at.dot(direction.head<2>()) > SAME_SIDE * at.norm())
        side.push_back(i);
    }
  }
  std::sort(side.begin(), side.end());
  return side;
}

/** \brief Columns of a piece's points that lie off its body, outside. */
std::vector<int> outside(const PieceContext& context,
                         const Piece& piece,
                         const Eigen::VectorXd& distances) {
  std::vector<int> off;
  for (std::size_t k = 0; k < piece.points.size(); ++k)
    if (distances[Eigen::Index(k)] > STANDS_OFF * context.noise &&
        !piece.fit.fit.model.contains(context.observed.points.col(piece.points[k])))
      off.push_back(piece.points[k]);
  return off;
}

/** \brief Points in the image, some of them where they are many. */
class Projections {
public:
  Projections(const ObservedObject& o, const std::vector<int>& columns) {
    constexpr std::size_t LOOKED_AT = 300;
    const std::size_t step = 1 + columns.size() / LOOKED_AT;
    for (std::size_t i = 0; i < columns.size(); i += step)
      pixels_.push_back(o.camera.project(o.points.col(columns[i])));
  }
  double squareTo(const Eigen::Vector2d& pixel) const {
    double least = 1e300;
    for (const Eigen::Vector2d& p : pixels_)
      least = std::min(least, (p - pixel).squaredNorm());
    return least;
  }

private:
  std::vector<Eigen::Vector2d> pixels_;
};

} // namespace

std::size_t pointsOff(const PieceContext& context, const Piece& piece) {
  return outside(context,
                 piece,
                 surfaceDistances(piece.fit.fit.model, gather(context, piece.points)))
      .size();
}

bool standsOff(const PieceContext& context,
               const Piece& piece,
               Piece& body_piece,
               Piece& handle) {
  const ObservedObject& o = context.observed;
  if (piece.fit.chosen.shape != ShapeClass::VESSEL)
    return false;
  const Superquadric& body = piece.fit.fit.model;
  const Eigen::VectorXd distances =
      surfaceDistances(body, gather(context, piece.points));
  std::vector<int> off = outside(context, piece, distances);
  double farthest = 0.0;
  off = oneSide(o.points, body, clustersOf(o.points, off, LINKED * o.extent));
  for (std::size_t k = 0, j = 0; k < piece.points.size() && j < off.size(); ++k)
    if (piece.points[k] == off[j]) {
      farthest = std::max(farthest, distances[Eigen::Index(k)]);
      ++j;
    }
  if (off.size() < MIN_POINTS || 2 * off.size() > piece.points.size() ||
      farthest < STICKS_OUT * body.semi_axes.x() ||
      2.0 * aroundPoints(o.points, off, body).semi_axes.y() >
          NARROW * body.semi_axes.x())
    return false;
  body_piece = handle = {};
  handle.points = off;
  handle.stands = false;
  std::set_difference(piece.points.begin(),
                      piece.points.end(),
                      off.begin(),
                      off.end(),
                      std::back_inserter(body_piece.points));
  body_piece.ends = piece.ends;
  if (!o.hasCamera())
    return true;
  // an outline beside the body is the handle's; where they meet it is nobody's
  const double pixel = o.depth / std::sqrt(o.camera.fx * o.camera.fy);
  const BodyOutline near(grown(body, EDGE * pixel), o.camera.center, PLANES),
      far(grown(body, tuning::stand_off::JOINT * pixel), o.camera.center, PLANES);
  const auto meets = [&o](const BodyOutline& outline, const Eigen::Vector2d& p) {
    return !outline.misses(o.camera.ray(p));
  };
  // what sticks out elsewhere is an error of the outline, and nobody's
  const Projections of_handle(o, handle.points), of_body(o, body_piece.points);
  const auto isBeside = [&](const Eigen::Vector2d& p) {
    return of_handle.squareTo(p) < of_body.squareTo(p);
  };
  std::vector<Eigen::Vector2d> strays;
  for (const Eigen::Vector2d& p : piece.pixels)
    (meets(near, p) ? body_piece.pixels
     : isBeside(p)  ? handle.pixels
                    : strays)
        .push_back(p);
  const auto addForeign = [](Piece& to, const Eigen::Vector2d& pixel_of_other) {
    ContourPoint foreign;
    foreign.pixel = pixel_of_other;
    foreign.own = false;
    to.contour.push_back(foreign);
  };
  for (const ContourPoint& p : piece.contour)
    if (meets(near, p.pixel))
      body_piece.contour.push_back(p);
    else if (isBeside(p.pixel))
      handle.contour.push_back(p);
  for (const Eigen::Vector2d& p : strays)
    if (meets(far, p))
      addForeign(body_piece, p);
  for (const Eigen::Vector2d& p : handle.pixels)
    if (meets(far, p)) {
      addForeign(handle, p);
      addForeign(body_piece, p);
    }
  return true;
}

double scatter(const PieceContext& context, const Piece& piece) {
  constexpr double MEDIAN_OF_NORMAL = 0.6745;
  const std::size_t step =
      std::max<std::size_t>(1, piece.points.size() / tuning::stand_off::MOST);
  std::vector<int> some;
  for (std::size_t i = 0; i < piece.points.size(); i += step)
    some.push_back(piece.points[i]);
  const Eigen::VectorXd all =
      surfaceDistances(piece.fit.fit.model, gather(context, some)).cwiseAbs();
  std::vector<double> distances(all.data(), all.data() + all.size());
  return median(std::move(distances)) / MEDIAN_OF_NORMAL;
}

} // namespace pcl_sq::detail

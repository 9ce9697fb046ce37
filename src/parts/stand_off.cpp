// SPDX-License-Identifier: BSD-3-Clause
// M22: a handle is what stands off a vessel.
#include "parts/object_piece.h"
#include "pcl_sq/line_intersection.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t MIN_POINTS = 24;
constexpr double STANDS_OFF = 4.0;        ///< sigmas from the body
constexpr double LINKED = 0.12;           ///< of neighbours, over the object's size
constexpr double EDGE = 2.0, JOINT = 6.0; ///< pixels beside the body's outline

/** \brief The body, larger by a margin on all sides. */
Superquadric grown(Superquadric body, double margin) {
  body.semi_axes.array() += margin;
  return body;
}

bool meets(const Superquadric& body,
           const PinholeCamera& camera,
           const Eigen::Vector2d& p) {
  LineInterval chord;
  const Eigen::Vector3d ray = camera.ray(p);
  return intersectLineBox(body, camera.center, ray, chord) &&
         intersectLine(body, camera.center, ray, chord);
}

/** \brief The largest set of columns that hang together. */
std::vector<int> largestCluster(const Eigen::Matrix3Xd& points,
                                const std::vector<int>& columns,
                                double radius) {
  std::vector<int> best;
  std::vector<bool> taken(columns.size(), false);
  for (std::size_t first = 0; first < columns.size(); ++first) {
    if (taken[first])
      continue;
    taken[first] = true;
    std::vector<std::size_t> cluster = {first};
    for (std::size_t k = 0; k < cluster.size(); ++k)
      for (std::size_t j = 0; j < columns.size(); ++j)
        if (!taken[j] &&
            (points.col(columns[j]) - points.col(columns[cluster[k]])).squaredNorm() <
                radius * radius) {
          taken[j] = true;
          cluster.push_back(j);
        }
    if (cluster.size() <= best.size())
      continue;
    best.clear();
    for (const std::size_t k : cluster)
      best.push_back(columns[k]);
  }
  std::sort(best.begin(), best.end());
  return best;
}

} // namespace

bool standsOff(const PieceContext& context,
               const Piece& piece,
               Piece& body_piece,
               Piece& handle) {
  const ObservedObject& o = context.observed;
  if (!o.hasCamera() || piece.fit.chosen.shape != ShapeClass::VESSEL)
    return false;
  const Superquadric& body = piece.fit.fit.model;
  std::vector<int> off;
  for (const int i : piece.points) {
    const Eigen::Vector3d p = o.points.col(i);
    if (!body.contains(p) && body.footPointDistance(p) > STANDS_OFF * context.noise)
      off.push_back(i);
  }
  off = largestCluster(o.points, off, LINKED * o.extent);
  if (off.size() < MIN_POINTS || 2 * off.size() > piece.points.size())
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
  // an outline beside the body is the handle's; where they meet it is nobody's
  const double pixel = o.depth / std::sqrt(o.camera.fx * o.camera.fy);
  const Superquadric near = grown(body, EDGE * pixel), far = grown(body, JOINT * pixel);
  for (const Eigen::Vector2d& p : piece.pixels)
    (meets(near, o.camera, p) ? body_piece : handle).pixels.push_back(p);
  const auto addForeign = [](Piece& to, const Eigen::Vector2d& pixel_of_other) {
    ContourPoint foreign;
    foreign.pixel = pixel_of_other;
    foreign.own = false;
    to.contour.push_back(foreign);
  };
  for (const ContourPoint& p : piece.contour) {
    if (!meets(near, o.camera, p.pixel))
      handle.contour.push_back(p);
    else
      body_piece.contour.push_back(p);
  }
  for (const Eigen::Vector2d& p : handle.pixels)
    if (meets(far, o.camera, p)) {
      addForeign(handle, p);
      addForeign(body_piece, p);
    }
  return true;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// Where a handle stands off a vessel.
#include "parts/object_piece.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t MIN_POINTS = 24;
constexpr double STANDS_OFF = 4.0; ///< sigmas from the body

} // namespace

std::optional<Cut> handleCut(const PieceContext& context, const Piece& piece) {
  const ObservedObject& o = context.observed;
  if (!o.hasCamera() || piece.fit.chosen.shape != ShapeClass::VESSEL)
    return std::nullopt;
  const Superquadric& body = piece.fit.fit.model;
  const Eigen::Vector3d towards = body.center - o.camera.center;
  const Eigen::Vector3d side = body.rotation.col(2).cross(towards).normalized();
  std::array<std::size_t, 2> off{}; // on either side
  for (const int i : piece.points) {
    const Eigen::Vector3d p = o.points.col(i);
    if (!body.contains(p) && body.footPointDistance(p) > STANDS_OFF * context.noise)
      ++off[side.dot(p - body.center) > 0.0 ? 0 : 1];
  }
  if (std::max(off[0], off[1]) < MIN_POINTS)
    return std::nullopt;
  const Eigen::Vector3d outwards = off[0] >= off[1] ? side : Eigen::Vector3d(-side);
  const double distance = towards.norm();
  Cut cut{outwards, 0.0};
  for (int round = 0; round < 5; ++round) { // touches the body, through the camera
    const double sine = std::min(body.support(cut.normal) / distance, 0.9);
    cut.normal =
        std::sqrt(1.0 - sine * sine) * outwards - sine / distance * towards;
  }
  cut.offset = cut.normal.dot(o.camera.center);
  return cut;
}

} // namespace pcl_sq::detail

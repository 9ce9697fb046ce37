// SPDX-License-Identifier: BSD-3-Clause
#include "pieces/piece_outline.h"
#include "tuning/parts_tuning.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

using namespace tuning::piece_outline;

} // namespace

double stripWidth(const ObservedObject& o) {
  return (o.outline == OutlineSource::POINTS ? 0.8 * o.outline_sigma : 2.0) /
         std::sqrt(o.camera.fx * o.camera.fy);
}

BesideJoints::BesideJoints(const ObservedObject& o, const Piece& piece, double size)
    : joint_(tuning::piece_outline::JOINT * size / o.depth) {
  for (const TangentPlane& end : piece.ends)
    angles_.emplace_back(o.camera, -end.normal);
}

double BesideJoints::operator()(const Eigen::Vector2d& pixel) const {
  double nearest = 1e300;
  for (const AngleAbove& angle : angles_)
    nearest = std::min(nearest, angle(pixel) - joint_);
  return nearest;
}

std::vector<ContourPoint>
outlineBesideJoints(const ObservedObject& o, const Piece& piece, double size) {
  if (!o.hasCamera() || piece.ends.empty())
    return piece.contour;
  const BesideJoints beyondJoints(o, piece, size);
  std::vector<ContourPoint> contour;
  for (const ContourPoint& p : piece.contour)
    if (beyondJoints(p.pixel) > 0.0)
      contour.push_back(p);
  const double strip = stripWidth(o);
  for (const Eigen::Vector2d& p : piece.pixels) {
    const double side = beyondJoints(p);
    if (side > 0.0 && side < strip) {
      ContourPoint foreign;
      foreign.pixel = p;
      foreign.own = false;
      contour.push_back(foreign);
    }
  }
  return contour;
}

} // namespace pcl_sq::detail

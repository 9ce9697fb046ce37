// SPDX-License-Identifier: BSD-3-Clause
#include "pieces/free_space.h"

#include "pcl_sq/line_intersection.h"
#include "pieces/piece_outline.h"
#include "sensor/depth_patch.h"
#include "tuning/parts_tuning.h"
#include "view_problem/plane_cost.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

using namespace tuning::shared;
using namespace tuning::free_space;

bool isWellInside(const CellMask& mask, const Eigen::Vector2d& pixel) {
  const int x = int(pixel.x()), y = int(pixel.y());
  return mask(x - tuning::free_space::MARGIN, y) &&
         mask(x + tuning::free_space::MARGIN, y) &&
         mask(x, y - tuning::free_space::MARGIN) &&
         mask(x, y + tuning::free_space::MARGIN);
}

/** \brief A point of a ray well inside a body. \return false if the ray misses it */
bool insideOnRay(const Superquadric& body,
                 const Eigen::Vector3d& from,
                 const Eigen::Vector3d& ray,
                 Eigen::Vector3d& inside) {
  LineInterval chord;
  if (!intersectLineBox(body, from, ray, chord) ||
      !intersectLine(body, from, ray, chord))
    return false;
  // the middle of the chord lies about where the ray comes nearest to the centre
  inside = from + 0.5 * (chord.enter + chord.leave) * ray;
  return true;
}

double sigmaOf(const ObservedObject& o) {
  const double pixel = o.depth / std::sqrt(o.camera.fx * o.camera.fy); // [m]
  return std::max(o.outline_sigma * pixel, FREE_SIGMA * o.extent);
}

} // namespace

/** \brief M11. */
Covered coveredFreeSpace(const PieceContext& context,
                         const Superquadric& body,
                         const BodyOutline& outline) {
  const ObservedObject& o = context.observed;
  const double sigma = sigmaOf(o);
  Covered covered;
  for (const Eigen::Vector2d& p : o.free_space) {
    const Eigen::Vector3d ray = o.camera.ray(p);
    if (outline.misses(ray))
      continue;
    Eigen::Vector3d inside;
    if (!insideOnRay(body, o.camera.center, ray, inside))
      continue;
    TangentPlane limit;
    limit.normal = body.isCut()
                       ? body.gaugeGradient(inside)
                       : body.rotation * -body.logGaugeJacobian(inside).head<3>();
    limit.normal -= limit.normal.dot(ray) * ray;
    if (!(limit.normal.norm() > 1e-9))
      continue;
    limit.normal.normalize();
    limit.offset = limit.normal.dot(inside);
    limit.sigma = sigma / std::sqrt(o.free_weight);
    // the hull of a bent body reaches on where the body does not
    const double depth = body.isBent() ? std::max(-body.footPointDistance(inside), 0.0)
                                       : limit.residual(body);
    const double z = depth / sigma;
    covered.cost += o.free_weight * std::min(z * z, MAX_COST);
    covered.limits.push_back(limit);
  }
  return covered;
}

Covered coveredFreeSpace(const PieceContext& context, const Superquadric& body) {
  // beyond the outline no costly search along the ray
  return coveredFreeSpace(
      context, body, BodyOutline(body, context.observed.camera.center, OUTLINE_PLANES));
}

FreeSpaceCost::FreeSpaceCost(const PieceContext& context, const Piece& piece)
    : context_(context) {
  const ObservedObject& o = context.observed;
  // an outline that depth alone told errs by more than its pixels
  if (o.outline != OutlineSource::MASK)
    return;
  const std::size_t stride = std::max<std::size_t>(1, piece.pixels.size() / INSIDE);
  weight_ = std::min(
      1.0, double(stride) * std::pow(context.pixel_step / OUTLINE_CORRELATION, 2));
  const BesideJoints beside(o, piece, halfSize(context, piece));
  for (std::size_t i = 0; i < piece.pixels.size(); i += stride) {
    const Eigen::Vector2d& p = piece.pixels[i];
    if (isWellInside(o.pixels, p) && beside(p) > 0.0)
      rays_.push_back(o.camera.ray(p));
  }
}

double FreeSpaceCost::missed(const BodyOutline& outline) const {
  const ObservedObject& o = context_.observed;
  const double sigma = sigmaOf(o);
  double cost = 0.0;
  for (const Eigen::Vector3d& ray : rays_) {
    const double z = outline.sineBeyond(ray) * o.depth / sigma;
    if (z > 0.0)
      cost += weight_ * std::min(z * z, MAX_COST);
  }
  return cost;
}

double FreeSpaceCost::operator()(const Superquadric& body) const {
  if (rays_.empty())
    return coveredFreeSpace(context_, body).cost;
  const BodyOutline outline(body, context_.observed.camera.center, OUTLINE_PLANES);
  return coveredFreeSpace(context_, body, outline).cost + missed(outline);
}

double hingeCost(const std::vector<TangentPlane>& limits, const Superquadric& body) {
  double cost = 0.0;
  for (const TangentPlane& limit : limits)
    cost += std::pow(std::max(0.0, limit.residual(body)) / limit.sigma, 2);
  return cost;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "pieces/piece.h"

#include "pieces/piece_outline.h"
#include "tuning/parts_tuning.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

using namespace tuning::part;
using namespace tuning::piece;
} // namespace

Eigen::Matrix3Xd gather(const PieceContext& context, const std::vector<int>& columns) {
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) = context.observed.points.col(columns[i]);
  return points;
}

double halfDiagonal(const Eigen::Matrix3Xd& points) {
  return 0.5 * (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

int pixelStep(const ObservedObject& observed) {
  return std::max(1,
                  static_cast<int>(std::sqrt(double(observed.pixels.count()) /
                                             double(PIXEL_SAMPLE))));
}

Piece wholePiece(const PieceContext& context) {
  Piece piece;
  for (Eigen::Index i = 0; i < context.observed.points.cols(); ++i)
    piece.points.push_back(static_cast<int>(i));
  piece.contour = context.observed.contour;
  const CellMask& mask = context.observed.pixels;
  const CellRect box = boundingRect(mask);
  const int step = context.pixel_step;
  const auto onGrid = [step](int from) { return (from + step - 1) / step * step; };
  for (int y = onGrid(box.y); y < box.y + box.height; y += step)
    for (int x = onGrid(box.x); x < box.x + box.width; x += step)
      if (mask.cells[mask.indexOf(x, y)])
        piece.pixels.emplace_back(x, y);
  if (context.observed.hasCamera() && piece.pixels.empty())
    for (const ContourPoint& p : context.observed.contour)
      piece.pixels.push_back(p.pixel);
  return piece;
}

double halfSize(const PieceContext& context, const Piece& piece) {
  return halfDiagonal(gather(context, piece.points));
}

Cut shiftedCut(const PieceContext& context, const Cut& cut, double distance) {
  const ObservedObject& o = context.observed;
  if (!o.hasCamera())
    return {cut.normal, cut.offset + distance};
  const Eigen::Vector3d towards = o.points.rowwise().mean() - o.camera.center;
  const Eigen::Vector3d normal =
      (cut.normal - distance / towards.squaredNorm() * towards).normalized();
  return {normal, normal.dot(o.camera.center)};
}

Piece cutPiece(const PieceContext& context, const Piece& piece, const Cut& cut) {
  Piece part;
  const ObservedObject& o = context.observed;
  for (const int i : piece.points)
    if (cut.side(o.points.col(i)) > 0.0)
      part.points.push_back(i);
  if (part.points.size() < MIN_POINTS)
    return {};
  if (o.hasCamera()) {
    const AngleAbove angle(o.camera, cut.normal);
    for (const ContourPoint& p : piece.contour)
      if (angle(p.pixel) > 0.0)
        part.contour.push_back(p);
    const double near = stripWidth(o);
    for (const Eigen::Vector2d& p : piece.pixels) {
      const double side = angle(p);
      if (side <= 0.0)
        continue;
      part.pixels.push_back(p);
      // where the object goes on beyond the cut, the piece has no outline
      if (side < near) {
        ContourPoint foreign;
        foreign.pixel = p;
        foreign.own = false;
        part.contour.push_back(foreign);
      }
    }
  }
  part.ends = piece.ends;
  part.stands = piece.stands;
  TangentPlane end;
  end.normal = -cut.normal;
  end.offset = -cut.offset;
  end.sigma = END_SIGMA * halfDiagonal(gather(context, part.points));
  part.ends.push_back(end);
  return part;
}

Piece mergePieces(const Piece& a, const Piece& b) {
  Piece merged;
  merged.stands = a.stands || b.stands;
  merged.points = a.points;
  merged.points.insert(merged.points.end(), b.points.begin(), b.points.end());
  merged.pixels = a.pixels;
  merged.pixels.insert(merged.pixels.end(), b.pixels.begin(), b.pixels.end());
  const auto add = [&merged](const Piece& from, const Piece& other) {
    for (const ContourPoint& p : from.contour) {
      const bool inner =
          !p.own && std::any_of(other.pixels.begin(),
                                other.pixels.end(),
                                [&](const Eigen::Vector2d& q) {
                                  return (q - p.pixel).squaredNorm() < 10.0;
                                });
      if (!inner)
        merged.contour.push_back(p);
    }
  };
  add(a, b);
  add(b, a);
  // an end that one of the two goes beyond is none
  for (const Piece* from : {&a, &b})
    for (const TangentPlane& end : from->ends) {
      const Piece& other = from == &a ? b : a;
      if (end.residual(other.fit.fit.model) < 0.5 * end.sigma)
        merged.ends.push_back(end);
    }
  return merged;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "outlines/outline_gaps.h"

#include "outlines/outline_cost.h"
#include "tuning/parts_tuning.h"
#include "util/parallel_for.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>

namespace pcl_sq::detail {

namespace {

using namespace tuning::outline_gaps;

/** \brief The gap's box along its principal axes. */
struct GapBox {
  Eigen::Matrix2d axes;
  Eigen::Vector2d low, high;
};

GapBox boxOf(const std::vector<Eigen::Vector2d>& gap) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : gap)
    mean += p / double(gap.size());
  for (const Eigen::Vector2d& p : gap)
    square += (p - mean) * (p - mean).transpose();
  GapBox box;
  box.axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(square).eigenvectors();
  box.low.setConstant(1e300);
  box.high.setConstant(-1e300);
  for (const Eigen::Vector2d& p : gap) {
    const Eigen::Vector2d q = box.axes.transpose() * p;
    box.low = box.low.cwiseMin(q);
    box.high = box.high.cwiseMax(q);
  }
  return box;
}

/** \brief Cut along a line of the image; positive where direction . pixel > offset. */
Cut lineCut(const PieceContext& context,
            const Eigen::Vector2d& direction,
            double offset) {
  SilhouetteLine line;
  line.direction = direction;
  line.offset = offset;
  const TangentPlane plane = tangentPlane(context.observed.camera, line, 1.0, 1.0);
  return {plane.normal, plane.offset};
}

/** \brief The object as the four pieces around its gap: a body, and three sides of a
 * ring that it closes; empty if there is no gap, or a side of it has too few points. */
std::vector<Piece> piecesAroundGap(const PieceContext& context, const Piece& whole) {
  const std::vector<Eigen::Vector2d>& gap = context.observed.gap;
  if (gap.empty())
    return {};
  const GapBox box = boxOf(gap);
  // the body is on the side of the gap on which most of the object is
  std::array<int, 4> beyond{};
  for (const Eigen::Vector2d& p : whole.pixels) {
    const Eigen::Vector2d q = box.axes.transpose() * p;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto axis = Eigen::Index(k);
      beyond[2 * k] += q[axis] < box.low[axis];
      beyond[2 * k + 1] += q[axis] > box.high[axis];
    }
  }
  const auto side =
      std::size_t(std::max_element(beyond.begin(), beyond.end()) - beyond.begin());
  const int across = int(side / 2), along = 1 - across;
  const Eigen::Vector2d outwards =
      side % 2 == 0 ? box.axes.col(across) : Eigen::Vector2d(-box.axes.col(across));
  const double inner = side % 2 == 0 ? box.low[across] : -box.high[across];
  const double width = box.high[across] - box.low[across];
  const Eigen::Vector2d axis = box.axes.col(along);
  const Cut handle = lineCut(context, outwards, inner + INSET * width);
  const Cut below = lineCut(context, axis, box.low[along]);
  const Cut above = lineCut(context, axis, box.high[along]);
  const Piece ring = cutPiece(context, whole, handle);
  const Piece upper = cutPiece(context, ring, below);
  std::vector<Piece> pieces = {cutPiece(context, whole, handle.flipped()),
                               cutPiece(context, ring, below.flipped()),
                               cutPiece(context, upper, above.flipped()),
                               cutPiece(context, upper, above)};
  for (const Piece& piece : pieces)
    if (piece.points.empty())
      return {};
  return pieces;
}

} // namespace

void openGap(const PieceContext& context, std::vector<Piece>& pieces, double min_gain) {
  std::vector<Piece> ring = piecesAroundGap(context, wholePiece(context));
  if (ring.empty())
    return;
  parallelFor(ring.size(), context.options.fit.threads, [&](std::size_t i) {
    fitPiece(context, ring[i], Effort::FULL);
  });
  if (scoreOf(context, ring) < scoreOf(context, pieces) - min_gain)
    pieces = std::move(ring);
}

} // namespace pcl_sq::detail

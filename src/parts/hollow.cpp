// SPDX-License-Identifier: BSD-3-Clause
// The outside of hollow things: what solids can be fitted to where both sides of their
// walls were measured.
#include "observe/sheets.h"
#include "parts/whole_cloud.h"
#include "pcl_sq/fit_superquadric.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t ABOUT = 24; ///< points in about the same direction that are asked
constexpr std::size_t FEWEST = 6; ///< of them beyond a point that is on an inside
constexpr double SIGMAS = 4.0;
/** \brief How far another point is beyond the tangent plane at least, over its distance
 * across: 0.1 for the sagitta of a hollow place as wide as it is deep. */
constexpr double SAGITTA = 0.1;

constexpr double OFF = 4.0;  ///< noise from which on a point is off a model
constexpr double POOR = 0.3; ///< share of such points of a model that is none
/** \brief Shares of the points on the outside of hollow things. */
constexpr double LEAST = 0.3, MOST = 0.8;
constexpr double BETTER = 0.5; ///< share of points off the outside, over that of all

/** \brief Points of a cloud without those that have others beyond them as seen from the
 * middle: the inner sides of walls. */
std::vector<int> outerPoints(const Eigen::Matrix3Xd& points, double noise) {
  const std::vector<Sheet> sheets = sheetsOf(points, 1);
  const auto n = std::size_t(points.cols());
  std::vector<int> outer;
  if (sheets.size() != n)
    return outer;
  const Eigen::Vector3d middle =
      0.5 * (points.rowwise().minCoeff() + points.rowwise().maxCoeff());
  Eigen::Matrix3Xd direction = points.colwise() - middle;
  direction.colwise().normalize();
  std::vector<int> order(n);
  std::vector<double> cosine(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto column = Eigen::Index(i);
    const Eigen::Vector3d out = points.col(column) - middle;
    Eigen::Vector3d normal = sheets[i].normal;
    if (normal.dot(out) < 0.0)
      normal = -normal;
    std::iota(order.begin(), order.end(), 0);
    Eigen::VectorXd::Map(cosine.data(), points.cols()) =
        direction.transpose() * direction.col(column);
    std::nth_element(order.begin(),
                     order.begin() + std::ptrdiff_t(std::min(ABOUT, n - 1)),
                     order.end(),
                     [&](int a, int b) {
                       const double ca = cosine[std::size_t(a)],
                                    cb = cosine[std::size_t(b)];
                       return ca != cb ? ca > cb : a < b;
                     });
    std::size_t beyond = 0;
    for (std::size_t k = 0; k < std::min(ABOUT, n); ++k) {
      const Eigen::Vector3d d = points.col(order[k]) - points.col(column);
      const double away = normal.dot(d);
      const double across = std::sqrt(std::max(0.0, d.squaredNorm() - away * away));
      beyond += away > SIGMAS * noise + SAGITTA * across;
    }
    if (beyond < FEWEST)
      outer.push_back(int(i));
  }
  return outer;
}

/** \brief Share of the points that lie off a union. */
double shareOff(const PieceContext& context, const std::vector<Piece>& pieces) {
  Eigen::ArrayXd distances =
      Eigen::ArrayXd::Constant(context.observed.points.cols(), 1e300);
  for (const Piece& piece : pieces)
    distances = distances.min(
        surfaceDistances(piece.fit.fit.model, context.observed.points).array());
  return double((distances.abs() > OFF * context.noise).count()) /
         double(distances.size());
}

} // namespace

std::vector<Piece> fitOutside(const PieceContext& context,
                              std::vector<Piece> pieces,
                              int wanted,
                              bool exactly,
                              double min_gain) {
  const double off = shareOff(context, pieces);
  if (off < POOR)
    return pieces;
  const ObservedObject& o = context.observed;
  const std::vector<int> outer = outerPoints(o.points, noiseOf(sheetsOf(o.points, 16)));
  const double share = double(outer.size()) / double(o.points.cols());
  if (share < LEAST || share > MOST)
    return pieces;
  ObservedObject shell = o;
  shell.points = gather(context, outer);
  shell.effective_points = share * o.effective_points;
  const PieceContext outside{shell, context.options, context.noise, {}, context.limits};
  Piece whole = wholePiece(outside);
  fitPiece(outside, whole, Effort::FULL);
  if (!whole.fit.fit.ok())
    return pieces;
  std::vector<Piece> found =
      splitWholeCloud(outside, std::move(whole), wanted, exactly, min_gain);
  if (shareOff(outside, found) > BETTER * off)
    return pieces;
  for (Piece& piece : found)
    for (int& i : piece.points)
      i = outer[std::size_t(i)];
  return found;
}

} // namespace pcl_sq::detail

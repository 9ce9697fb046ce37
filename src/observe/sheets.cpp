// SPDX-License-Identifier: BSD-3-Clause
#include "observe/sheets.h"

#include "sensor/local_quadric.h"
#include "tuning/observe_tuning.h"
#include "util/order_statistic.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_sq::detail {

namespace {

using namespace tuning::sheets;
/** \brief Standard deviation over the root mean square of the half of normal values
 * that is nearest to zero. */
constexpr double OF_HALF = 2.6477;

/** \brief Heights of points over a plane, and the half of them that is nearest to it.
 */
class Half {
public:
  explicit Half(std::size_t count) : height(count), order(count) {
    std::iota(order.begin(), order.end(), std::size_t(0));
  }
  std::size_t size() const { return height.size() / 2; }
  void choose(const Eigen::Matrix3Xd& points,
              const std::vector<Eigen::Index>& near,
              const Eigen::Vector3d& normal,
              const Eigen::Vector3d& on_plane) {
    for (std::size_t k = 0; k < near.size(); ++k)
      height[k] = normal.dot(points.col(near[k]) - on_plane);
    std::nth_element(order.begin(),
                     order.begin() + std::ptrdiff_t(size()),
                     order.end(),
                     [&](std::size_t a, std::size_t b) {
                       const double ha = std::abs(height[a]), hb = std::abs(height[b]);
                       return ha != hb ? ha < hb : a < b;
                     });
  }

  std::vector<double> height;
  std::vector<std::size_t> order;
};

/** \brief The plane through the first point and two near ones to which half of all are
 * nearest (least median of squares; Rousseeuw 1984): of two sheets closer together than
 * their points, a plane through all near ones lies across. */
Eigen::Vector3d ownPlane(const Eigen::Matrix3Xd& points,
                         const std::vector<Eigen::Index>& near) {
  const std::size_t n = near.size(), half = n / 2;
  Eigen::Matrix3Xd local(3, Eigen::Index(n));
  for (std::size_t k = 0; k < n; ++k)
    local.col(Eigen::Index(k)) = points.col(near[k]) - points.col(near[0]);
  std::vector<double> height(n), spare(n);
  Eigen::Vector3d best = Eigen::Vector3d::UnitZ();
  double least = 1e300;
  for (std::size_t a = 1; a < NEAREST; ++a)
    for (std::size_t b = a + 1; b <= NEAREST; ++b) {
      const Eigen::Vector3d u = local.col(Eigen::Index(a)),
                            v = local.col(Eigen::Index(b));
      const Eigen::Vector3d across = u.cross(v);
      if (!(across.norm() > SLIVER * u.norm() * v.norm()))
        continue;
      const Eigen::Vector3d normal = across.normalized();
      std::size_t nearer = 0;
      for (std::size_t k = 0; k < n; ++k) {
        height[k] = std::abs(normal.dot(local.col(Eigen::Index(k))));
        nearer += height[k] < least;
      }
      if (nearer <= half) // no better
        continue;
      least = orderStatistic(height.data(), spare.data(), n, half);
      best = normal;
    }
  return best;
}

Sheet sheetAt(const Eigen::Matrix3Xd& points,
              Eigen::Index i,
              const std::vector<Eigen::Index>& near) {
  Sheet sheet;
  const Eigen::Vector3d at = points.col(i);
  const auto n = near.size();
  Half half(n);
  half.choose(points, near, ownPlane(points, near), at);
  const std::vector<double>& height = half.height;
  const std::vector<std::size_t>& order = half.order;
  double square = 0.0;
  for (int round = 0; round < tuning::sheets::ROUNDS; ++round) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < half.size(); ++k)
      mean += points.col(near[order[k]]) / double(half.size());
    for (std::size_t k = 0; k < half.size(); ++k) {
      const Eigen::Vector3d d = points.col(near[order[k]]) - mean;
      moments += d * d.transpose();
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(moments);
    sheet.normal = eigen.eigenvectors().col(0);
    half.choose(points, near, sheet.normal, mean);
    square = 0.0;
    for (std::size_t k = 0; k < half.size(); ++k)
      square += std::pow(height[order[k]], 2) / double(half.size());
  }
  const double own = OF_HALF * std::sqrt(square);
  const double radius = (points.col(near.back()) - at).norm();
  for (const double sign : {1.0, -1.0}) {
    double sum = 0.0, deviation = 0.0;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    std::vector<std::size_t> beyond;
    for (std::size_t k = 0; k < n; ++k)
      if (sign * height[k] > BEYOND * own) {
        beyond.push_back(k);
        sum += height[k];
        middle += points.col(near[k]) - at;
      }
    if (beyond.size() < tuning::sheets::FEWEST)
      continue;
    const double mean = sum / double(beyond.size());
    for (const std::size_t k : beyond)
      deviation += std::abs(height[k] - mean) / double(beyond.size());
    middle /= double(beyond.size());
    middle -= sheet.normal * sheet.normal.dot(middle);
    if (deviation < EVEN * std::abs(mean) &&
        middle.norm() < tuning::sheets::BESIDE * radius &&
        (sheet.other == 0.0 || std::abs(mean) < std::abs(sheet.other)))
      sheet.other = mean;
  }
  // a curved surface leaves its plane on all sides; one that a quadratic surface fits
  // to less than another sheet's own unevenness is a single one
  if (sheet.other != 0.0) {
    const LocalQuadric all = localQuadric(points, near);
    if (all.residuals.size() > 0 && all.scatter() < EVEN * std::abs(sheet.other))
      sheet.other = 0.0;
  }
  std::vector<Eigen::Index> same;
  for (std::size_t k = 0; k < n; ++k)
    if (sheet.other == 0.0 || std::abs(height[k]) < 0.5 * std::abs(sheet.other))
      same.push_back(near[k]);
  constexpr std::size_t ENOUGH = std::size_t(2) * LocalQuadric::TERMS;
  if (same.size() >= ENOUGH) {
    const LocalQuadric patch = localQuadric(points, same);
    if (patch.residuals.size() > 0)
      sheet.scatter = patch.scatter();
  }
  return sheet;
}

} // namespace

std::vector<Sheet> sheetsOf(const Eigen::Matrix3Xd& points) {
  const Eigen::Index step = std::max<Eigen::Index>(1, points.cols() / LOOKED_AT);
  std::vector<Sheet> sheets;
  if (points.cols() < Eigen::Index(2 * tuning::sheets::NEIGHBOURS))
    return sheets;
  Neighbourhood neighbourhood(points);
  for (Eigen::Index i = 0; i < points.cols(); i += step)
    sheets.push_back(
        sheetAt(points, i, neighbourhood.of(i, tuning::sheets::NEIGHBOURS)));
  return sheets;
}

double doubled(const std::vector<Sheet>& sheets) {
  const auto count = std::count_if(
      sheets.begin(), sheets.end(), [](const Sheet& s) { return s.other != 0.0; });
  return sheets.empty() ? 0.0 : double(count) / double(sheets.size());
}

namespace {

/** \brief Noise of independent points, from the sheets that scatter least [m]. */
double noiseOf(const std::vector<Sheet>& sheets) {
  std::vector<double> scatters;
  for (const Sheet& s : sheets)
    if (s.scatter >= 0.0)
      scatters.push_back(s.scatter);
  if (scatters.empty())
    return 0.0;
  const auto at = scatters.begin() + std::ptrdiff_t(SMOOTH * double(scatters.size()));
  std::nth_element(scatters.begin(), at, scatters.end());
  return *at / OF_SMOOTH;
}

/** \brief Whether both sides of walls show, as solids do not. Where points are dense,
 * fewer are looked at: all neighbours would be on one side. */
bool showWalls(const Eigen::Matrix3Xd& points, const std::vector<Sheet>& sheets) {
  const Eigen::Index step = 1 + (points.cols() - 1) / WALL_POINTS;
  if (step <= 1)
    return doubled(sheets) > TWO_SIDES;
  Eigen::Matrix3Xd some(3, points.cols() / step);
  for (Eigen::Index i = 0; i < some.cols(); ++i)
    some.col(i) = points.col(i * step);
  return doubled(sheetsOf(some)) > TWO_SIDES;
}

} // namespace

ObservedObject::Surface surfaceOf(const Eigen::Matrix3Xd& points) {
  const std::vector<Sheet> sheets = sheetsOf(points);
  return {noiseOf(sheets), showWalls(points, sheets)};
}

} // namespace pcl_sq::detail

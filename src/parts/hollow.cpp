// SPDX-License-Identifier: BSD-3-Clause
// The outside of hollow things: what solids can be fitted to where both sides of their
// walls were measured.
#include "observe/sheets.h"
#include "parts/whole_cloud.h"

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

} // namespace

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

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// Whether neighbours err together, as the points of one depth image do: matching
// windows overlap, depth cameras smooth.
#include "sensor/depth_patch.h"
#include "sensor/local_quadric.h"

#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr Eigen::Index PATCHES = 60;
constexpr std::size_t SMALLEST_PATCH = 24; ///< points of a patch
/** \brief A patch's share of the points: small enough for a quadratic surface. */
constexpr Eigen::Index SHARE = 20;
/** \brief Larger ratios of neighbours' differences to the scatter are chance. */
constexpr double INDEPENDENT = 0.85;
/** \brief Part of a patch whose points share an error: over more, the surface follows.
 */
constexpr double TOGETHER = 0.25;

/** \brief Half the mean squared difference of each residual and its nearest one's: the
 * variance of what they do not share. */
double varianceBetweenNeighbours(const LocalQuadric& patch) {
  double sum = 0.0;
  const Eigen::Index n = patch.residuals.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    double nearest = 1e300;
    Eigen::Index neighbour = i;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double distance = (patch.across.col(k) - patch.across.col(i)).squaredNorm();
      if (k != i && distance < nearest) {
        nearest = distance;
        neighbour = k;
      }
    }
    sum += std::pow(patch.residuals[i] - patch.residuals[neighbour], 2);
  }
  return 0.5 * sum / double(n);
}

} // namespace

double sharingOfErrors(const Eigen::Matrix3Xd& points) {
  const Eigen::Index n = points.cols();
  const std::size_t count =
      std::max(SMALLEST_PATCH, static_cast<std::size_t>(n / SHARE));
  if (n < Eigen::Index(2 * count))
    return 1.0;
  std::vector<double> own, all;
  Neighbourhood neighbourhood(points);
  for (Eigen::Index i = 0; i < n; i += std::max<Eigen::Index>(1, n / PATCHES)) {
    const LocalQuadric patch = localQuadric(points, neighbourhood.of(i, count));
    if (patch.residuals.size() == 0)
      continue;
    own.push_back(varianceBetweenNeighbours(patch));
    all.push_back(std::pow(patch.scatter(), 2));
  }
  if (all.empty())
    return 1.0;
  const double total = median(std::move(all));
  const double ratio = total > 0.0 ? median(std::move(own)) / total : 1.0;
  if (!(ratio < INDEPENDENT * INDEPENDENT))
    return 1.0;
  // M9: the design effect of errors that so many share (Kish 1965)
  return 1.0 + (TOGETHER * double(count) - 1.0) * (1.0 - ratio);
}

} // namespace pcl_sq::detail

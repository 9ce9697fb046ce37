// SPDX-License-Identifier: BSD-3-Clause
// The points of an object in an image that are fitted.
#include "observe/observe_parts.h"
#include "sensor/depth_patch.h"
#include "tuning/observe_tuning.h"
#include "util/order_statistic.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::observe_points;

bool deepInside(const CellMask& mask, int x, int y, int rim) {
  for (int d = 1; d <= rim; ++d)
    if (!mask(x - d, y) || !mask(x + d, y) || !mask(x, y - d) || !mask(x, y + d))
      return false;
  return true;
}

/** \brief Whether a pixel's depth is that of most of its neighbours in the mask. */
bool agreesWithNeighbours(const DepthPatch& patch, int x, int y) {
  constexpr std::size_t WINDOW = std::size_t(2 * REACH + 1) * (2 * REACH + 1);
  std::array<double, WINDOW> depths, sorted, spare;
  const std::size_t count = patch.ownAround(x, y, REACH, depths.data());
  if (count < FEW)
    return false;
  std::copy_n(depths.begin(), count, sorted.begin());
  const double middle = orderStatistic(sorted.data(), spare.data(), count, count / 2);
  const double off = std::abs(patch.depth(x, y) - middle);
  // off <= 6 spread + a thousandth, where the spread is the median distance from the
  // middle: to compare with a median is to count
  std::size_t narrower = 0;
  for (std::size_t i = 0; i < count; ++i)
    narrower += 6.0 * std::abs(depths[i] - middle) + 1e-3 * middle < off;
  return narrower <= count / 2;
}

} // namespace

void choosePoints(Observation& o,
                  const CellRect& box,
                  const DepthPatch& patch,
                  int rim) {
  const double area = double(o.out.pixels.count());
  const int step = std::max(1,
                            static_cast<int>(std::floor(std::sqrt(
                                area / double(tuning::observe_points::MAX_POINTS)))));
  std::vector<int> chosen;
  std::size_t pixels = 0, finite = 0; // well inside the mask; with a depth
  for (int shrink = rim; shrink >= 0 && chosen.size() < std::size_t(MIN_IMAGE_POINTS);
       --shrink) {
    chosen.clear();
    pixels = finite = 0;
    for (int y = box.y; y < box.y + box.height; y += step)
      for (int x = box.x; x < box.x + box.width; x += step) {
        const int c = y * o.width + x;
        if (!o.out.pixels(x, y) || !deepInside(o.out.pixels, x, y, shrink))
          continue;
        ++pixels;
        if (!o.finite(c))
          continue;
        ++finite;
        if (agreesWithNeighbours(patch, x, y))
          chosen.push_back(c);
      }
  }
  o.out.columns = chosen;
  o.out.points.resize(3, static_cast<Eigen::Index>(chosen.size()));
  for (std::size_t i = 0; i < chosen.size(); ++i)
    o.out.points.col(static_cast<Eigen::Index>(i)) = o.at(chosen[i]);
  if (o.view.noise.size() > 0) {
    o.out.noise.resize(static_cast<Eigen::Index>(chosen.size()));
    for (std::size_t i = 0; i < chosen.size(); ++i)
      o.out.noise[static_cast<Eigen::Index>(i)] = o.view.noise[chosen[i]];
  }
  const double independent = area / (o.view.correlation * o.view.correlation) *
                             double(finite) / std::max(1.0, double(pixels));
  o.out.effective_points = std::min(double(chosen.size()), independent);
}

void measure(ObservedObject& observed) {
  if (observed.points.cols() == 0)
    return;
  // a few wrong matches must not make the object large
  const Eigen::Index n = observed.points.cols(), cut = n / 100;
  Eigen::Vector3d side;
  std::vector<double> along(static_cast<std::size_t>(n));
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXd::Map(along.data(), n) = observed.points.row(k);
    std::nth_element(along.begin(), along.begin() + cut, along.end());
    const double low = along[std::size_t(cut)];
    std::nth_element(along.begin(), along.end() - 1 - cut, along.end());
    side[k] = *(along.end() - 1 - cut) - low;
  }
  observed.extent = 0.5 * side.norm();
  observed.depth =
      std::max(1e-9, observed.camera.depthOf(observed.points.rowwise().mean()));
}

} // namespace pcl_sq::detail

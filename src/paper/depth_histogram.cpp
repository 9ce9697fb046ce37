// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/depth_histogram.h"

#include "util/option_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_sq {
namespace {

/** Closer than 1/4096 of a pixel's depth, or of 1/41 of the scene's, lies only noise.
 */
constexpr int MAX_BINS = 4096;

/** Median of a vector that may be reordered; \pre not empty */
float median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<float> usable(const std::vector<float>& depths) {
  std::vector<float> result;
  result.reserve(depths.size());
  std::copy_if(depths.begin(), depths.end(), std::back_inserter(result), [](float z) {
    return z > 0.0f && std::isfinite(z);
  });
  return result;
}

/** The run of bins above the threshold with the most points. */
void findAperture(DepthHistogram& histogram, int max_gap) {
  const int bins = static_cast<int>(histogram.counts.size());
  std::uint64_t best = 0, sum = 0;
  int first = -1, last = -1;
  for (int bin = 1; bin < bins; ++bin) {
    const std::uint32_t count = histogram.counts[static_cast<std::size_t>(bin)];
    if (count <= histogram.threshold)
      continue;
    if (first < 0 || bin - last - 1 > max_gap) {
      first = bin;
      sum = 0;
    }
    last = bin;
    sum += count;
    if (sum > best) {
      best = sum;
      histogram.first_bin = first;
      histogram.last_bin = last;
    }
  }
}

} // namespace

bool DepthHistogramOptions::isValid(std::string* why) const {
  if (!(disparity_scale >= 0.0 && std::isfinite(disparity_scale)))
    return detail::refuse(why, "disparity_scale must not be negative");
  if (!(relative_bin > 0.0 && relative_bin <= 1.0))
    return detail::refuse(why, "relative_bin must be in (0, 1]");
  if (min_count < 0)
    return detail::refuse(why, "min_count must not be negative");
  if (!(min_share >= 0.0 && min_share <= 1.0))
    return detail::refuse(why, "min_share must be in [0, 1]");
  if (max_gap < 0)
    return detail::refuse(why, "max_gap must not be negative");
  return true;
}

int DepthHistogram::binOf(double depth) const {
  if (!(depth > 0.0 && std::isfinite(depth)))
    return -1;
  const double bin = 1.0 / (depth * bin_width);
  return bin < MAX_BINS ? static_cast<int>(bin) : MAX_BINS;
}

bool computeDepthHistogram(const std::vector<float>& depths,
                           std::size_t pixels,
                           const DepthHistogramOptions& options,
                           DepthHistogram& histogram,
                           std::string* why) {
  histogram = DepthHistogram();
  if (!options.isValid(why))
    return false;
  std::vector<float> valid = usable(depths);
  if (valid.empty())
    return detail::refuse(
        why,
        "there are no points in front of the camera; check the 2D region and "
        "that z points forward");
  histogram.bin_width = options.disparity_scale > 0.0
                            ? 1.0 / options.disparity_scale
                            : options.relative_bin / static_cast<double>(median(valid));
  for (const float depth : valid) {
    const int bin = histogram.binOf(static_cast<double>(depth));
    if (bin >= MAX_BINS)
      continue;
    const auto b = static_cast<std::size_t>(bin);
    if (b >= histogram.counts.size())
      histogram.counts.resize(b + 1, 0);
    ++histogram.counts[b];
  }
  histogram.threshold = std::max(static_cast<double>(options.min_count),
                                 options.min_share * static_cast<double>(pixels));
  findAperture(histogram, options.max_gap);
  if (histogram.last_bin < histogram.first_bin)
    return detail::refuse(
        why, "no depth has enough points; choose a 2D region that the object fills");
  std::vector<float> inside;
  std::copy_if(valid.begin(),
               valid.end(),
               std::back_inserter(inside),
               [&histogram](float z) { return histogram.contains(z); });
  histogram.median_depth = static_cast<double>(median(inside));
  return true;
}

} // namespace pcl_sq

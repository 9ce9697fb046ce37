// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/histogram_plot.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl_sq {
namespace {

const cv::Scalar INK(60, 60, 60), BAR(190, 190, 185), CHOSEN(60, 120, 230);

void write(cv::Mat& picture,
           const cv::Point& at,
           const std::string& text,
           double size) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, INK, 1, cv::LINE_AA);
}

std::string format(const char* pattern, double value) {
  char text[64];
  std::snprintf(text, sizeof(text), pattern, value);
  return text;
}

} // namespace

cv::Mat plotDepthHistogram(const DepthHistogram& histogram,
                           double disparity_scale,
                           const cv::Size& size) {
  cv::Mat picture(size, CV_8UC3, cv::Scalar::all(255));
  const double text = std::clamp(size.width / 1100.0, 0.35, 0.8);
  const int margin = static_cast<int>(90 * text);
  const cv::Rect plot(
      margin, margin, size.width - margin - margin / 2, size.height - 2 * margin);
  const auto& counts = histogram.counts;
  int first = 0, last = static_cast<int>(counts.size()) - 1;
  while (first < last && counts[static_cast<std::size_t>(first)] == 0)
    ++first;
  while (last > first && counts[static_cast<std::size_t>(last)] == 0)
    --last;
  if (counts.empty() || histogram.bin_width <= 0.0 || plot.area() <= 0)
    return picture;
  first = std::max(0, first - 1);
  const double highest = *std::max_element(counts.begin(), counts.end());
  const auto x = [&](double bin) {
    return plot.x + static_cast<int>((bin - first) / (last + 2 - first) * plot.width);
  };
  const auto y = [&](double count) {
    return plot.y + plot.height -
           static_cast<int>(count / std::max(1.0, highest) * plot.height);
  };
  for (int bin = first; bin <= last; ++bin) {
    const bool chosen = bin >= histogram.first_bin && bin <= histogram.last_bin;
    const double count = counts[static_cast<std::size_t>(bin)];
    const cv::Point top(x(bin), y(count)),
        bottom(std::max(x(bin), x(bin + 1) - 2), y(0));
    cv::rectangle(picture, top, bottom, chosen ? CHOSEN : BAR, cv::FILLED);
  }
  cv::line(picture, {plot.x, y(0)}, {plot.x + plot.width, y(0)}, INK);
  cv::line(picture,
           {plot.x, y(histogram.threshold)},
           {plot.x + plot.width, y(histogram.threshold)},
           {200, 160, 120});
  // four numbers along the axis
  for (int k = 0; k <= 4; ++k) {
    const double bin = first + k * (last + 1 - first) / 4.0;
    const double inverse = bin * histogram.bin_width;
    const std::string label = disparity_scale > 0.0
                                  ? format("%.0f", inverse * disparity_scale)
                                  : format("%.2f", inverse);
    write(picture, {x(bin) - margin / 4, y(0) + margin / 3}, label, text);
  }
  write(picture,
        {plot.x + plot.width / 3, size.height - margin / 5},
        disparity_scale > 0.0 ? "disparity [px]" : "inverse depth [1/m]",
        text);
  if (histogram.last_bin >= histogram.first_bin)
    write(picture,
          {plot.x, margin * 2 / 3},
          "aperture " + format("%.3f", histogram.nearDepth()) + " to " +
              format("%.3f m", histogram.farDepth()),
          text);
  return picture;
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
// The noise of a rig, measured where the truth is known: across the rows of a rectified
// pair, where the disparity is zero.
#include "stereo/disparity_noise.h"

#include "stereo/refine_disparity.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <vector>

namespace pcl_sq::detail {
namespace {

constexpr double WINDOW_SIGMA = 2.0; ///< of the refinement's window [px]
constexpr int WINDOW = 9;            ///< its side [px]
constexpr double FARTHEST = 1.5; ///< matches farther off the row are false ones [px]
constexpr int CLASSES = 16;      ///< of texture, each with as many windows
constexpr int FEWEST = 40;       ///< windows of a class
/** \brief Side of the squares whose means tell how many neighbours err alike: several
 * windows wide, and no wider than the objects that are looked at [px]. */
constexpr int SQUARE = 31;
/** \brief Side of the region in which a common offset is no noise: it moves what is in
 * it as a whole, as poor rectification does [px]. */
constexpr int REGION = 155;
/** \brief Of nothing that was measured: matchers for real rigs are good to about a
 * fifth of a pixel. */
constexpr double USUAL = 0.2;

double median(std::vector<float>& values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return double(*middle);
}

/** \brief Matches across the rows, and what texture leaves open along each axis. */
struct Matches {
  cv::Mat across;               ///< CV_32F, offset from the row [px]; NaN: unknown
  cv::Mat open_across, open_in; ///< CV_32F, variance by the texture alone [px^2]
};

Matches matchAcross(const cv::Mat& left, const cv::Mat& right, const cv::Mat& d) {
  cv::Mat l, r, u(d.size(), CV_32F), v(d.size(), CV_32F);
  left.convertTo(l, CV_32F);
  right.convertTo(r, CV_32F);
  const cv::Mat known = d > -FLT_MAX; // false for NaN
  for (int y = 0; y < d.rows; ++y)
    for (int x = 0; x < d.cols; ++x) {
      const float at = d.at<float>(y, x);
      u.at<float>(y, x) = static_cast<float>(x) - (at == at ? at : 0.0F);
      v.at<float>(y, x) = static_cast<float>(y);
    }
  const auto atMatch = [&](const cv::Mat& values, int how) {
    cv::Mat result;
    cv::remap(values, result, u, v, how, cv::BORDER_REPLICATE);
    return result;
  };
  const cv::Mat half = (cv::Mat_<float>(1, 3) << -0.5F, 0.0F, 0.5F);
  cv::Mat in_row, in_column, weight;
  cv::filter2D(r, in_row, CV_32F, half);
  cv::filter2D(r, in_column, CV_32F, half.t());
  in_row = atMatch(in_row, cv::INTER_LINEAR);
  in_column = atMatch(in_column, cv::INTER_LINEAR);
  known.convertTo(weight, CV_32F, 1.0 / 255.0);
  const auto mean = [&weight]( // of what is known
                        const cv::Mat& values,
                        int side) {
    cv::Mat sum, count;
    cv::boxFilter(values.mul(weight), sum, CV_32F, {side, side});
    cv::boxFilter(weight, count, CV_32F, {side, side});
    return cv::Mat(sum / cv::max(count, 1e-6));
  };
  const cv::Mat bell = cv::getGaussianKernel(WINDOW, WINDOW_SIGMA, CV_32F);
  const double scale = 1.0 / double(bell.at<float>(WINDOW / 2)); // 1 in the middle
  const auto window = [&](const cv::Mat& values) {
    cv::Mat sum;
    cv::sepFilter2D(values.mul(weight), sum, CV_32F, bell * scale, bell * scale);
    return sum;
  };
  cv::Mat off = l - atMatch(r, cv::INTER_CUBIC);
  off -= mean(off, EXPOSURE_WINDOW);
  const cv::Mat variance = mean(off.mul(off), NOISE_WINDOW) + MIN_VARIANCE;
  const cv::Mat square_across = cv::max(window(in_column.mul(in_column)), 1e-6);
  Matches m;
  m.across = window(in_column.mul(off)) / square_across;
  m.open_across = variance / square_across;
  m.open_in = variance / cv::max(window(in_row.mul(in_row)), 1e-6);
  cv::Mat all;
  cv::erode(known, all, cv::Mat::ones(WINDOW, WINDOW, CV_8U));
  cv::Mat good = (all != 0) & (cv::abs(m.across) < FARTHEST);
  m.across.setTo(0.0, ~good);
  good.convertTo(weight, CV_32F, 1.0 / 255.0);
  m.across -= mean(m.across, REGION);
  m.across.setTo(std::nan(""), ~good);
  return m;
}

/** \brief A variance that grows with what texture leaves open. */
struct Law {
  double floor = USUAL * USUAL, factor = 1.0;
  double at(double open) const { return floor + factor * open; }
};

/** \brief The law through the robust variances of classes of texture, each as far off
 * as its own size. */
Law fitLaw(const Matches& m) {
  std::vector<std::pair<float, float>> windows; // open, offset
  const int step = std::max(1, static_cast<int>(std::sqrt(m.across.total() / 3e4)));
  for (int y = 0; y < m.across.rows; y += step)
    for (int x = 0; x < m.across.cols; x += step)
      if (const float o = m.across.at<float>(y, x); o == o)
        windows.emplace_back(m.open_across.at<float>(y, x), o);
  Law law;
  if (windows.size() < std::size_t(CLASSES) * FEWEST)
    return law;
  std::sort(windows.begin(), windows.end());
  std::vector<double> open, variance;
  for (std::size_t k = 0; k < CLASSES; ++k) {
    const std::size_t from = windows.size() * k / CLASSES;
    const std::size_t to = windows.size() * (k + 1) / CLASSES;
    std::vector<float> offsets, distances;
    for (std::size_t i = from; i < to; ++i)
      offsets.push_back(windows[i].second);
    const double middle = median(offsets);
    for (const float o : offsets)
      distances.push_back(static_cast<float>(std::abs(double(o) - middle)));
    open.push_back(double(windows[(from + to) / 2].first));
    variance.push_back(std::pow(1.4826 * median(distances), 2)); // a Gaussian's
  }
  double best = 1e300;
  const auto tryLaw = [&](double floor, double factor) {
    double cost = 0.0;
    for (std::size_t k = 0; k < open.size(); ++k)
      cost += std::abs(std::log((floor + factor * open[k]) / variance[k]));
    if (cost < best) {
      best = cost;
      law.floor = floor;
      law.factor = factor;
    }
  };
  // the law that halves errors' logarithms runs through two of the classes
  for (std::size_t i = 0; i < open.size(); ++i)
    for (std::size_t k = i + 1; k < open.size(); ++k) {
      const double factor = (variance[k] - variance[i]) / (open[k] - open[i]);
      const double floor = variance[i] - factor * open[i];
      if (factor >= 0.0 && floor > 0.0)
        tryLaw(floor, factor);
    }
  return law;
}

/** \brief Side of the square that has as much variance by itself as squares have as
 * means. */
double findCorrelation(const Matches& m, const Law& law) {
  double squares = 0.0, means = 0.0;
  int count = 0, pixels = 0;
  for (int y = 0; y + SQUARE <= m.across.rows; y += SQUARE)
    for (int x = 0; x + SQUARE <= m.across.cols; x += SQUARE) {
      double sum = 0.0, square = 0.0;
      int n = 0;
      for (int v = y; v < y + SQUARE; ++v)
        for (int u = x; u < x + SQUARE; ++u)
          if (const float o = m.across.at<float>(v, u); o == o) {
            const double open = double(m.open_across.at<float>(v, u));
            const double z = double(o) / std::sqrt(law.at(open));
            if (std::abs(z) > 3.0)
              continue;
            sum += z;
            square += z * z;
            ++n;
          }
      if (2 * n < SQUARE * SQUARE)
        continue;
      means += std::pow(sum / n, 2);
      squares += square;
      pixels += n;
      ++count;
    }
  if (count < 8)
    return DisparityNoise().correlation;
  return SQUARE * std::sqrt((means / count) / (squares / pixels));
}

} // namespace

DisparityNoise
measureNoise(const cv::Mat& left, const cv::Mat& right, const cv::Mat& disparity) {
  const Matches matches = matchAcross(left, right, disparity);
  const Law law = fitLaw(matches);
  DisparityNoise noise;
  noise.correlation = findCorrelation(matches, law);

  cv::sqrt(law.floor + law.factor * matches.open_in, noise.sigma);
  return noise;
}

} // namespace pcl_sq::detail

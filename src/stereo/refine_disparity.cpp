// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/refine_disparity.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl_sq::detail {
namespace {

constexpr int HALF = 4;           ///< of the window's side [px]
constexpr float WIDTH = 2.0F;     ///< standard deviation of the window's weights [px]
constexpr int PASSES = 4;         ///< Gauss-Newton steps
constexpr float GATE = 1.0F;      ///< how far a neighbour may lie off the plane [px]
constexpr float MAX_MOVE = 1.5F;  ///< from the matcher's disparity [px]
constexpr float MAX_SLOPE = 1.0F; ///< of a plane, disparity over pixels
/** \brief What a neighbour's disparity weighs against its grey value: 1 over the
 * variance of disparities [1/px^2]. The matcher errs by some 0.2 px, and windows that
 * overlap share their errors. The grey values' variance is what the images still differ
 * by. */
constexpr float PRIOR = 2.0F;
constexpr float MIN_VARIANCE = 0.5F; ///< of grey values: they are whole numbers
constexpr float SLOPE_PRIOR = 0.5F;  ///< holds slopes where a window's pixels do not
constexpr int EXPOSURE_WINDOW = 41;  ///< in which the cameras' exposures agree [px]
constexpr int NOISE_WINDOW = 15;     ///< in which the grey values' variance is taken

constexpr float NOTHING = std::numeric_limits<float>::quiet_NaN();

/** \brief Planes of disparities, and what the images say about each pixel's own. */
struct State {
  cv::Mat disparity, slope_u, slope_v; ///< CV_32F
  cv::Mat weight;                      ///< square gradient and prior; 0 = missing
  cv::Mat moment;                      ///< weight times wanted disparity
};

/** \brief Grey values of matched pixels. */
struct Comparison {
  cv::Mat difference, gradient, compared, variance; ///< CV_32F
};

/** \brief Grey values L(u) - R(u - d) at each pixel's own disparity, and what a change
 * of the disparity does to R(u - d); both 0 where nothing is compared. */
void compareRow(const cv::Mat& left,
                const cv::Mat& right,
                const cv::Mat& disparity,
                int v,
                Comparison& out) {
  const auto* l = left.ptr<float>(v);
  const auto* r = right.ptr<float>(v);
  const auto* d = disparity.ptr<float>(v);
  auto* difference = out.difference.ptr<float>(v);
  auto* gradient = out.gradient.ptr<float>(v);
  auto* compared = out.compared.ptr<float>(v);
  for (int u = 0; u < left.cols; ++u) {
    difference[u] = gradient[u] = compared[u] = 0.0F;
    const float at = static_cast<float>(u) - d[u];
    if (!(at >= 1.0F && at < static_cast<float>(right.cols - 2)))
      continue;
    const int x = static_cast<int>(at);
    const float f = at - static_cast<float>(x);
    // Catmull & Rom's cubic through four pixels: between two alone it blurs halfway,
    // and disparities lean towards whole pixels
    const float* p = r + x - 1;
    const float slope = 0.5F * (p[2] - p[0]);
    const float square = p[0] - 2.5F * p[1] + 2.0F * p[2] - 0.5F * p[3];
    const float cube = 1.5F * (p[1] - p[2]) + 0.5F * (p[3] - p[0]);
    difference[u] = l[u] - (p[1] + f * (slope + f * (square + f * cube)));
    gradient[u] = slope + f * (2.0F * square + 3.0F * f * cube);
    compared[u] = 1.0F;
  }
}

/** \brief Takes off what the images differ by over wide windows, exposure and
 * vignetting, and takes the variance of the rest. As matched pixels are compared,
 * outlines do no harm. */
void levelOut(Comparison& c) {
  cv::Mat sum, count;
  const auto mean = [&](const cv::Mat& values, int side) {
    cv::boxFilter(values, sum, CV_32F, {side, side});
    cv::boxFilter(c.compared, count, CV_32F, {side, side});
    return cv::Mat(sum / cv::max(count, 1e-6));
  };
  c.difference -= c.compared.mul(mean(c.difference, EXPOSURE_WINDOW));
  c.variance = mean(c.difference.mul(c.difference), NOISE_WINDOW);
}

/** \brief Each pixel's equation for its disparity, its weight and right side. */
void lineariseRow(const Comparison& c, int v, State& s) {
  const auto* difference = c.difference.ptr<float>(v);
  const auto* gradient = c.gradient.ptr<float>(v);
  const auto* variance = c.variance.ptr<float>(v);
  const auto* d = s.disparity.ptr<float>(v);
  auto* weight = s.weight.ptr<float>(v);
  auto* moment = s.moment.ptr<float>(v);
  for (int u = 0; u < s.disparity.cols; ++u) {
    const bool missing = std::isnan(d[u]);
    const float prior = PRIOR * (variance[u] + MIN_VARIANCE);
    weight[u] = missing ? 0.0F : gradient[u] * gradient[u] + prior;
    moment[u] = missing ? 0.0F : weight[u] * d[u] - gradient[u] * difference[u];
  }
}

/** \brief Sums of a row of windows, one array per sum so that compilers see vectors. */
struct Sums {
  explicit Sums(int width) {
    for (auto& sum : sums)
      sum.assign(static_cast<std::size_t>(width), 0.0F);
  }
  /** 1, u, v, uu, uv, vv of the weights; 1, u, v of the wanted change */
  std::array<std::vector<float>, 9> sums;
};

void addWindowRow(const State& s, int v, int dv, Sums& sums) {
  const int width = s.disparity.cols;
  const auto* centre = s.disparity.ptr<float>(v);
  const auto* slope_u = s.slope_u.ptr<float>(v);
  const auto* slope_v = s.slope_v.ptr<float>(v);
  const auto* disparity = s.disparity.ptr<float>(v + dv);
  const auto* weight = s.weight.ptr<float>(v + dv);
  const auto* moment = s.moment.ptr<float>(v + dv);
  const auto y = static_cast<float>(dv);
  std::array<float*, 9> out;
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] = sums.sums[k].data();
  for (int du = -HALF; du <= HALF; ++du) {
    const auto x = static_cast<float>(du);
    const float bell = std::exp(-0.5F * (x * x + y * y) / (WIDTH * WIDTH));
    const int end = std::min(width, width - du);
    for (int u = std::max(0, -du); u < end; ++u) {
      const float off = disparity[u + du] - centre[u] - slope_u[u] * x - slope_v[u] * y;
      // false for NaN on either side
      const float share = std::abs(off) < GATE ? bell : 0.0F;
      const float m = share * weight[u + du];
      const float n = share != 0.0F ? share * moment[u + du] - m * centre[u] : 0.0F;
      out[0][u] += m;
      out[1][u] += m * x;
      out[2][u] += m * y;
      out[3][u] += m * x * x;
      out[4][u] += m * x * y;
      out[5][u] += m * y * y;
      out[6][u] += n;
      out[7][u] += n * x;
      out[8][u] += n * y;
    }
  }
}

/** \brief Solves each window's three equations by elimination. */
void solveRow(const State& s, int v, const Sums& sums, State& next) {
  const auto* d = s.disparity.ptr<float>(v);
  for (int u = 0; u < s.disparity.cols; ++u) {
    auto& out = next.disparity.at<float>(v, u);
    out = NOTHING;
    if (std::isnan(d[u]))
      continue;
    const auto sum = [&sums, u](std::size_t k) {
      return double(sums.sums[k][static_cast<std::size_t>(u)]);
    };
    const double w = sum(0), mu = sum(1) / w, mv = sum(2) / w;
    const double ridge = SLOPE_PRIOR * w;
    const double uu = sum(3) - mu * sum(1) + ridge, uv = sum(4) - mu * sum(2);
    const double vv = sum(5) - mv * sum(2) + ridge;
    const double nu = sum(7) - mu * sum(6) + ridge * double(s.slope_u.at<float>(v, u));
    const double nv = sum(8) - mv * sum(6) + ridge * double(s.slope_v.at<float>(v, u));
    const double determinant = uu * vv - uv * uv;
    const double a = (vv * nu - uv * nv) / determinant;
    const double b = (uu * nv - uv * nu) / determinant;
    const double change = sum(6) / w - a * mu - b * mv;
    if (!(std::abs(change) < double(MAX_MOVE)))
      continue;
    out = static_cast<float>(double(d[u]) + change);
    const auto bound = double(MAX_SLOPE);
    next.slope_u.at<float>(v, u) = static_cast<float>(std::clamp(a, -bound, bound));
    next.slope_v.at<float>(v, u) = static_cast<float>(std::clamp(b, -bound, bound));
  }
}

} // namespace

void refineDisparity(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity) {
  cv::Mat l, r;
  left.convertTo(l, CV_32F);
  right.convertTo(r, CV_32F);
  Comparison comparison;
  for (cv::Mat* m :
       {&comparison.difference, &comparison.gradient, &comparison.compared})
    m->create(disparity.size(), CV_32F);
  State now, next;
  now.disparity = disparity.clone();
  for (cv::Mat* m : {&now.slope_u, &now.slope_v, &now.weight, &now.moment})
    *m = cv::Mat::zeros(disparity.size(), CV_32F);
  const cv::Range rows(0, disparity.rows);
  for (int pass = 0; pass < PASSES; ++pass) {
    cv::parallel_for_(rows, [&](const cv::Range& range) {
      for (int v = range.start; v < range.end; ++v)
        compareRow(l, r, now.disparity, v, comparison);
    });
    levelOut(comparison);
    cv::parallel_for_(rows, [&](const cv::Range& range) {
      for (int v = range.start; v < range.end; ++v)
        lineariseRow(comparison, v, now);
    });
    next.disparity = now.disparity.clone();
    next.slope_u = now.slope_u.clone();
    next.slope_v = now.slope_v.clone();
    cv::parallel_for_(rows, [&](const cv::Range& range) {
      for (int v = range.start; v < range.end; ++v) {
        Sums sums(disparity.cols);
        for (int dv = -HALF; dv <= HALF; ++dv)
          if (v + dv >= 0 && v + dv < disparity.rows)
            addWindowRow(now, v, dv, sums);
        solveRow(now, v, sums, next);
      }
    });
    std::swap(now.disparity, next.disparity);
    std::swap(now.slope_u, next.slope_u);
    std::swap(now.slope_v, next.slope_v);
  }
  const cv::Mat moved = cv::abs(now.disparity - disparity);
  now.disparity.setTo(NOTHING, ~(moved < MAX_MOVE));
  disparity = now.disparity;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/refine_disparity.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#ifdef __GNUC__ // into each of its callers, with their instructions
#define PCL_SQ_INLINE inline __attribute__((always_inline))
#else
#define PCL_SQ_INLINE inline
#endif

namespace pcl_sq::detail {
namespace {

constexpr int HALF = 4; ///< of the window's side [px]
/** Weights of a window's rows and columns, exp(-x^2 / 8). */
constexpr float BELL[2 * HALF + 1] = {
    0.135F, 0.325F, 0.607F, 0.882F, 1.0F, 0.882F, 0.607F, 0.325F, 0.135F};
constexpr int LARGEST_BLOCK = 16; ///< windows that are summed at once
constexpr int PASSES = 4;         ///< Gauss-Newton steps
constexpr float GATE = 1.0F;      ///< how far a neighbour may lie off the plane [px]
constexpr float MAX_MOVE = 1.5F;  ///< from the matcher's disparity [px]
constexpr float MAX_SLOPE = 1.0F; ///< of a plane, disparity over pixels
/** \brief What a neighbour's disparity weighs against its grey value: 1 over the
 * variance of disparities [1/px^2]. The matcher errs by some 0.2 px, and windows that
 * overlap share their errors. The grey values' variance is what the images still differ
 * by. */
constexpr float PRIOR = 2.0F;
constexpr float SLOPE_PRIOR = 0.5F; ///< holds slopes where a window's pixels do not

constexpr float NOTHING = std::numeric_limits<float>::quiet_NaN();

/** \brief Planes of disparities, and what the images say about each pixel's own. All
 * with a margin, so that windows and blocks need no look at the border. */
struct State {
  cv::Mat disparity, slope_u, slope_v; ///< CV_32F
  cv::Mat weight;                      ///< square gradient and prior; 0 = missing
  cv::Mat moment;                      ///< weight times wanted disparity

  explicit State(const cv::Mat& matched) {
    cv::copyMakeBorder(matched,
                       disparity,
                       HALF,
                       HALF,
                       HALF,
                       HALF + LARGEST_BLOCK,
                       cv::BORDER_CONSTANT,
                       cv::Scalar(NOTHING));
    for (cv::Mat* m : {&slope_u, &slope_v, &weight, &moment})
      *m = cv::Mat::zeros(disparity.size(), CV_32F);
  }
};
const float* row(const cv::Mat& with_margin, int v) {
  return with_margin.ptr<float>(v + HALF) + HALF;
}
float* row(cv::Mat& with_margin, int v) {
  return with_margin.ptr<float>(v + HALF) + HALF;
}

/** \brief Grey values of matched pixels. */
struct Comparison {
  cv::Mat difference, gradient, compared, variance; ///< CV_32F
};

/** \brief Grey values L(u) - R(u - d) at each pixel's own disparity, and what a change
 * of the disparity does to R(u - d); both 0 where nothing is compared. */
void compareRow(const cv::Mat& left,
                const cv::Mat& right,
                const State& state,
                int v,
                Comparison& out) {
  const auto* l = left.ptr<float>(v);
  const auto* r = right.ptr<float>(v);
  const auto* d = row(state.disparity, v);
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
  const auto* d = row(s.disparity, v);
  auto* weight = row(s.weight, v);
  auto* moment = row(s.moment, v);
  for (int u = 0; u < c.variance.cols; ++u) {
    const bool missing = std::isnan(d[u]);
    const float prior = PRIOR * (variance[u] + MIN_VARIANCE);
    weight[u] = missing ? 0.0F : gradient[u] * gradient[u] + prior;
    moment[u] = missing ? 0.0F : weight[u] * d[u] - gradient[u] * difference[u];
  }
}

/** \brief Over the windows of pixels side by side: 1, u, v, uu, uv, vv of the weights;
 * 1, u, v of the wanted change. Sums of several windows at once, so that compilers make
 * vectors of them. */
template <int BLOCK>
using Sums = float[9][BLOCK];

template <int BLOCK>
PCL_SQ_INLINE void sumWindows(const State& s, int v, int u, Sums<BLOCK>& sums) {
  const auto* slope_u = row(s.slope_u, v) + u;
  const auto* slope_v = row(s.slope_v, v) + u;
  float centre[BLOCK]; // whatever where it is missing: nobody looks at those sums
  for (int k = 0; k < BLOCK; ++k) {
    const float d = row(s.disparity, v)[u + k];
    centre[k] = std::isnan(d) ? 0.0F : d;
  }
  for (auto& sum : sums)
    std::fill(sum, sum + BLOCK, 0.0F);
  for (int dv = -HALF; dv <= HALF; ++dv) {
    const auto y = static_cast<float>(dv);
    float plane[BLOCK], m0[BLOCK] = {}, m1[BLOCK] = {}, m2[BLOCK] = {}, n0[BLOCK] = {},
                        n1[BLOCK] = {};
    for (int k = 0; k < BLOCK; ++k)
      plane[k] = centre[k] + slope_v[k] * y;
    for (int du = -HALF; du <= HALF; ++du) {
      const auto x = static_cast<float>(du);
      const auto* disparity = row(s.disparity, v + dv) + u + du;
      const auto* weight = row(s.weight, v + dv) + u + du;
      const auto* moment = row(s.moment, v + dv) + u + du;
      const float bell = BELL[dv + HALF] * BELL[du + HALF];
      for (int k = 0; k < BLOCK; ++k) {
        const float off = disparity[k] - plane[k] - slope_u[k] * x;
        const float share = std::abs(off) < GATE ? bell : 0.0F; // false for NaN
        const float m = share * weight[k];
        const float n = share * moment[k] - m * centre[k];
        m0[k] += m;
        m1[k] += m * x;
        m2[k] += m * x * x;
        n0[k] += n;
        n1[k] += n * x;
      }
    }
    for (int k = 0; k < BLOCK; ++k) {
      sums[0][k] += m0[k];
      sums[1][k] += m1[k];
      sums[2][k] += m0[k] * y;
      sums[3][k] += m2[k];
      sums[4][k] += m1[k] * y;
      sums[5][k] += m0[k] * y * y;
      sums[6][k] += n0[k];
      sums[7][k] += n1[k];
      sums[8][k] += n0[k] * y;
    }
  }
}

/** \brief Solves one window's three equations by elimination; the new plane. */
template <int BLOCK>
PCL_SQ_INLINE void
solve(const State& s, int v, int u, const Sums<BLOCK>& sums, int k, State& next) {
  auto& out = row(next.disparity, v)[u];
  const float d = row(s.disparity, v)[u];
  out = NOTHING;
  if (std::isnan(d))
    return;
  const auto sum = [&sums, k](int i) { return double(sums[i][k]); };
  const double w = sum(0), mu = sum(1) / w, mv = sum(2) / w;
  const double ridge = SLOPE_PRIOR * w;
  const double uu = sum(3) - mu * sum(1) + ridge, uv = sum(4) - mu * sum(2);
  const double vv = sum(5) - mv * sum(2) + ridge;
  const double nu = sum(7) - mu * sum(6) + ridge * double(row(s.slope_u, v)[u]);
  const double nv = sum(8) - mv * sum(6) + ridge * double(row(s.slope_v, v)[u]);
  const double determinant = uu * vv - uv * uv;
  const double a = (vv * nu - uv * nv) / determinant;
  const double b = (uu * nv - uv * nu) / determinant;
  const double change = sum(6) / w - a * mu - b * mv;
  if (!(std::abs(change) < double(MAX_MOVE)))
    return;
  const auto bound = double(MAX_SLOPE);
  out = static_cast<float>(double(d) + change);
  row(next.slope_u, v)[u] = static_cast<float>(std::clamp(a, -bound, bound));
  row(next.slope_v, v)[u] = static_cast<float>(std::clamp(b, -bound, bound));
}

template <int BLOCK>
PCL_SQ_INLINE void moveRowHere(const State& s, int v, int width, State& next) {
  Sums<BLOCK> sums;
  for (int u = 0; u < width; u += BLOCK) {
    sumWindows<BLOCK>(s, v, u, sums);
    for (int k = 0; k < std::min(BLOCK, width - u); ++k)
      solve<BLOCK>(s, v, u + k, sums, k, next);
  }
}

using MoveRow = void(const State& s, int v, int width, State& next);

void moveRow(const State& s, int v, int width, State& next) {
  moveRowHere<8>(s, v, width, next);
}

#if defined(__x86_64__) && defined(__GNUC__)
/** \brief The same in wide registers; not one bit differs, for no sum changes its order
 * and nothing is fused. */
__attribute__((target("avx2"))) void
moveRowAvx2(const State& s, int v, int width, State& next) {
  moveRowHere<8>(s, v, width, next);
}
__attribute__((target("avx512f"))) void
moveRowAvx512(const State& s, int v, int width, State& next) {
  moveRowHere<LARGEST_BLOCK>(s, v, width, next);
}

MoveRow* fastestMoveRow() {
  if (__builtin_cpu_supports("avx512f") != 0)
    return moveRowAvx512;
  return __builtin_cpu_supports("avx2") != 0 ? moveRowAvx2 : moveRow;
}
#else
MoveRow* fastestMoveRow() {
  return moveRow;
}
#endif

} // namespace

void refineDisparity(const cv::Mat& left, const cv::Mat& right, cv::Mat& disparity) {
  cv::Mat l, r;
  left.convertTo(l, CV_32F);
  right.convertTo(r, CV_32F);
  Comparison comparison;
  for (cv::Mat* m :
       {&comparison.difference, &comparison.gradient, &comparison.compared})
    m->create(disparity.size(), CV_32F);
  State now(disparity), next(disparity);
  const auto forEachRow = [&disparity](const auto& work) {
    cv::parallel_for_({0, disparity.rows}, [&work](const cv::Range& rows) {
      for (int v = rows.start; v < rows.end; ++v)
        work(v);
    });
  };
  MoveRow* const move = fastestMoveRow();
  for (int pass = 0; pass < PASSES; ++pass) {
    forEachRow([&](int v) { compareRow(l, r, now, v, comparison); });
    levelOut(comparison);
    forEachRow([&](int v) { lineariseRow(comparison, v, now); });
    forEachRow([&](int v) { move(now, v, disparity.cols, next); });
    std::swap(now.disparity, next.disparity);
    std::swap(now.slope_u, next.slope_u);
    std::swap(now.slope_v, next.slope_v);
  }
  cv::Mat refined =
      now.disparity(cv::Rect(HALF, HALF, disparity.cols, disparity.rows)).clone();
  const cv::Mat moved = cv::abs(refined - disparity);
  refined.setTo(NOTHING, ~(moved < MAX_MOVE));
  disparity = refined;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/segmentation/color_models.h"

#include "stereo/segmentation/minimum_cut.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_sq::detail {
namespace {

constexpr int BINS[] = {24, 10, 8}; // hue, saturation, value
const float HUES[] = {0.0f, 180.0f}, LEVELS[] = {0.0f, 256.0f};
const float* RANGES[] = {HUES, LEVELS, LEVELS};
const int CHANNELS[] = {0, 1, 2};
constexpr int LARGEST_CUT = 220; // longer side of the image that is cut as a whole [px]

/** \brief Relative frequencies, smoothed so that a few samples speak for neighbours. */
cv::Mat histogramOf(const cv::Mat& hsv, const cv::Mat& mask) {
  cv::Mat h;
  cv::calcHist(&hsv, 1, CHANNELS, mask, h, 3, BINS, RANGES);
  const cv::Mat raw = h.clone();
  const auto at = [&](int a, int b, int c) {
    return raw.at<float>((a + BINS[0]) % BINS[0],
                         std::clamp(b, 0, BINS[1] - 1),
                         std::clamp(c, 0, BINS[2] - 1));
  };
  for (int a = 0; a < BINS[0]; ++a)
    for (int b = 0; b < BINS[1]; ++b)
      for (int c = 0; c < BINS[2]; ++c)
        h.at<float>(a, b, c) =
            at(a, b, c) + 0.4f * (at(a - 1, b, c) + at(a + 1, b, c) + at(a, b - 1, c) +
                                  at(a, b + 1, c) + at(a, b, c - 1) + at(a, b, c + 1));
  const double sum = cv::sum(h)[0];
  if (sum > 0.0)
    h /= sum;
  return h;
}

/** \brief A mixture of Gaussians as cv::grabCut gives it: weights, means, covariances.
 */
class ColorMixture {
public:
  explicit ColorMixture(const cv::Mat& model) {
    constexpr int COUNT = 5;
    const auto* weights = model.ptr<double>();
    const double* means = weights + COUNT;
    const double* covariances = means + 3 * COUNT;
    for (int k = 0; k < COUNT; ++k)
      if (weights[k] > 0.0) {
        const cv::Matx33d covariance(covariances + 9 * k);
        parts_.push_back({weights[k] / std::sqrt(cv::determinant(covariance)),
                          cv::Vec3d(means + 3 * k),
                          covariance.inv()});
      }
  }

  double logDensity(const cv::Vec3b& color) const {
    constexpr double LEAST = 1e-300; // of which there is a logarithm
    double sum = LEAST;
    for (const Part& part : parts_) {
      const cv::Vec3d off = cv::Vec3d(color) - part.mean;
      sum += part.height * std::exp(-0.5 * off.dot(part.inverse * off));
    }
    return std::log(sum);
  }

private:
  struct Part {
    double height; ///< of its middle, but for a factor of all
    cv::Vec3d mean;
    cv::Matx33d inverse;
  };
  std::vector<Part> parts_;
};

/** \brief cv::grabCut with models that are known, of the open pixels alone: a pixel
 * that is not open weighs more than all of its neighbours there, too.
 * \param[in] labels GC_BGD ... \return CV_8U mask */
cv::Mat cutBand(const cv::Mat& bgr,
                const cv::Mat& labels,
                const ColorMixture& object,
                const ColorMixture& background) {
  constexpr double TOGETHER = 50.0; // Rother et al. 2004
  constexpr double LEAST = 1e-6;    // of it, which no cut is decided by
  const cv::Mat open = (labels & 2) != 0;
  cv::Mat odds(bgr.size(), CV_32F, cv::Scalar(-1.0));
  odds.setTo(1.0, (labels & 1) != 0);
  const cv::Rect part = cv::boundingRect(open);
  for (int y = part.y; y < part.br().y; ++y)
    for (int x = part.x; x < part.br().x; ++x)
      if (const auto& color = bgr.at<cv::Vec3b>(y, x); open.at<std::uint8_t>(y, x) != 0)
        odds.at<float>(y, x) =
            float(object.logDensity(color) - background.logDensity(color));
  const int w = bgr.cols, h = bgr.rows;
  const double sum = squareDifferences(bgr, {w - 1, h}, {0, 0}, {1, 0}) +
                     squareDifferences(bgr, {w, h - 1}, {0, 0}, {0, 1}) +
                     squareDifferences(bgr, {w - 1, h - 1}, {0, 0}, {1, 1}) +
                     squareDifferences(bgr, {w - 1, h - 1}, {1, 0}, {0, 1});
  const double usual = std::max(1e-3, sum / (4.0 * w * h - 3.0 * (w + h) + 2.0));
  return minimumCut({bgr, usual, TOGETHER, LEAST}, odds, open);
}

} // namespace

cv::Mat smoothHsv(const cv::Mat& bgr) {
  cv::Mat smooth, hsv;
  cv::GaussianBlur(bgr, smooth, {5, 5}, 0.0);
  cv::cvtColor(smooth, hsv, cv::COLOR_BGR2HSV);
  return hsv;
}

cv::Mat
colorProbability(const cv::Mat& bgr, const cv::Mat& object, const cv::Mat& background) {
  return hsvProbability(smoothHsv(bgr), object, background);
}

cv::Mat
hsvProbability(const cv::Mat& hsv, const cv::Mat& object, const cv::Mat& background) {
  cv::Mat ratio, result;
  const cv::Mat inside = histogramOf(hsv, object);
  const cv::Mat outside = histogramOf(hsv, background);
  // a colour that was never seen is background
  ratio = inside / (inside + outside + 1e-6) * 255.0;
  cv::calcBackProject(&hsv, 1, CHANNELS, ratio, result, RANGES);
  cv::GaussianBlur(result, result, {5, 5}, 0.0);
  return result;
}

cv::Mat cleanMask(const cv::Mat& probability) {
  cv::Mat mask = probability > 127;
  const cv::Mat round = cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5});
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, round);
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, round);
  return mask;
}

cv::Mat
cutGraph(const cv::Mat& bgr, const cv::Mat& labels, int iterations, Border border) {
  const int side = std::max(bgr.cols, bgr.rows);
  const bool reduce = side > LARGEST_CUT;
  cv::Mat small = bgr, small_labels = labels.clone(), front, back;
  if (reduce) {
    const double s = static_cast<double>(LARGEST_CUT) / side;
    cv::resize(bgr, small, {}, s, s, cv::INTER_AREA);
    cv::resize(labels, small_labels, small.size(), 0, 0, cv::INTER_NEAREST);
  }
  cv::theRNG().state = 1; // GrabCut's k-means draws from it: same image, same mask
  cv::grabCut(small, small_labels, {}, back, front, iterations, cv::GC_INIT_WITH_MASK);
  cv::Mat mask = (small_labels & 1) * 255;
  if (!reduce)
    return mask;
  // at full size only a band along the border is open
  cv::Mat large, inner, outer;
  cv::resize(mask, large, bgr.size(), 0, 0, cv::INTER_LINEAR);
  large = large > 127;
  if (border == Border::ROUGH)
    return large;
  const int width = 2 * (side / LARGEST_CUT) + 3;
  const cv::Mat band =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * width + 1, 2 * width + 1});
  cv::erode(large, inner, band);
  cv::dilate(large, outer, band);
  cv::Mat full(bgr.size(), CV_8U, cv::Scalar(cv::GC_BGD));
  full.setTo(cv::GC_PR_BGD, outer);
  full.setTo(cv::GC_PR_FGD, large);
  full.setTo(cv::GC_FGD, inner);
  full.setTo(cv::GC_BGD, labels == cv::GC_BGD);
  if (cv::countNonZero(full & 1) == 0 || cv::countNonZero((full & 1) == 0) == 0)
    return large;
  return cutBand(bgr, full, ColorMixture(front), ColorMixture(back));
}

cv::Mat componentAt(const cv::Mat& mask, const cv::Point& place) {
  cv::Mat labels;
  cv::connectedComponents(mask, labels);
  const int label = labels.at<int>(place);
  return label == 0 ? cv::Mat::zeros(mask.size(), CV_8U) : cv::Mat(labels == label);
}

cv::Mat largestComponents(const cv::Mat& mask) {
  cv::Mat labels, stats, centers;
  const int count = cv::connectedComponentsWithStats(mask, labels, stats, centers);
  const auto areaOf = [&](int i) { return stats.at<int>(i, cv::CC_STAT_AREA); };
  const auto boxOf = [&](int i) {
    return cv::Rect(stats.at<int>(i, cv::CC_STAT_LEFT),
                    stats.at<int>(i, cv::CC_STAT_TOP),
                    stats.at<int>(i, cv::CC_STAT_WIDTH),
                    stats.at<int>(i, cv::CC_STAT_HEIGHT));
  };
  cv::Mat result = cv::Mat::zeros(mask.size(), CV_8U);
  int largest = 0;
  for (int i = 1; i < count; ++i)
    if (largest == 0 || areaOf(i) > areaOf(largest))
      largest = i;
  if (largest == 0)
    return result;
  // pieces that a shadow or a label cut off belong to the object too, things of the
  // same colour elsewhere do not
  cv::Rect near = boxOf(largest);
  const cv::Size reach(near.width / 2, near.height / 2);
  near = (near - cv::Point(reach)) + reach + reach;
  for (int i = 1; i < count; ++i)
    if (areaOf(i) >= 0.15 * areaOf(largest) && (boxOf(i) & near).area() > 0)
      result.setTo(255, labels == i);
  return result;
}

void fillSmallHoles(cv::Mat& mask, double share) {
  cv::Mat labels, stats, centers;
  const cv::Mat gaps = mask == 0;
  const int count = cv::connectedComponentsWithStats(gaps, labels, stats, centers, 4);
  const double limit = share * cv::countNonZero(mask);
  for (int i = 1; i < count; ++i)
    if (stats.at<int>(i, cv::CC_STAT_AREA) < limit)
      mask.setTo(255, labels == i);
}

} // namespace pcl_sq::detail

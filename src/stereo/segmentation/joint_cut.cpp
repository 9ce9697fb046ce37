// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/segmentation/joint_cut.h"

#include "stereo/segmentation/color_models.h"
#include "stereo/segmentation/minimum_cut.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {
namespace {

constexpr int LARGEST_JOINT_CUT =
    300; ///< longer side of the image that is cut as a whole [px]
/** \brief Cost of a border between two pixels of one colour, in the unit of ln odds: a
 * pixel of its own has four, and is to be believed where depth and colour agree. */
constexpr double TOGETHER = 2.0;
constexpr float SURE = 1e3F;        ///< odds that nothing outweighs
constexpr float LIKELY = 0.5F;      ///< odds by depth from which colours are learnt
constexpr double MOST_TRUST = 0.98; ///< colours are never sure

/** \brief Colours' odds, and how often they agree with what is known. */
struct Colors {
  cv::Mat odds; ///< CV_32F
  double trust = 0.5;
};

Colors
learnColors(const cv::Mat& hsv, const cv::Mat& object, const cv::Mat& background) {
  Colors colors;
  colors.odds = cv::Mat::zeros(hsv.size(), CV_32F);
  const int inside = cv::countNonZero(object), outside = cv::countNonZero(background);
  if (inside == 0 || outside == 0)
    return colors;
  const cv::Mat p = hsvProbability(hsv, object, background);
  const double right = cv::countNonZero((p > 127) & object) / double(inside);
  const double left = cv::countNonZero((p <= 127) & background) / double(outside);
  colors.trust = std::clamp(0.5 * (right + left), 0.5, MOST_TRUST);
  const double most = std::log(colors.trust / (1.0 - colors.trust));
  cv::Mat odds_of(1, 256, CV_32F);
  for (int value = 0; value < 256; ++value) {
    const double q = std::clamp(value / 255.0, 0.02, 0.98);
    odds_of.at<float>(value) =
        static_cast<float>(std::clamp(std::log(q / (1.0 - q)), -most, most));
  }
  cv::LUT(p, odds_of, colors.odds);
  return colors;
}

/** \brief Pixels whose side is not sure. */
cv::Mat openOf(const cv::Mat& odds) {
  return cv::abs(odds) < 0.5F * SURE;
}

/** \brief What borders between pixels cost in the joint cut. */
Borders bordersOf(const cv::Mat& bgr) {
  constexpr double LEAST = 1e-3; // share of the cost that any border has
  cv::Mat image;
  cv::GaussianBlur(bgr, image, {3, 3}, 0.0);
  const cv::Size size = bgr.size() - cv::Size(1, 1);
  const double sum = squareDifferences(image, size, {0, 0}, {1, 0}) +
                     squareDifferences(image, size, {0, 0}, {0, 1});
  const double usual = std::max(1.0, sum / (2.0 * double(bgr.total())));
  return {image, usual, TOGETHER, LEAST};
}

/** \brief The same where the border is known to a few pixels: only a band along it is
 * open. */
cv::Mat
cutAlong(const cv::Mat& bgr, const cv::Mat& odds, const cv::Mat& mask, int width) {
  const cv::Mat band =
      cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * width + 1, 2 * width + 1});
  cv::Mat inner, outer, fixed = odds.clone();
  cv::erode(mask, inner, band);
  cv::dilate(mask, outer, band);
  fixed.setTo(SURE, inner);
  fixed.setTo(-SURE, outer == 0);
  return minimumCut(bordersOf(bgr), fixed, openOf(fixed));
}

/** \brief What is known of a pixel before its colour is asked. */
struct Known {
  cv::Mat depth_odds;      ///< CV_32F
  cv::Mat outside, beyond; ///< CV_8U, of the box, and so far out that it is surely not
};

/** \brief Odds of depth and of the colours that object and background have. */
cv::Mat jointOdds(const cv::Mat& hsv,
                  const Known& known,
                  const cv::Mat& object,
                  const cv::Mat& background) {
  cv::Mat odds = learnColors(hsv, object, background).odds + known.depth_odds;
  odds.setTo(-1.0F, (known.outside != 0) & (odds > -1.0F));
  odds.setTo(-SURE, known.beyond);
  return odds;
}

/** \brief Colours are learnt from the cut, and cut anew, until they give the same. */
cv::Mat cutInRounds(const cv::Mat& bgr, const Known& known, int rounds) {
  cv::Mat object = (known.depth_odds > LIKELY) & (known.outside == 0);
  cv::Mat background = known.outside | (known.depth_odds < -LIKELY);
  const cv::Mat hsv = smoothHsv(bgr);
  const Borders borders = bordersOf(bgr);
  for (int round = 0; round < rounds; ++round) {
    const cv::Mat odds = jointOdds(hsv, known, object, background);
    const cv::Mat cut = minimumCut(borders, odds, openOf(odds));
    const bool same = round > 0 && cv::countNonZero(cut != object) == 0;
    object = cut;
    if (same)
      break;
    background = object == 0;
  }
  return object;
}

} // namespace

double separability(const cv::Mat& bgr, const cv::Mat& mask) {
  return learnColors(smoothHsv(bgr), mask, mask == 0).trust;
}

cv::Mat cutJointly(const cv::Mat& bgr,
                   const cv::Rect& box,
                   const cv::Mat& depth_odds,
                   int rounds) {
  // boxes are drawn by hand: just outside of them is hardly the object, not surely not
  const int dx = 1 + box.width / 40, dy = 1 + box.height / 40;
  const cv::Rect drawn =
      cv::Rect(box.x - dx, box.y - dy, box.width + 2 * dx, box.height + 2 * dy) &
      cv::Rect(0, 0, bgr.cols, bgr.rows);
  cv::Mat outside(bgr.size(), CV_8U, cv::Scalar(255)), beyond = outside.clone();
  outside(box).setTo(0);
  beyond(drawn).setTo(0);
  const Known known{depth_odds, outside, beyond};
  const int side = std::max(bgr.cols, bgr.rows);
  if (side <= LARGEST_JOINT_CUT)
    return cutInRounds(bgr, known, rounds);
  // the border is found at a reduced size, and drawn at the full one
  const double s = double(LARGEST_JOINT_CUT) / side;
  cv::Mat small, large;
  cv::resize(bgr, small, {}, s, s, cv::INTER_AREA);
  const auto reduced = [&small](const cv::Mat& values) {
    cv::Mat result;
    cv::resize(values, result, small.size(), 0, 0, cv::INTER_NEAREST);
    return result;
  };
  const Known roughly{reduced(depth_odds), reduced(outside), reduced(beyond)};
  cv::resize(
      cutInRounds(small, roughly, rounds), large, bgr.size(), 0, 0, cv::INTER_LINEAR);
  large = large > 127;
  return cutAlong(bgr,
                  jointOdds(smoothHsv(bgr), known, large, large == 0),
                  large,
                  2 * static_cast<int>(std::ceil(1.0 / s)) + 3);
}

} // namespace pcl_sq::detail

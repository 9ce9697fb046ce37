// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/stereo_calibration.h"

#include "stereo/calibration/calibration_checks.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_sq {
namespace {

cv::Mat fourCoefficients(const cv::Mat& d) {
  return d.empty() ? cv::Mat(cv::Mat::zeros(4, 1, CV_64F)) : d.reshape(1, 4);
}

/** \brief Rectification of a pair of fisheyes. */
void rectifyFisheyes(RawStereoCameras& c, const cv::Size& size) {
  cv::Mat Q;
  cv::fisheye::stereoRectify(c.M1,
                             fourCoefficients(c.D1),
                             c.M2,
                             fourCoefficients(c.D2),
                             size,
                             c.R,
                             c.T,
                             c.R1,
                             c.R2,
                             c.P1,
                             c.P2,
                             Q,
                             cv::CALIB_ZERO_DISPARITY,
                             size);
}

/** \brief Whether an image of one size is the other one scaled; sides are whole pixels.
 */
bool sameProportions(const cv::Size& a, const cv::Size& b) {
  const double scale = static_cast<double>(b.width) / a.width;
  return std::abs(a.height * scale - b.height) <= 1.0;
}

} // namespace

cv::Mat rectifyPinholes(RawStereoCameras& c) {
  cv::Mat Q;
  cv::stereoRectify(c.M1,
                    c.D1,
                    c.M2,
                    c.D2,
                    {c.width, c.height},
                    c.R,
                    c.T,
                    c.R1,
                    c.R2,
                    c.P1,
                    c.P2,
                    Q,
                    cv::CALIB_ZERO_DISPARITY,
                    0.0);
  return Q;
}

StereoCalibration StereoCalibration::fromRectified(const StereoIntrinsics& intrinsics) {
  detail::checkIntrinsics(intrinsics);
  StereoCalibration result;
  result.intrinsics_ = intrinsics;
  return result;
}

StereoCalibration StereoCalibration::fromRaw(const RawStereoCameras& cameras) {
  detail::checkCamera(cameras.M1, cameras.D1, cameras.fisheye, "1");
  detail::checkCamera(cameras.M2, cameras.D2, cameras.fisheye, "2");
  const bool has_rectification = !cameras.R1.empty() && !cameras.R2.empty() &&
                                 !cameras.P1.empty() && !cameras.P2.empty();
  StereoCalibration result;
  result.raw_ = cameras;
  if (has_rectification) {
    detail::checkRotation(cameras.R1, "R1");
    detail::checkRotation(cameras.R2, "R2");
    result.intrinsics_ = detail::fromProjections(cameras.P1, cameras.P2);
    result.intrinsics_.width = cameras.width;
    result.intrinsics_.height = cameras.height;
    detail::checkIntrinsics(result.intrinsics_);
    return result;
  }
  detail::checkRotation(cameras.R, "R");
  detail::checkShape(cameras.T, 3, 1, "T");
  const double length = cv::norm(cameras.T);
  if (length == 0.0)
    detail::raiseCalibration(
        "load",
        "the baseline is zero (T = 0), so disparity says nothing about depth; "
        "correct the calibration.");
  if (length < StereoIntrinsics::SMALLEST_BASELINE ||
      length > StereoIntrinsics::LARGEST_BASELINE)
    detail::raiseCalibration(
        "load",
        "the baseline of " + std::to_string(length) +
            " m is not plausible; correct the file's numbers, or give its unit of "
            "length (--calib-unit).");
  const double* t = cameras.T.ptr<double>();
  if (std::abs(t[1]) > std::abs(t[0]))
    detail::raiseCalibration(
        "load",
        "the cameras stand one above the other; turn the images by 90 degrees and "
        "calibrate again.");
  if (t[0] > 0.0)
    detail::raiseCalibration(
        "load",
        "the second camera is left of the first (T points to +x); exchange the two "
        "cameras.");
  if (cameras.width > 0 && cameras.height > 0)
    result.prepareMaps({cameras.width, cameras.height});
  return result;
}

void StereoCalibration::checkImages(const cv::Mat& left, const cv::Mat& right) const {
  if (left.empty() || right.empty())
    detail::raiseCalibration("rectify", "an image is empty; give two images.");
  if (left.size() != right.size())
    detail::raiseCalibration(
        "rectify",
        "the left image is " + detail::sizeText(left.cols, left.rows) +
            " px and the right one " + detail::sizeText(right.cols, right.rows) +
            "; give two images of one size.");
  const int width = isRectified() ? intrinsics_.width : raw_.width;
  const int height = isRectified() ? intrinsics_.height : raw_.height;
  if (width > 0 && height > 0 && !sameProportions({width, height}, left.size()))
    detail::raiseCalibration(
        "rectify",
        "the calibration is for images of " + detail::sizeText(width, height) +
            " px but these are " + detail::sizeText(left.cols, left.rows) +
            " px, of other proportions; use the calibration of this image size.");
  // Without a size in the file the principal point tells: it is near the middle.
  const double cx = isRectified() ? intrinsics_.cx : raw_.M1.at<double>(0, 2);
  const double cy = isRectified() ? intrinsics_.cy : raw_.M1.at<double>(1, 2);
  if ((width == 0 || height == 0) && (cx < 0.25 * left.cols || cx > 0.75 * left.cols ||
                                      cy < 0.25 * left.rows || cy > 0.75 * left.rows))
    detail::raiseCalibration("rectify",
                             "the principal point (" + std::to_string(cx) + ", " +
                                 std::to_string(cy) +
                                 ") is far from the middle of the images of " +
                                 detail::sizeText(left.cols, left.rows) +
                                 " px; use the calibration of this image size.");
}

void StereoCalibration::scaleTo(const cv::Size& size) {
  int& width = isRectified() ? intrinsics_.width : raw_.width;
  int& height = isRectified() ? intrinsics_.height : raw_.height;
  const bool unknown = width == 0 || height == 0;
  if (!unknown && cv::Size(width, height) != size) {
    const double scale = static_cast<double>(size.width) / width;
    notes_.push_back("the calibration is for images of " +
                     detail::sizeText(width, height) +
                     " px; it was scaled to images of " +
                     detail::sizeText(size.width, size.height) + " px");
    // pixel centres lie on integers
    const auto place = [scale](double c) { return (c + 0.5) * scale - 0.5; };
    const auto camera = [&](cv::Mat& m) {
      if (m.empty())
        return;
      cv::Mat scaled = m.clone();
      scaled.rowRange(0, 2) *= scale;
      for (const int row : {0, 1})
        scaled.at<double>(row, 2) = place(m.at<double>(row, 2));
      m = scaled;
    };
    for (cv::Mat* m : {&raw_.M1, &raw_.M2, &raw_.P1, &raw_.P2})
      camera(*m);
    intrinsics_.fx *= scale;
    intrinsics_.fy *= scale;
    intrinsics_.cx = place(intrinsics_.cx);
    intrinsics_.cy = place(intrinsics_.cy);
    intrinsics_.doffs *= scale;
    for (cv::Mat& map : maps_)
      map.release();
  }
  width = size.width;
  height = size.height;
}

void StereoCalibration::prepareMaps(const cv::Size& size) {
  RawStereoCameras& c = raw_;
  if (c.R1.empty() || c.R2.empty() || c.P1.empty() || c.P2.empty()) {
    if (c.fisheye)
      rectifyFisheyes(c, size);
    else
      rectifyPinholes(c);
  }
  intrinsics_ = detail::fromProjections(c.P1, c.P2);
  intrinsics_.width = size.width;
  intrinsics_.height = size.height;
  detail::checkIntrinsics(intrinsics_);
  const auto makeMaps = [&](const cv::Mat& m,
                            const cv::Mat& d,
                            const cv::Mat& r,
                            const cv::Mat& p,
                            cv::Mat* maps) {
    if (c.fisheye)
      cv::fisheye::initUndistortRectifyMap(
          m, fourCoefficients(d), r, p, size, CV_32FC1, maps[0], maps[1]);
    else
      cv::initUndistortRectifyMap(m, d, r, p, size, CV_32FC1, maps[0], maps[1]);
  };
  makeMaps(c.M1, c.D1, c.R1, c.P1, maps_.data());
  makeMaps(c.M2, c.D2, c.R2, c.P2, maps_.data() + 2);
}

void StereoCalibration::rectify(const cv::Mat& left,
                                const cv::Mat& right,
                                cv::Mat& rectified_left,
                                cv::Mat& rectified_right) {
  checkImages(left, right);
  scaleTo(left.size());
  if (isRectified()) {
    rectified_left = left;
    rectified_right = right;
    return;
  }
  try {
    if (maps_[0].empty())
      prepareMaps(left.size());
    cv::remap(left, rectified_left, maps_[0], maps_[1], cv::INTER_LINEAR);
    cv::remap(right, rectified_right, maps_[2], maps_[3], cv::INTER_LINEAR);
  } catch (const cv::Exception&) {
    detail::raiseCalibration("rectify",
                             "the calibration cannot be applied to images of " +
                                 detail::sizeText(left.cols, left.rows) +
                                 " px; calibrate again.");
  }
}

} // namespace pcl_sq

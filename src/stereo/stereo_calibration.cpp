// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/stereo_calibration.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>

namespace pcl_sq {
namespace {

[[noreturn]] void raise(const std::string& method, const std::string& what) {
  throw Exception("[pcl_sq::StereoCalibration::" + method + "] " + what);
}

std::string sizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

void checkShape(const cv::Mat& m, int rows, int cols, const std::string& name) {
  if (m.empty())
    raise("load",
          name + " is missing; give a file that has it (the extrinsics file too?).");
  const bool vector = rows == 3 && cols == 1 && m.total() == 3;
  if ((m.rows != rows || m.cols != cols) && !vector)
    raise("load",
          name + " must be " + sizeText(rows, cols) + " but is " +
              sizeText(m.rows, m.cols) + "; correct the calibration file.");
  if (!cv::checkRange(m))
    raise("load", name + " holds a number that is not finite; calibrate again.");
}

void checkRotation(const cv::Mat& m, const std::string& name) {
  checkShape(m, 3, 3, name);
  const cv::Mat error = m * m.t() - cv::Mat::eye(3, 3, CV_64F);
  if (cv::norm(error) > 1e-3 || cv::determinant(m) < 0.0)
    raise("load", name + " is not a rotation; correct the calibration file.");
}

void checkCamera(const cv::Mat& m, const cv::Mat& d, const std::string& number) {
  checkShape(m, 3, 3, "M" + number);
  if (m.at<double>(0, 0) <= 0.0 || m.at<double>(1, 1) <= 0.0)
    raise("load",
          "the focal length in M" + number +
              " must be positive; correct the calibration file.");
  const std::size_t n = d.total();
  if (n != 0 && n != 4 && n != 5 && n != 8 && n != 12 && n != 14)
    raise("load",
          "D" + number + " has " + std::to_string(n) +
              " coefficients; OpenCV knows 4, 5, 8, 12 or 14.");
  if (n != 0 && !cv::checkRange(d))
    raise("load",
          "D" + number + " holds a number that is not finite; calibrate again.");
}

/** \brief Left camera and baseline of a rectified pair of projections. */
StereoIntrinsics fromProjections(const cv::Mat& P1, const cv::Mat& P2) {
  checkShape(P1, 3, 4, "P1");
  checkShape(P2, 3, 4, "P2");
  const double f = P2.at<double>(0, 0);
  if (std::abs(P2.at<double>(1, 3)) > std::abs(P2.at<double>(0, 3)))
    raise("load",
          "the cameras stand one above the other; turn the images by 90 degrees and "
          "calibrate again.");
  StereoIntrinsics k;
  k.fx = P1.at<double>(0, 0);
  k.fy = P1.at<double>(1, 1);
  k.cx = P1.at<double>(0, 2);
  k.cy = P1.at<double>(1, 2);
  k.baseline = f == 0.0 ? 0.0 : -P2.at<double>(0, 3) / f;
  k.doffs = P2.at<double>(0, 2) - k.cx;
  return k;
}

void checkIntrinsics(const StereoIntrinsics& intrinsics) {
  std::string why;
  if (!intrinsics.isValid(&why))
    raise("load", why + "; correct the calibration.");
}

} // namespace

StereoCalibration StereoCalibration::fromRectified(const StereoIntrinsics& intrinsics) {
  checkIntrinsics(intrinsics);
  StereoCalibration result;
  result.intrinsics_ = intrinsics;
  return result;
}

StereoCalibration StereoCalibration::fromRaw(const RawStereoCameras& cameras) {
  checkCamera(cameras.M1, cameras.D1, "1");
  checkCamera(cameras.M2, cameras.D2, "2");
  const bool has_rectification = !cameras.R1.empty() && !cameras.R2.empty() &&
                                 !cameras.P1.empty() && !cameras.P2.empty();
  StereoCalibration result;
  result.raw_ = cameras;
  if (has_rectification) {
    checkRotation(cameras.R1, "R1");
    checkRotation(cameras.R2, "R2");
    result.intrinsics_ = fromProjections(cameras.P1, cameras.P2);
    result.intrinsics_.width = cameras.width;
    result.intrinsics_.height = cameras.height;
    checkIntrinsics(result.intrinsics_);
    return result;
  }
  checkRotation(cameras.R, "R");
  checkShape(cameras.T, 3, 1, "T");
  const double length = cv::norm(cameras.T);
  if (length == 0.0)
    raise("load",
          "the baseline is zero (T = 0), so disparity says nothing about depth; "
          "correct the calibration.");
  if (length < 1e-3 || length > 10.0)
    raise("load",
          "the baseline of " + std::to_string(length) +
              " m is not plausible; give the file's unit of length.");
  const double* t = cameras.T.ptr<double>();
  if (std::abs(t[1]) > std::abs(t[0]))
    raise("load",
          "the cameras stand one above the other; turn the images by 90 degrees and "
          "calibrate again.");
  if (t[0] > 0.0)
    raise("load",
          "the second camera is left of the first (T points to +x); exchange the two "
          "cameras.");
  if (cameras.width > 0 && cameras.height > 0)
    result.prepareMaps({cameras.width, cameras.height});
  return result;
}

void StereoCalibration::checkImages(const cv::Mat& left, const cv::Mat& right) const {
  if (left.empty() || right.empty())
    raise("rectify", "an image is empty; give two images.");
  if (left.size() != right.size())
    raise("rectify",
          "the left image is " + sizeText(left.cols, left.rows) +
              " px and the right one " + sizeText(right.cols, right.rows) +
              "; give two images of one size.");
  const int width = isRectified() ? intrinsics_.width : raw_.width;
  const int height = isRectified() ? intrinsics_.height : raw_.height;
  if (width > 0 && height > 0 && (width != left.cols || height != left.rows))
    raise("rectify",
          "the calibration is for images of " + sizeText(width, height) +
              " px but these are " + sizeText(left.cols, left.rows) +
              " px; use the calibration of this image size.");
  // Without a size in the file the principal point tells: it is near the middle.
  const double cx = isRectified() ? intrinsics_.cx : raw_.M1.at<double>(0, 2);
  const double cy = isRectified() ? intrinsics_.cy : raw_.M1.at<double>(1, 2);
  if ((width == 0 || height == 0) && (cx < 0.25 * left.cols || cx > 0.75 * left.cols ||
                                      cy < 0.25 * left.rows || cy > 0.75 * left.rows))
    raise("rectify",
          "the principal point (" + std::to_string(cx) + ", " + std::to_string(cy) +
              ") is far from the middle of the images of " +
              sizeText(left.cols, left.rows) +
              " px; use the calibration of this image size.");
}

void StereoCalibration::prepareMaps(const cv::Size& size) {
  RawStereoCameras& c = raw_;
  if (c.R1.empty() || c.R2.empty() || c.P1.empty() || c.P2.empty()) {
    cv::Mat Q;
    // alpha 0: only pixels that both cameras see
    cv::stereoRectify(c.M1,
                      c.D1,
                      c.M2,
                      c.D2,
                      size,
                      c.R,
                      c.T,
                      c.R1,
                      c.R2,
                      c.P1,
                      c.P2,
                      Q,
                      cv::CALIB_ZERO_DISPARITY,
                      0.0);
  }
  intrinsics_ = fromProjections(c.P1, c.P2);
  intrinsics_.width = size.width;
  intrinsics_.height = size.height;
  checkIntrinsics(intrinsics_);
  cv::initUndistortRectifyMap(
      c.M1, c.D1, c.R1, c.P1, size, CV_32FC1, maps_[0], maps_[1]);
  cv::initUndistortRectifyMap(
      c.M2, c.D2, c.R2, c.P2, size, CV_32FC1, maps_[2], maps_[3]);
}

void StereoCalibration::rectify(const cv::Mat& left,
                                const cv::Mat& right,
                                cv::Mat& rectified_left,
                                cv::Mat& rectified_right) {
  checkImages(left, right);
  if (isRectified()) {
    intrinsics_.width = left.cols;
    intrinsics_.height = left.rows;
    rectified_left = left;
    rectified_right = right;
    return;
  }
  if (maps_[0].size() != left.size())
    prepareMaps(left.size());
  cv::remap(left, rectified_left, maps_[0], maps_[1], cv::INTER_LINEAR);
  cv::remap(right, rectified_right, maps_[2], maps_[3], cv::INTER_LINEAR);
}

} // namespace pcl_sq

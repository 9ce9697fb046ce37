// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/calibration/calibration_checks.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

void raiseCalibration(const std::string& method, const std::string& what) {
  throw Exception("[pcl_sq::StereoCalibration::" + method + "] " + what);
}

std::string sizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

void checkShape(const cv::Mat& m, int rows, int cols, const std::string& name) {
  if (m.empty())
    raiseCalibration(
        "load",
        name + " is missing; give a file that has it (the extrinsics file too?).");
  const bool vector = rows == 3 && cols == 1 && m.total() == 3;
  if ((m.rows != rows || m.cols != cols) && !vector)
    raiseCalibration("load",
                     name + " must be " + sizeText(rows, cols) + " but is " +
                         sizeText(m.rows, m.cols) + "; correct the calibration file.");
  if (!cv::checkRange(m))
    raiseCalibration("load",
                     name + " holds a number that is not finite; calibrate again.");
}

void checkRotation(const cv::Mat& m, const std::string& name) {
  checkShape(m, 3, 3, name);
  const cv::Mat error = m * m.t() - cv::Mat::eye(3, 3, CV_64F);
  if (cv::norm(error) > 1e-3 || cv::determinant(m) < 0.0)
    raiseCalibration("load",
                     name + " is not a rotation; correct the calibration file.");
}

void checkCamera(const cv::Mat& m,
                 const cv::Mat& d,
                 bool fisheye,
                 const std::string& number) {
  checkShape(m, 3, 3, "M" + number);
  if (m.at<double>(0, 0) <= 0.0 || m.at<double>(1, 1) <= 0.0)
    raiseCalibration("load",
                     "the focal length in M" + number +
                         " must be positive; correct the calibration file.");
  if (std::abs(m.at<double>(0, 1)) > 0.0)
    raiseCalibration("load",
                     "M" + number + " has a skew of the pixels; calibrate without it.");
  const std::size_t n = d.total();
  if (fisheye && n != 0 && n != 4)
    raiseCalibration("load",
                     "D" + number + " has " + std::to_string(n) +
                         " coefficients; the equidistant (fisheye) model has 4.");
  if (n != 0 && n != 4 && n != 5 && n != 8 && n != 12 && n != 14)
    raiseCalibration("load",
                     "D" + number + " has " + std::to_string(n) +
                         " coefficients; OpenCV knows 4, 5, 8, 12 or 14.");
  if (n != 0 && !cv::checkRange(d))
    raiseCalibration(
        "load", "D" + number + " holds a number that is not finite; calibrate again.");
}

/** \brief Left camera and baseline of a rectified pair of projections; the offset f B
 * may stand in either of them. */
StereoIntrinsics fromProjections(const cv::Mat& P1, const cv::Mat& P2) {
  checkShape(P1, 3, 4, "P1");
  checkShape(P2, 3, 4, "P2");
  const auto entry = [](const cv::Mat& p, int i, int j) { return p.at<double>(i, j); };
  if (!(entry(P1, 0, 0) > 0.0 && entry(P2, 0, 0) > 0.0))
    raiseCalibration(
        "load",
        "the focal lengths in P1 and P2 must be positive; correct the calibration.");
  if (std::abs(entry(P2, 1, 3) - entry(P1, 1, 3)) >
      std::abs(entry(P2, 0, 3) - entry(P1, 0, 3)))
    raiseCalibration(
        "load",
        "the cameras stand one above the other; turn the images by 90 degrees and "
        "calibrate again.");
  // rows of a rectified pair agree to a pixel, or nothing would match
  const double across = std::abs(entry(P1, 1, 2)) / entry(P1, 0, 0);
  if (std::abs(entry(P1, 1, 2) - entry(P2, 1, 2)) > 1.0 ||
      std::abs(entry(P1, 1, 1) - entry(P2, 1, 1)) * std::max(across, 0.5) > 1.0 ||
      std::abs(entry(P1, 0, 0) - entry(P2, 0, 0)) * std::max(across, 0.5) > 1.0)
    raiseCalibration(
        "load",
        "P1 and P2 differ in focal length or row of the principal point, so they are "
        "not those of a rectified pair; give the projections that the stereo "
        "calibration computed, or M1, D1, M2, D2, R, T.");
  StereoIntrinsics k;
  k.fx = entry(P1, 0, 0);
  k.fy = entry(P1, 1, 1);
  k.cx = entry(P1, 0, 2);
  k.cy = entry(P1, 1, 2);
  k.baseline = (entry(P1, 0, 3) - entry(P2, 0, 3)) / entry(P2, 0, 0);
  k.doffs = entry(P2, 0, 2) - k.cx;
  return k;
}

void checkIntrinsics(const StereoIntrinsics& intrinsics) {
  std::string why;
  if (!intrinsics.isValid(&why))
    raiseCalibration("load", why + "; correct the calibration.");
}

} // namespace pcl_sq::detail

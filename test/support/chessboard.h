// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/stereo/stereo_calibration.h"

#include <Eigen/Core>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace pcl_sq::test {

inline double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** \brief Rows of corresponding corners within a quarter of a pixel, distances between
 * neighbouring corners within 1 % of a square, whose side is the unit. */
inline void expectGoodChessboards(const std::string& folder,
                                  StereoCalibration& calibration) {
  int pairs = 0;
  for (const char* number : {"01", "02", "03", "04", "05", "06", "07"}) {
    const cv::Mat l = cv::imread(folder + "left" + number + ".jpg", 0);
    const cv::Mat r = cv::imread(folder + "right" + number + ".jpg", 0);
    cv::Mat left, right;
    calibration.rectify(l, r, left, right);
    std::vector<cv::Point2f> a, b;
    const cv::Size board(9, 6);
    if (!cv::findChessboardCorners(left, board, a) ||
        !cv::findChessboardCorners(right, board, b))
      continue;
    const cv::TermCriteria fine(
        cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 40, 1e-3);
    cv::cornerSubPix(left, a, {5, 5}, {-1, -1}, fine);
    cv::cornerSubPix(right, b, {5, 5}, {-1, -1}, fine);
    const StereoIntrinsics& k = calibration.getIntrinsics();
    std::vector<double> rows, squares;
    std::vector<Eigen::Vector3d> corners;
    for (std::size_t i = 0; i < a.size(); ++i) {
      rows.push_back(std::abs(double(a[i].y) - double(b[i].y)));
      corners.push_back(
          k.backProject(a[i].x, a[i].y, k.depth(double(a[i].x) - double(b[i].x))));
    }
    for (std::size_t i = 0; i + 1 < corners.size(); ++i)
      if (i % 9 != 8)
        squares.push_back((corners[i + 1] - corners[i]).norm());
    EXPECT_LE(medianOf(rows), 0.25) << number;
    EXPECT_NEAR(medianOf(squares), 1.0, 0.01) << number;
    ++pairs;
  }
  EXPECT_GE(pairs, 4);
}

} // namespace pcl_sq::test

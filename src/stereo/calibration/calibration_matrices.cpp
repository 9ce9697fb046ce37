// SPDX-License-Identifier: BSD-3-Clause
// Matrices and numbers by their names: OpenCV's files, ROS camera_info, plain numbers.
#include "stereo/calibration/calibration_values.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

namespace pcl_sq::detail {
namespace {

using M = CalibrationMeaning;
using Named = NamedValues;

void readSize(const Named& named, int& width, int& height) {
  const auto pixels = [](const cv::Mat& m, int i) {
    return m.empty() ? 0 : cv::saturate_cast<int>(m.at<double>(i));
  };
  width = pixels(named.matrix(M::WIDTH), 0);
  height = pixels(named.matrix(M::HEIGHT), 0);
  if (const cv::Mat size = named.matrix(M::SIZE); !size.empty()) {
    width = pixels(size, 0);
    height = pixels(size, 1);
  }
}

bool isZero(const cv::Mat& m) {
  return m.empty() || cv::countNonZero(m) == 0;
}

/** \brief Distortion that would be lost: of a pair that is taken as rectified. */
void refuseLostDistortion(const Named& named) {
  for (const int side : {0, 1, 2})
    if (!isZero(named.matrix(M::DISTORTION, side)))
      raiseLoad(
          named.values.at({M::DISTORTION, side}).name +
          " is given without the camera matrices it belongs to; add them, or leave "
          "it out if the images are rectified.");
  for (const auto& [name, value] : named.numbers)
    if (value != 0.0 && name.size() == 2 && (name[0] == 'k' || name[0] == 'p') &&
        std::isdigit(static_cast<unsigned char>(name[1])))
      raiseLoad(
          "the distortion " + name +
          " is not zero but the file describes a rectified pair; give matrices of "
          "both cameras (M1, D1, M2, D2, R, T), or rectified images.");
  if (named.number({"skew", "s"}) > 0.0)
    raiseLoad("a skew of the pixels is not supported; calibrate without it.");
}

StereoIntrinsics plainNumbers(const Named& named, double unit) {
  StereoIntrinsics k;
  k.fx = named.number({"fx", "f", "focal", "focallength"});
  k.fy = named.number({"fy", "f", "focal", "focallength", "fx"});
  k.cx = named.number({"cx"});
  k.cy = named.number({"cy"});
  if (const cv::Mat m = named.matrix(M::CAMERA_MATRIX); !m.empty()) {
    k.fx = m.at<double>(0, 0);
    k.fy = m.at<double>(1, 1);
    k.cx = m.at<double>(0, 2);
    k.cy = m.at<double>(1, 2);
  }
  k.baseline = unit * named.number({"baseline", "baselinem", "stereob"});
  if (std::isnan(k.baseline)) // ORB-SLAM: fx times baseline
    k.baseline = unit * named.number({"bf", "stereobf"}) / k.fx;
  if (const cv::Mat t = named.matrix(M::TRANSLATION);
      std::isnan(k.baseline) && !t.empty())
    k.baseline = -unit * t.at<double>(0);
  const double doffs = named.number({"doffs"});
  k.doffs = std::isnan(doffs) ? 0.0 : doffs;
  return k;
}

/** \brief A file that tells its baseline twice tells the same: which of two is right
 * nobody knows, and depth is proportional to it. */
void refuseContradictions(const Named& named, double unit, const RawStereoCameras& c) {
  constexpr double ROUNDING = 0.02; // of figures that people copy
  std::vector<std::pair<std::string, double>> baselines;
  const auto add = [&](const std::string& name, double baseline) {
    if (std::isfinite(baseline) && baseline != 0.0)
      baselines.emplace_back(name, std::abs(baseline));
  };
  const auto nameOf = [&](M meaning, int side) {
    return named.values.at({meaning, side}).name;
  };
  if (const cv::Mat t = named.matrix(M::TRANSLATION); !t.empty())
    add(nameOf(M::TRANSLATION, 0), unit * cv::norm(t));
  if (!c.P1.empty() && !c.P2.empty()) {
    const cv::Mat offset = c.P1.rowRange(0, 2).col(3) - c.P2.rowRange(0, 2).col(3);
    add(nameOf(M::PROJECTION, 2), cv::norm(offset) / c.P2.at<double>(0, 0));
  }
  if (const cv::Mat q = named.matrix(M::REPROJECTION); !q.empty())
    add(nameOf(M::REPROJECTION, 0), unit / q.at<double>(3, 2));
  add("baseline", unit * named.number({"baseline", "stereob"}));
  add("baseline_m", named.number({"baselinem"}));
  add("bf / fx", unit * named.number({"bf", "stereobf"}) / named.number({"fx"}));
  for (const auto& [name, baseline] : baselines)
    if (std::abs(baseline - baselines[0].second) >
        ROUNDING * std::max(baseline, baselines[0].second)) {
      char text[300];
      std::snprintf(text,
                    sizeof(text),
                    "%.40s says that the baseline is %.6g m, but %.40s says %.6g m; "
                    "correct the calibration, or leave the wrong one out.",
                    baselines[0].first.c_str(),
                    baselines[0].second,
                    name.c_str(),
                    baseline);
      raiseLoad(text);
    }
}

/** \brief From Q: X = u - cx, Y = v - cy, Z = f, W = (d + doffs) / B. */
StereoIntrinsics fromReprojection(const cv::Mat& q, double unit) {
  StereoIntrinsics k;
  k.fx = k.fy = q.at<double>(2, 3);
  k.cx = -q.at<double>(0, 3);
  k.cy = -q.at<double>(1, 3);
  k.baseline = unit / q.at<double>(3, 2);
  k.doffs = q.at<double>(3, 3) / q.at<double>(3, 2);
  return k;
}

void readRaw(const Named& named, double unit, CalibrationContents& contents) {
  RawStereoCameras& c = contents.cameras;
  c.M1 = named.matrix(M::CAMERA_MATRIX, 1);
  c.M2 = named.matrix(M::CAMERA_MATRIX, 2);
  c.D1 = named.matrix(M::DISTORTION, 1);
  c.D2 = named.matrix(M::DISTORTION, 2);
  if (!isZero(named.matrix(M::DISTORTION)))
    raiseLoad(named.values.at({M::DISTORTION, 0}).name +
              " does not say which camera it is of; name it D1 or D2.");
  if (c.D1.empty() && c.D2.empty())
    contents.notes.push_back(
        "the calibration has no distortion; the lenses are taken as free of it");
  c.R = named.matrix(M::ROTATION);
  c.T = named.matrix(M::TRANSLATION);
  if (!c.T.empty()) {
    c.T *= unit;
    const bool rectified = !named.matrix(M::RECTIFICATION, 1).empty();
    if (c.R.empty() && !rectified) {
      c.R = cv::Mat::eye(3, 3, CV_64F);
      contents.notes.push_back(
          "the calibration has T but no R; the cameras are taken as "
          "parallel");
    }
  }
  c.R1 = named.matrix(M::RECTIFICATION, 1);
  c.R2 = named.matrix(M::RECTIFICATION, 2);
  contents.raw = true;
}

} // namespace

void readNamed(const CalibrationDocuments& documents,
               double unit,
               CalibrationContents& contents) {
  const CalibrationDocument document = joined(documents);
  const Named named = understand(document);
  RawStereoCameras& c = contents.cameras;
  for (const auto& [key, value] : named.values)
    if (key.first == M::LENS_MODEL)
      setLens(value.text, contents);
  for (const std::string& lens : named.lenses)
    setLens(lens, contents);
  if (const double flag = named.number({"fisheye", "isfisheye"}); flag > 0.0)
    c.fisheye = true;
  if (const double xi = named.number({"xi", "xi1", "xi2"}); std::abs(xi) > 0.0)
    raiseLoad("the file has xi: omnidirectional cameras are not supported; calibrate "
              "with the fisheye (equidistant) model.");
  readSize(named, c.width, c.height);
  for (const int side : {1, 2})
    if (cv::Mat p = named.matrix(M::PROJECTION, side); !p.empty()) {
      p.col(3) *= unit;
      (side == 1 ? c.P1 : c.P2) = p;
    }
  refuseContradictions(named, unit, c);
  if (!named.matrix(M::CAMERA_MATRIX, 1).empty() ||
      !named.matrix(M::CAMERA_MATRIX, 2).empty()) {
    readRaw(named, unit, contents);
    return;
  }
  refuseLostDistortion(named);
  StereoIntrinsics& k = contents.intrinsics;
  const cv::Mat q = named.matrix(M::REPROJECTION);
  if (!c.P1.empty() && !c.P2.empty()) {
    // a rectified pair described by the projections of its two cameras
    RawStereoCameras ideal = c;
    ideal.fisheye = false;
    ideal.M1 = c.P1.colRange(0, 3).clone();
    ideal.M2 = c.P2.colRange(0, 3).clone();
    ideal.R1 = ideal.R2 = cv::Mat::eye(3, 3, CV_64F);
    k = StereoCalibration::fromRaw(ideal).getIntrinsics();
  } else if (!q.empty())
    k = fromReprojection(q, unit);
  else
    k = plainNumbers(named, unit);
  if (std::isnan(k.fx + k.fy + k.cx + k.cy)) {
    std::string found;
    for (const auto& [path, entry] : document.entries)
      if (found.size() < 60)
        found += (found.empty() ? "" : ", ") + path;
    raiseLoad(
        "'" + document.file +
        "' has neither M1 D1 M2 D2 R T nor P1 P2 nor f, cx, cy, baseline (it has " +
        found +
        "); give a calibration file, two when intrinsics and extrinsics "
        "or left and right are apart.");
  }
  if (std::isnan(k.baseline))
    raiseLoad("baseline is missing or not a number; add it to the calibration file.");
  k.width = c.width;
  k.height = c.height;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/stereo/stereo_calibration.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include <map>
#include <string>
#include <vector>

namespace pcl_sq::test {

/** \brief A raw rig as its makers' programs would describe it, in every format. */
struct Rig {
  cv::Mat K1 = (cv::Mat_<double>(3, 3) << 402, 0, 203, 0, 401, 148, 0, 0, 1);
  cv::Mat K2 = (cv::Mat_<double>(3, 3) << 399, 0, 196, 0, 398.5, 151, 0, 0, 1);
  cv::Mat D1 = (cv::Mat_<double>(1, 4) << -0.21, 0.06, 0.001, -0.0004);
  cv::Mat D2 = (cv::Mat_<double>(1, 4) << -0.19, 0.05, -0.0007, 0.0006);
  cv::Mat R, T = (cv::Mat_<double>(3, 1) << -0.08, 0.0011, -0.0007);
  cv::Mat R1, R2, P1, P2, Q;
  cv::Size size{400, 300};

  Rig() {
    cv::Rodrigues(cv::Vec3d(0.004, -0.011, 0.006), R);
    cv::stereoRectify(
        K1, D1, K2, D2, size, R, T, R1, R2, P1, P2, Q, cv::CALIB_ZERO_DISPARITY, 0.0);
  }

  using Files = std::vector<CalibrationText>;

  /** \brief All formats of the raw pair, by name. */
  std::map<std::string, Files> formats() const {
    return {
        {"OpenCV YAML", {{"c.yml", openCv(".yml")}}},
        {"OpenCV XML", {{"c.xml", openCv(".xml")}}},
        {"OpenCV JSON", {{"c.json", openCv(".json")}}},
        {"YAML of lists", {{"c.yaml", lists("K1", "K2", "D1", "D2", "R", "T")}}},
        {"YAML by side",
         {{"c.yaml",
           lists("camera_matrix_left",
                 "camera_matrix_right",
                 "distortion_left",
                 "distortion_right",
                 "rotation",
                 "translation")}}},
        {"YAML counted from 0", {{"c.yaml", lists("K0", "K1", "D0", "D1", "R", "T")}}},
        {"nested YAML", {{"c.yaml", nested()}}},
        {"ROS camera_info",
         {{"left.yaml", cameraInfo(K1, D1, R1, P1)},
          {"right.yaml", cameraInfo(K2, D2, R2, P2)}}},
        {"ROS messages",
         {{"left.yaml", message(K1, D1, R1, P1)},
          {"right.yaml", message(K2, D2, R2, P2)}}},
        {"Kalibr", {{"camchain.yaml", kalibr()}}},
        {"EuRoC",
         {{"cam0.yaml", euroc(K1, D1, false)}, {"cam1.yaml", euroc(K2, D2, true)}}},
        {"ZED", {{"SN1.conf", zed()}}}};
  }

  /** \brief A number list with all digits, "a, b, c". */
  static std::string list(const cv::Mat& m) {
    std::string text;
    for (int i = 0; i < m.rows; ++i)
      for (int j = 0; j < m.cols; ++j)
        text += (text.empty() ? "" : ", ") + number(m.at<double>(i, j));
    return text;
  }
  static std::string number(double x) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", x);
    return text;
  }
  std::string openCv(const std::string& ending) const {
    cv::FileStorage out(ending, cv::FileStorage::WRITE | cv::FileStorage::MEMORY);
    out << "image_width" << size.width << "image_height" << size.height;
    out << "M1" << K1 << "D1" << D1 << "M2" << K2 << "D2" << D2 << "R" << R << "T" << T;
    return out.releaseAndGetString();
  }
  std::string lists(const std::string& k1,
                    const std::string& k2,
                    const std::string& d1,
                    const std::string& d2,
                    const std::string& r,
                    const std::string& t) const {
    return "image_size: [400, 300]\n" + k1 + ": [" + list(K1) + "]\n" + k2 + ": [" +
           list(K2) + "]\n" + d1 + ": [" + list(D1) + "]\n" + d2 + ": [" + list(D2) +
           "]\n" + r + ": [" + list(R) + "]\n" + t + ": [" + list(T) + "]\n";
  }
  std::string nested() const {
    return "width: 400\nheight: 300\nleft:\n  K: [" + list(K1) + "]\n  D: [" +
           list(D1) + "]\nright:\n  K: [" + list(K2) + "]\n  D: [" + list(D2) +
           "]\nR: [" + list(R) + "]\nT: [" + list(T) + "]\n";
  }
  std::string cameraInfo(const cv::Mat& k,
                         const cv::Mat& d,
                         const cv::Mat& r,
                         const cv::Mat& p) const {
    return "image_width: 400\nimage_height: 300\ncamera_name: any\ncamera_matrix:\n"
           "  rows: 3\n  cols: 3\n  data: [" +
           list(k) +
           "]\ndistortion_model: plumb_bob\ndistortion_coefficients:\n  rows: 1\n"
           "  cols: 5\n  data: [" +
           list(d) + ", 0]\nrectification_matrix:\n  rows: 3\n  cols: 3\n  data: [" +
           list(r) + "]\nprojection_matrix:\n  rows: 3\n  cols: 4\n  data: [" +
           list(p) + "]\n";
  }
  std::string message(const cv::Mat& k,
                      const cv::Mat& d,
                      const cv::Mat& r,
                      const cv::Mat& p) const {
    return "header:\n  frame_id: camera\nheight: 300\nwidth: 400\n"
           "distortion_model: plumb_bob\nd: [" +
           list(d) + ", 0]\nk: [" + list(k) + "]\nr: [" + list(r) + "]\np: [" +
           list(p) +
           "]\nbinning_x: 0\nbinning_y: 0\nroi:\n  x_offset: 0\n  y_offset: 0\n"
           "  height: 0\n  width: 0\n  do_rectify: false\n---\n";
  }
  static std::string intrinsics(const cv::Mat& k) {
    return number(k.at<double>(0, 0)) + ", " + number(k.at<double>(1, 1)) + ", " +
           number(k.at<double>(0, 2)) + ", " + number(k.at<double>(1, 2));
  }
  /** \brief From the left camera to the right one, 4 x 4. */
  cv::Mat motion() const {
    cv::Mat m = cv::Mat::eye(4, 4, CV_64F);
    R.copyTo(m(cv::Rect(0, 0, 3, 3)));
    T.copyTo(m(cv::Rect(3, 0, 1, 3)));
    return m;
  }
  std::string kalibr(const std::string& model = "radtan") const {
    const auto camera = [&](const cv::Mat& k, const cv::Mat& d) {
      return "  camera_model: pinhole\n  distortion_coeffs: [" + list(d) +
             "]\n  distortion_model: " + model + "\n  intrinsics: [" + intrinsics(k) +
             "]\n  resolution: [400, 300]\n  rostopic: /cam/image_raw\n";
    };
    std::string rows;
    for (int i = 0; i < 4; ++i)
      rows += "  - [" + list(motion().row(i)) + "]\n";
    return "cam0:\n  cam_overlaps: [1]\n" + camera(K1, D1) + "cam1:\n  T_cn_cnm1:\n" +
           rows + "  cam_overlaps: [0]\n" + camera(K2, D2);
  }
  std::string euroc(const cv::Mat& k, const cv::Mat& d, bool right) const {
    cv::Mat body = cv::Mat::eye(4, 4, CV_64F); // some place on the body
    body.at<double>(0, 3) = 0.02;
    const cv::Mat place = right ? cv::Mat(body * motion().inv()) : body;
    return "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [" + list(place) +
           "]\nrate_hz: 20\nresolution: [400, 300]\ncamera_model: pinhole\n"
           "intrinsics: [" +
           intrinsics(k) +
           "]\ndistortion_model: radial-tangential\ndistortion_coefficients: [" +
           list(d) + "]\n";
  }
  std::string zed() const {
    const auto camera = [](const cv::Mat& k, const cv::Mat& d) {
      const auto line = [](const std::string& name, double x) {
        return name + "=" + number(x) + "\n";
      };
      return line("fx", k.at<double>(0, 0)) + line("fy", k.at<double>(1, 1)) +
             line("cx", k.at<double>(0, 2)) + line("cy", k.at<double>(1, 2)) +
             line("k1", d.at<double>(0)) + line("k2", d.at<double>(1)) +
             line("p1", d.at<double>(2)) + line("p2", d.at<double>(3)) + line("k3", 0);
    };
    cv::Mat turn;
    cv::Rodrigues(R, turn);
    return "[LEFT_CAM_HD]\nfx=1\nfy=1\ncx=1\ncy=1\n\n[RIGHT_CAM_HD]\nfx=1\nfy=1\ncx=1\n"
           "cy=1\n\n[LEFT_CAM_VGA]\n" +
           camera(K1, D1) + "\n[RIGHT_CAM_VGA]\n" + camera(K2, D2) +
           "\n[STEREO]\nBaseline=" + number(-1e3 * T.at<double>(0)) +
           "\nTY=" + number(1e3 * T.at<double>(1)) +
           "\nTZ=" + number(1e3 * T.at<double>(2)) +
           "\nCV_VGA=" + number(turn.at<double>(1)) +
           "\nRX_VGA=" + number(turn.at<double>(0)) +
           "\nRZ_VGA=" + number(turn.at<double>(2)) + "\nCV_HD=0\nRX_HD=0\nRZ_HD=0\n";
  }
};

} // namespace pcl_sq::test

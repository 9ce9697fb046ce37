// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/stereo_calibration.h"

#include <opencv2/core.hpp>

#include <cmath>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <map>
#include <sstream>

namespace pcl_sq {
namespace {

/** \brief What a file may say; numbers are NaN and matrices empty where it does not. */
struct Contents {
  std::map<std::string, double> numbers;
  std::map<std::string, cv::Mat> matrices;
  bool middlebury = false;

  double number(std::initializer_list<const char*> names) const {
    for (const char* name : names)
      if (const auto it = numbers.find(name); it != numbers.end())
        return it->second;
    return std::numeric_limits<double>::quiet_NaN();
  }
  cv::Mat matrix(std::initializer_list<const char*> names) const {
    for (const char* name : names)
      if (const auto it = matrices.find(name); it != matrices.end())
        return it->second;
    return {};
  }
};

[[noreturn]] void raise(const std::string& what) {
  throw Exception("[pcl_sq::StereoCalibration::load] " + what);
}

std::string firstBytes(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    raise("cannot read '" + file + "'; check the name and the permissions.");
  std::string head(5, '\0');
  in.read(head.data(), 5);
  return head.substr(0, static_cast<std::size_t>(in.gcount()));
}

void readOpenCv(const std::string& file, Contents& contents) {
  try {
    const cv::FileStorage storage(file, cv::FileStorage::READ);
    const cv::FileNode root = storage.root();
    for (const cv::FileNode& node : root) {
      if (node.isMap()) {
        cv::Mat m;
        node >> m;
        m.convertTo(m, CV_64F);
        contents.matrices[node.name()] = m;
      } else if (node.isReal() || node.isInt())
        contents.numbers[node.name()] = static_cast<double>(node);
    }
  } catch (const cv::Exception& e) {
    raise("'" + file + "' is not a valid OpenCV file (" + e.err + "); write it again.");
  }
}

/** \brief Value of "name = value"; matrices as [a b c; d e f; g h i]. */
void readLine(const std::string& name, std::string value, Contents& contents) {
  const bool matrix = value.find('[') != std::string::npos;
  for (char& c : value)
    if (c == '[' || c == ']' || c == ';' || c == ',')
      c = ' ';
  std::istringstream in(value);
  std::vector<double> numbers;
  for (std::string word; in >> word;) {
    std::size_t used = 0;
    double number = 0.0;
    try {
      number = std::stod(word, &used);
    } catch (const std::exception&) {
      used = 0;
    }
    if (used != word.size())
      raise("'" + word + "' in the line of " + name +
            " is not a number; correct the calibration file.");
    numbers.push_back(number);
  }
  if (matrix && numbers.size() == 9)
    contents.matrices[name] = cv::Mat(numbers, true).reshape(1, 3);
  else if (!matrix && numbers.size() == 1)
    contents.numbers[name] = numbers.front();
  else
    raise("the line of " + name +
          " is neither a number nor a 3 x 3 matrix; correct the calibration file.");
}

void readText(const std::string& file, Contents& contents) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t equals = line.find_first_of("=:");
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#')
      continue;
    if (equals == std::string::npos)
      raise("'" + file +
            "' is neither OpenCV YAML, XML or JSON nor lines of name=value" +
            "; see the documentation of StereoCalibration for the formats.");
    const std::size_t end = line.find_last_not_of(" \t", equals - 1);
    readLine(line.substr(begin, end - begin + 1), line.substr(equals + 1), contents);
  }
  contents.middlebury = contents.matrices.count("cam0") != 0;
}

int pixels(double value) {
  return std::isnan(value) ? 0 : static_cast<int>(std::lround(value));
}

StereoIntrinsics plainIntrinsics(const Contents& c, double unit) {
  StereoIntrinsics k;
  k.width = pixels(c.number({"image_width", "width"}));
  k.height = pixels(c.number({"image_height", "height"}));
  k.baseline = c.number({"baseline", "baseline_m"});
  const double doffs = c.number({"doffs"});
  k.doffs = std::isnan(doffs) ? 0.0 : doffs;
  if (c.middlebury) {
    const cv::Mat cam0 = c.matrix({"cam0"});
    k.fx = cam0.at<double>(0, 0);
    k.fy = cam0.at<double>(1, 1);
    k.cx = cam0.at<double>(0, 2);
    k.cy = cam0.at<double>(1, 2);
    const cv::Mat cam1 = c.matrix({"cam1"});
    if (std::isnan(doffs) && !cam1.empty())
      k.doffs = cam1.at<double>(0, 2) - k.cx;
    k.baseline *= 1e-3;
  } else {
    k.fx = c.number({"fx", "f"});
    k.fy = c.number({"fy", "f", "fx"});
    k.cx = c.number({"cx"});
    k.cy = c.number({"cy"});
    k.baseline *= unit;
  }
  return k;
}

} // namespace

StereoCalibration StereoCalibration::load(const std::vector<std::string>& files,
                                          double unit) {
  if (files.empty())
    raise("no file was given; give one or two calibration files.");
  if (!(unit > 0.0) || !std::isfinite(unit))
    raise("the unit of length must be a positive number of metres.");
  Contents c;
  for (const std::string& file : files) {
    const std::string head = firstBytes(file);
    if (head.rfind("%YAML", 0) == 0 || head.rfind("<?xml", 0) == 0 ||
        head.rfind('{', 0) == 0)
      readOpenCv(file, c);
    else
      readText(file, c);
  }
  RawStereoCameras raw;
  raw.M1 = c.matrix({"M1", "K1", "cameraMatrix1"});
  raw.D1 = c.matrix({"D1", "distCoeffs1"});
  raw.M2 = c.matrix({"M2", "K2", "cameraMatrix2"});
  raw.D2 = c.matrix({"D2", "distCoeffs2"});
  raw.P1 = c.matrix({"P1"});
  raw.P2 = c.matrix({"P2"}).clone();
  raw.width = pixels(c.number({"image_width", "width"}));
  raw.height = pixels(c.number({"image_height", "height"}));
  for (const cv::Mat* projection : {&raw.P1, &raw.P2})
    if (!projection->empty() && (projection->rows != 3 || projection->cols != 4))
      raise("P1 and P2 must be 3 x 4; correct the calibration file.");
  if (!raw.P2.empty())
    raw.P2.at<double>(0, 3) *= unit;
  if (!raw.M1.empty() || !raw.M2.empty()) {
    raw.R = c.matrix({"R"});
    raw.T = c.matrix({"T"}).clone();
    if (!raw.T.empty())
      raw.T *= unit;
    raw.R1 = c.matrix({"R1"});
    raw.R2 = c.matrix({"R2"});
    return fromRaw(raw);
  }
  StereoIntrinsics k;
  if (!raw.P1.empty() && !raw.P2.empty()) {
    // a rectified pair described by the projections of its two cameras
    RawStereoCameras ideal = raw;
    ideal.M1 = raw.P1.colRange(0, 3).clone();
    ideal.M2 = raw.P2.colRange(0, 3).clone();
    ideal.R1 = ideal.R2 = cv::Mat::eye(3, 3, CV_64F);
    k = fromRaw(ideal).getIntrinsics();
  } else
    k = plainIntrinsics(c, unit);
  if (std::isnan(k.fx + k.fy + k.cx + k.cy))
    raise("'" + files.front() +
          "' has neither M1 D1 M2 D2 R T nor P1 P2 nor f, cx, cy, baseline; give a "
          "calibration file (two when intrinsics and extrinsics are apart).");
  if (std::isnan(k.baseline))
    raise("baseline is missing or not a number; add it to the calibration file.");
  return fromRectified(k);
}

} // namespace pcl_sq

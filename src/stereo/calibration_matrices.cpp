// SPDX-License-Identifier: BSD-3-Clause
// Matrices and numbers by their names: OpenCV's files, ROS camera_info, plain numbers.
#include "stereo/calibration_formats.h"
#include "stereo/calibration_names.h"

#include <opencv2/calib3d.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace pcl_sq::detail {
namespace {

using M = CalibrationMeaning;
constexpr double NOT_GIVEN = std::numeric_limits<double>::quiet_NaN();

/** \brief What was understood, by meaning and side (0: of the pair). */
struct Named {
  struct Value {
    std::string name;
    cv::Mat matrix;
    std::string text;
  };
  std::map<std::pair<M, int>, Value> values;
  std::map<std::string, double> numbers; ///< plain numbers by plainName()

  cv::Mat matrix(M meaning, int side = 0) const {
    const auto it = values.find({meaning, side});
    return it == values.end() ? cv::Mat() : it->second.matrix;
  }
  double number(std::initializer_list<const char*> names) const {
    for (const char* name : names)
      if (const auto it = numbers.find(name); it != numbers.end())
        return it->second;
    return NOT_GIVEN;
  }
  void add(M meaning, int side, Value value) {
    const auto [it, is_new] = values.emplace(std::make_pair(meaning, side), value);
    const Value& old = it->second;
    if (is_new || (old.text == value.text && old.matrix.size() == value.matrix.size() &&
                   (old.matrix.empty() ||
                    cv::norm(old.matrix, value.matrix, cv::NORM_INF) == 0.0)))
      return;
    raiseLoad(old.name + " and " + value.name +
              " contradict each other, or there are more than two cameras; leave what "
              "belongs to the pair alone in the file.");
  }
};

/** \brief The entry as the matrix that its meaning asks for; empty for a plain number
 * of the same name (k1 of a lens is none of a camera). */
cv::Mat matrixFor(M meaning, const CalibrationEntry& entry, const std::string& name) {
  const std::size_t count = entry.numbers.size();
  switch (meaning) {
  case M::CAMERA_MATRIX:
    if (count == 4 && (entry.rows == 1 || entry.cols == 1))
      return cameraMatrix(
          entry.numbers[0], entry.numbers[1], entry.numbers[2], entry.numbers[3]);
    return matrixOf(entry, name, 3, 3);
  case M::RECTIFICATION:
    return matrixOf(entry, name, 3, 3);
  case M::PROJECTION:
    return matrixOf(entry, name, 3, 4);
  case M::TRANSLATION:
    return matrixOf(entry, name, 3, 1);
  case M::REPROJECTION:
    return matrixOf(entry, name, 4, 4);
  case M::SIZE:
    return matrixOf(entry, name, 1, 2);
  case M::ROTATION:
    if (count == 3) {
      cv::Mat rotation;
      cv::Rodrigues(matrixOf(entry, name, 3, 1), rotation);
      return rotation;
    }
    return matrixOf(entry, name, 3, 3);
  default:
    return entry.matrix().empty() ? cv::Mat() : entry.matrix().reshape(1, 1);
  }
}

bool isMatrixLike(M meaning) {
  return meaning != M::UNKNOWN && meaning != M::HARMLESS && meaning != M::LENS_MODEL &&
         meaning != M::WIDTH && meaning != M::HEIGHT;
}

/** \brief A name for a message: as the file spells it. */
void addEntry(const std::string& path,
              const CalibrationEntry& entry,
              bool from_zero,
              Named& named) {
  CalibrationName name = understandName(path);
  if (from_zero && name.side != 0 && !name.from_zero)
    name.side = 2; // K0 and K1
  std::string plain = plainName(path);
  if (entry.numbers.size() == 1 && name.meaning != M::DISTORTION &&
      name.meaning != M::WIDTH && name.meaning != M::HEIGHT) {
    for (const char* prefix : {"camera", "cam"}) // Camera.fx
      if (plain.rfind(prefix, 0) == 0 && plain.size() > std::string(prefix).size())
        plain = plain.substr(std::string(prefix).size());
    named.numbers.emplace(plain, entry.numbers[0]);
    return;
  }
  if (name.meaning == M::LENS_MODEL)
    named.add(name.meaning, name.side, {path, {}, entry.text});
  else if (name.meaning == M::WIDTH || name.meaning == M::HEIGHT)
    named.add(
        name.meaning, 0, {path, cv::Mat(1, 1, CV_64F, numberOf(entry, path)), {}});
  else if (isMatrixLike(name.meaning)) {
    const int side = name.meaning == M::SIZE ? 0 : name.side;
    named.add(name.meaning, side, {path, matrixFor(name.meaning, entry, path), {}});
  } else if (name.meaning == M::UNKNOWN) {
    // "model: fisheye", but not "model: OAK-D"
    if (plain.find("model") != std::string::npos &&
        understandLens(entry.text) == LensName::FISHEYE)
      named.add(M::LENS_MODEL, name.side, {path, {}, entry.text});
    const bool camera_like = entry.rows >= 3 && entry.cols >= 3 && entry.cols <= 4;
    const bool lens_like =
        (plain.find("dist") != std::string::npos || plain.rfind("xi", 0) == 0) &&
        !entry.numbers.empty();
    if (camera_like || lens_like)
      raiseLoad(
          "'" + path + "' (" + std::to_string(entry.rows) + " x " +
          std::to_string(entry.cols) +
          ") is not understood; name it as OpenCV does (M1, D1, M2, D2, R, T, R1, "
          "R2, P1, P2), or leave it out if it is not needed.");
  }
}

/** \brief Whether a document is one camera's (ROS camera_info): K and P without a side.
 */
bool isOneCamera(const CalibrationDocument& d) {
  bool camera = false, projection = false;
  for (const auto& [path, entry] : d.entries) {
    const std::string plain = plainName(path);
    camera = camera ||
             ((plain == "k" || plain == "cameramatrix") && entry.numbers.size() == 9);
    projection = projection || ((plain == "p" || plain == "projectionmatrix") &&
                                entry.numbers.size() == 12);
  }
  return camera && projection;
}

/** \brief What ROS cuts out of or joins in an image before it is published. */
void refuseCrops(const CalibrationDocument& d) {
  for (const auto& [path, entry] : d.entries) {
    const bool binning = path == "binning_x" || path == "binning_y";
    const bool offset = path == "roi/x_offset" || path == "roi/y_offset";
    if ((binning || offset) && !entry.numbers.empty() &&
        entry.numbers[0] > (binning ? 1.0 : 0.0))
      raiseLoad("'" + d.file + "' sets " + path +
                ": images that are cropped or binned by the driver are not supported; "
                "give whole images and their calibration.");
  }
}

/** \brief All documents as one; of two cameras' files the first is the left one. */
CalibrationDocument joined(const CalibrationDocuments& documents) {
  std::size_t cameras = 0;
  for (const CalibrationDocument& d : documents)
    cameras += isOneCamera(d);
  if (cameras > 0 && (cameras != 2 || documents.size() != 2))
    raiseLoad(
        "'" + documents[0].file +
        "' describes one camera; give the files of both, the left one first, or K "
        "and the baseline (--intrinsics and --baseline).");
  CalibrationDocument all{documents[0].file, {}};
  for (std::size_t i = 0; i < documents.size(); ++i) {
    if (cameras > 0)
      refuseCrops(documents[i]);
    const char* prefix = cameras == 0 ? "" : i == 0 ? "left/" : "right/";
    for (const auto& [path, entry] : documents[i].entries) {
      const CalibrationEntry* old = all.find(prefix + path);
      if (old == nullptr)
        all.add(prefix + path, entry);
      else if (old->text != entry.text || old->numbers != entry.numbers)
        raiseLoad("the two files contradict each other about " + path +
                  "; give files of one calibration.");
    }
  }
  return all;
}

Named understand(const CalibrationDocument& document) {
  bool from_zero = false;
  for (const auto& [path, entry] : document.entries) {
    const CalibrationName name = understandName(path);
    from_zero = from_zero || (name.from_zero && entry.numbers.size() > 1);
  }
  Named named;
  for (const auto& [path, entry] : document.entries)
    addEntry(path, entry, from_zero, named);
  return named;
}

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

// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/calibration/calibration_values.h"

#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <limits>

namespace pcl_sq::detail {
namespace {

using M = CalibrationMeaning;

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

bool holds(const std::string& text, std::initializer_list<const char*> parts) {
  return std::any_of(parts.begin(), parts.end(), [&](const char* part) {
    return text.find(part) != std::string::npos;
  });
}

/** \brief The lens that an entry names under any name, for a fisheye that is read as a
 * pinhole bends every line: "lens: equidistant", "calibration/type: fisheye", "fisheye:
 * true". Names of things and paths may hold the word too, and say nothing.
 * \return empty if it names none, or a pinhole */
std::string fisheyeOf(const std::string& plain, const CalibrationEntry& entry) {
  const std::string value = plainName(entry.text);
  if (holds(plain, {"fisheye", "equidistant"})) {
    for (const char* yes : {"true", "yes", "on", "1", "y"})
      if (value == yes)
        return "fisheye";
    if (value.empty() || value == "false" || value == "no" || value == "off")
      return {};
  }
  if (understandLens(entry.text) == LensName::FISHEYE &&
      !holds(plain, {"name", "topic", "frame"}))
    return entry.text;
  const bool lens = holds(value, {"fisheye", "equidistant", "kannalabrandt"});
  const bool other =
      entry.text.find_first_of("/\\.") != std::string::npos ||
      holds(plain, {"name", "topic", "frame", "comment", "note", "desc"});
  return lens && !other ? entry.text : std::string();
}

/** \brief A name for a message: as the file spells it. */
void addEntry(const std::string& path,
              const CalibrationEntry& entry,
              bool from_zero,
              NamedValues& named) {
  CalibrationName name = understandName(path);
  if (from_zero && name.side != 0 && !name.from_zero)
    name.side = 2; // K0 and K1
  std::string plain = plainName(path);
  if (name.meaning != M::LENS_MODEL)
    if (const std::string lens = fisheyeOf(plain, entry); !lens.empty()) {
      named.lenses.push_back(lens);
      return;
    }
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

} // namespace

cv::Mat NamedValues::matrix(CalibrationMeaning meaning, int side) const {
  const auto it = values.find({meaning, side});
  return it == values.end() ? cv::Mat() : it->second.matrix;
}

double NamedValues::number(std::initializer_list<const char*> names) const {
  for (const char* name : names)
    if (const auto it = numbers.find(name); it != numbers.end())
      return it->second;
  return std::numeric_limits<double>::quiet_NaN();
}

void NamedValues::add(CalibrationMeaning meaning, int side, const Value& value) {
  const auto [it, is_new] = values.emplace(std::make_pair(meaning, side), value);
  const Value& old = it->second;
  if (is_new ||
      (old.text == value.text && old.matrix.size() == value.matrix.size() &&
       (old.matrix.empty() || cv::norm(old.matrix, value.matrix, cv::NORM_INF) == 0.0)))
    return;
  raiseLoad(old.name + " and " + value.name +
            " contradict each other, or there are more than two cameras; leave what "
            "belongs to the pair alone in the file.");
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

NamedValues understand(const CalibrationDocument& document) {
  bool from_zero = false;
  for (const auto& [path, entry] : document.entries) {
    const CalibrationName name = understandName(path);
    from_zero = from_zero || (name.from_zero && entry.numbers.size() > 1);
  }
  NamedValues named;
  for (const auto& [path, entry] : document.entries)
    addEntry(path, entry, from_zero, named);
  return named;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/calibration/calibration_formats.h"

#include <opencv2/core.hpp>

#include <cmath>
#include <fstream>
#include <iterator>

namespace pcl_sq {
namespace {

std::string contentsOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!in || !(text << in.rdbuf()))
    detail::raiseLoad("cannot read '" + file +
                      "', or it is empty; check the name and "
                      "the permissions.");
  return text.str();
}

} // namespace

StereoCalibration StereoCalibration::load(const std::vector<std::string>& files,
                                          double unit,
                                          int width,
                                          int height) {
  std::vector<CalibrationText> texts;
  for (const std::string& file : files)
    texts.push_back({file, contentsOf(file)});
  return fromText(texts, unit, width, height);
}

StereoCalibration StereoCalibration::fromText(const std::vector<CalibrationText>& texts,
                                              double unit,
                                              int width,
                                              int height) {
  if (texts.empty())
    detail::raiseLoad("no file was given; give one or two calibration files.");
  if (!(unit > 0.0) || !std::isfinite(unit))
    detail::raiseLoad("the unit of length must be a positive number of metres.");
  detail::CalibrationDocuments documents;
  for (const CalibrationText& text : texts)
    for (detail::CalibrationDocument& d :
         detail::parseCalibrationText(text.text, text.name))
      documents.push_back(std::move(d));
  if (documents.empty())
    detail::raiseLoad("'" + texts[0].name + "' is empty; give a calibration file.");
  detail::CalibrationContents contents;
  try {
    if (detail::readKalibr(documents, contents) ||
        detail::readEuroc(documents, contents))
      contents.cameras.T *= unit; // in metres, unless the board's size was not
    else if (!detail::readZed(documents, {width, height}, contents) &&
             !detail::readMiddlebury(documents, contents))
      detail::readNamed(documents, unit, contents);
    if (contents.metres && unit != 1.0)
      detail::raiseLoad("ZED's and Middlebury's files have a unit of length of their "
                        "own; leave out --calib-unit.");
    StereoCalibration result =
        contents.raw ? fromRaw(contents.cameras) : fromRectified(contents.intrinsics);
    result.notes_ = contents.notes;
    return result;
  } catch (const cv::Exception&) {
    detail::raiseLoad("'" + texts[0].name +
                      "' holds matrices that no camera pair has; calibrate again.");
  }
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/stereo/stereo_calibration.h"
#include "stereo/calibration/calibration_text.h"

#include <initializer_list>
#include <string>
#include <vector>

namespace pcl_sq::detail {

/** \brief What calibration files say: a raw pair, or a rectified one. */
struct CalibrationContents {
  bool raw = false;
  RawStereoCameras cameras;       ///< of a raw pair
  StereoIntrinsics intrinsics;    ///< of a rectified one
  bool metres = false;            ///< the format has a unit of its own
  std::vector<std::string> notes; ///< what was assumed
};

using CalibrationDocuments = std::vector<CalibrationDocument>;

/** \brief A matrix of a shape; a flat list of the same count is one as well.
 * \throws pcl_sq::Exception if the count differs */
cv::Mat
matrixOf(const CalibrationEntry& entry, const std::string& name, int rows, int cols);
/** \brief One number. \throws pcl_sq::Exception if the entry is none */
double numberOf(const CalibrationEntry& entry, const std::string& name);
/** \brief K of fx, fy, cx, cy. */
cv::Mat cameraMatrix(double fx, double fy, double cx, double cy);
/** \brief Sets whether the lenses are fisheyes. \throws pcl_sq::Exception for a model
 * that is not known */
void setLens(const std::string& model, CalibrationContents& contents);

// One function for each family of files; false: the files are of another one.
bool readKalibr(const CalibrationDocuments& documents, CalibrationContents& contents);
bool readEuroc(const CalibrationDocuments& documents, CalibrationContents& contents);
/** \param[in] images size of the images, which chooses the section; 0 = unknown */
bool readZed(const CalibrationDocuments& documents,
             const cv::Size& images,
             CalibrationContents& contents);
bool readMiddlebury(const CalibrationDocuments& documents,
                    CalibrationContents& contents);
/** \brief ROS camera_info, OpenCV's matrices by name, plain numbers; refuses the rest.
 * \param[in] unit of their lengths [m] */
void readNamed(const CalibrationDocuments& documents,
               double unit,
               CalibrationContents& contents);

} // namespace pcl_sq::detail

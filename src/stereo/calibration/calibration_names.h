// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl_sq::detail {

/** \brief What a value of a calibration file is. */
enum class CalibrationMeaning {
  UNKNOWN,
  HARMLESS, ///< known, and not needed: essential matrices, errors, regions
  CAMERA_MATRIX,
  DISTORTION,
  RECTIFICATION, ///< R1, R2
  PROJECTION,    ///< P1, P2
  ROTATION,      ///< from the left camera to the right one
  TRANSLATION,
  REPROJECTION, ///< Q
  LENS_MODEL,
  WIDTH,
  HEIGHT,
  SIZE
};

/** \brief A name's meaning, and whose: 0 of the pair or a first camera counted from 0,
 * 1 of the left (or of the first one), 2 of the right one. */
struct CalibrationName {
  CalibrationMeaning meaning = CalibrationMeaning::UNKNOWN;
  int side = 0;
  bool from_zero = false; ///< the camera's number was 0
};

/** \brief Understands the spellings that people use: K1, M1, cameraMatrix1,
 * camera_matrix_left, LEFT.K, mtxL, D2, distCoeffs2, rectificationMatrix1, ... */
CalibrationName understandName(const std::string& name);

/** \brief The name in small letters and figures alone. */
std::string plainName(const std::string& name);

/** \brief A lens by the name of its distortion model. */
enum class LensName { PINHOLE, FISHEYE, UNKNOWN };
LensName understandLens(const std::string& name);

} // namespace pcl_sq::detail

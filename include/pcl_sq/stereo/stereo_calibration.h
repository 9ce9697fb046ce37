// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exception.h"
#include "pcl_sq/stereo/camera_intrinsics.h"

#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

namespace pcl_sq {

/** \brief Matrices of a raw pair with OpenCV's names; empty where not known. */
struct RawStereoCameras {
  int width = 0, height = 0; ///< image size [px], 0 = unknown
  cv::Mat M1, D1, M2, D2;    ///< camera matrices, distortion coefficients
  cv::Mat R, T;              ///< right camera from the left one; T in metres
  cv::Mat R1, R2, P1, P2;    ///< rectification; computed when empty
};

/** \brief Calibration of a camera pair, raw or rectified (paper, II-A).
 *
 * Files that are understood:
 * - OpenCV YAML, XML or JSON with M1 D1 M2 D2 R T (raw), optionally R1 R2 P1 P2 as
 *   well, in one file or in two (intrinsics and extrinsics);
 * - OpenCV YAML, XML or JSON with P1 P2 alone, or plain f (or fx, fy), cx, cy,
 *   baseline [m], doffs (rectified);
 * - Middlebury calib.txt (rectified; its baseline is in millimetres);
 * - the plain numbers as text, one "name=value" a line.
 *
 * Everything is checked: finite numbers, shapes, sizes, a horizontal rig with the left
 * camera on the left, a plausible baseline.
 * \ingroup pcl_sq */
class PCL_SQ_EXPORTS StereoCalibration {
public:
  StereoCalibration() = default;

  /** \brief Reads one or two files. \param[in] unit length of the file's unit of T and
   * baseline [m]; Middlebury files fix their own. \throws pcl_sq::Exception */
  static StereoCalibration load(const std::vector<std::string>& files,
                                double unit = 1.0);
  /** \brief Reads one file. \throws pcl_sq::Exception */
  static StereoCalibration load(const std::string& file, double unit = 1.0) {
    return load(std::vector<std::string>{file}, unit);
  }
  /** \brief From the numbers of a rectified pair. \throws pcl_sq::Exception */
  static StereoCalibration fromRectified(const StereoIntrinsics& intrinsics);
  /** \brief From the matrices of a raw pair. \throws pcl_sq::Exception */
  static StereoCalibration fromRaw(const RawStereoCameras& cameras);

  /** \brief Whether images pass through as they are. */
  bool isRectified() const { return raw_.M1.empty(); }
  /** \brief The rectified left camera and the baseline. Of a raw calibration without
   * image size they are known after the first call of rectify(). */
  const StereoIntrinsics& getIntrinsics() const { return intrinsics_; }

  /** \brief Checks the images' sizes against each other and the calibration.
   * \throws pcl_sq::Exception */
  void checkImages(const cv::Mat& left, const cv::Mat& right) const;
  /** \brief Undistorts and rectifies a pair of images; rectified pairs pass through.
   * \throws pcl_sq::Exception if the images do not suit each other or the calibration
   */
  void rectify(const cv::Mat& left,
               const cv::Mat& right,
               cv::Mat& rectified_left,
               cv::Mat& rectified_right);

private:
  void prepareMaps(const cv::Size& size);

  StereoIntrinsics intrinsics_;
  RawStereoCameras raw_;
  cv::Mat maps_[4]; // left 1, left 2, right 1, right 2: made for the first pair
};

} // namespace pcl_sq

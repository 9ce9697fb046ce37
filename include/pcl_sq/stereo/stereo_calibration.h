// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exception.h"
#include "pcl_sq/stereo/camera_intrinsics.h"

#include <opencv2/core/mat.hpp>

#include <array>
#include <string>
#include <vector>

namespace pcl_sq {

/** \brief Matrices of a raw pair with OpenCV's names; empty where not known. */
struct RawStereoCameras {
  int width = 0, height = 0; ///< image size [px], 0 = unknown
  cv::Mat M1, D1, M2, D2;    ///< camera matrices, distortion coefficients
  cv::Mat R, T;              ///< right camera from the left one; T in metres
  cv::Mat R1, R2, P1, P2;    ///< rectification; computed when empty
  /** Whether the lenses are fisheyes of the equidistant model (cv::fisheye, Kalibr's
   * pinhole-equi): D1 and D2 hold its four coefficients, or none. */
  bool fisheye = false;
};

/** \brief Finds R1, R2, P1 and P2 so that corresponding pixels share a row and nothing
 * but what both cameras see is left (cv::stereoRectify with alpha 0).
 * \param[in,out] cameras no fisheyes; M, D, R, T and the size are known
 * \return Q, 4 x 4: from (u, v, disparity, 1) to homogeneous points [m] */
PCL_SQ_EXPORTS cv::Mat rectifyPinholes(RawStereoCameras& cameras);

/** \brief A calibration file that was read already: its name, for messages, and text.
 */
struct CalibrationText {
  std::string name, text;
};

/** \brief Calibration of a camera pair, raw or rectified (paper, II-A).
 *
 * Files that are understood, in one file or in two (left and right, or intrinsics and
 * extrinsics), as YAML, XML, JSON or lines of "name=value":
 * - matrices of OpenCV, as matrices or as plain lists, in the spellings people use (M1,
 *   K1, cameraMatrix1, camera_matrix_left, LEFT.K ...): M1 D1 M2 D2 R T (raw),
 *   optionally R1 R2 P1 P2 as well; P1 P2 alone or Q (rectified). T without R is a
 *   parallel pair. The offset f B may stand in either projection;
 * - plain numbers f (or fx, fy), cx, cy, baseline [m], doffs (rectified);
 * - a pair of ROS camera_info files, left and right;
 * - Kalibr's camchain (cam0 is the left camera), EuRoC's pair of sensor files;
 * - ZED's SN*.conf (its lengths are in millimetres), the section of the images' size;
 * - Middlebury calib.txt (rectified; its baseline is in millimetres).
 *
 * Lenses are pinholes (0, 4, 5, 8, 12 or 14 coefficients) or fisheyes (equidistant, 4
 * coefficients). What is not understood is refused by its name: other models of lenses,
 * matrices that look like a camera's under an unknown name, distortion that would be
 * lost. What is assumed stands in getNotes().
 *
 * Everything is checked: finite numbers, shapes, sizes, a horizontal rig with the left
 * camera on the left, a plausible baseline (1 mm to 10 m).
 * \ingroup pcl_sq */
class PCL_SQ_EXPORTS StereoCalibration {
public:
  StereoCalibration() = default;

  /** \brief Reads one or two files.
   * \param[in] unit length of the file's unit of T and baseline [m]; ZED's and
   * Middlebury's files fix their own and take no other
   * \param[in] width, height size of the images [px], which chooses a section of ZED's
   * files; 0 = unknown \throws pcl_sq::Exception */
  static StereoCalibration load(const std::vector<std::string>& files,
                                double unit = 1.0,
                                int width = 0,
                                int height = 0);
  /** \brief As load(), of texts that were read already. */
  static StereoCalibration fromText(const std::vector<CalibrationText>& texts,
                                    double unit = 1.0,
                                    int width = 0,
                                    int height = 0);
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

  /** \brief What was assumed while reading and rectifying, in sentences: lenses without
   * distortion, parallel cameras, a calibration that was scaled to the images. */
  const std::vector<std::string>& getNotes() const { return notes_; }

  /** \brief Checks the images' sizes against each other and the calibration: images of
   * the calibration's proportions suit it at any size. \throws pcl_sq::Exception */
  void checkImages(const cv::Mat& left, const cv::Mat& right) const;
  /** \brief Undistorts and rectifies a pair of images; rectified pairs pass through.
   * A calibration for images of another size is scaled to the first pair if the
   * proportions are the same. \throws pcl_sq::Exception if the images do not suit each
   * other or the calibration */
  void rectify(const cv::Mat& left,
               const cv::Mat& right,
               cv::Mat& rectified_left,
               cv::Mat& rectified_right);

private:
  void scaleTo(const cv::Size& size);
  void prepareMaps(const cv::Size& size);

  StereoIntrinsics intrinsics_;
  RawStereoCameras raw_;
  std::vector<std::string> notes_;
  std::array<cv::Mat, 4>
      maps_; // left 1, left 2, right 1, right 2: made for the first pair
};

} // namespace pcl_sq

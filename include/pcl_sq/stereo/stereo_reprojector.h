// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/cell_mask.h"
#include "pcl_sq/stereo/stereo_calibration.h"
#include "pcl_sq/stereo/stereo_options.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <utility>
#include <vector>

namespace pcl_sq {

/** \brief What a stereo pair or a depth image becomes. */
struct StereoResult {
  /** Organized, in the left rectified camera's frame [m]; NaN where nothing matched
   * (colours are there all the same), is_dense false. */
  pcl::PointCloud<pcl::PointXYZRGB>::Ptr cloud;
  cv::Mat disparity; ///< CV_32F [px], NaN where nothing matched; empty for depth images
  /** CV_32F, standard deviation of each disparity [px], measured by the pair itself;
   * empty for depth images. */
  cv::Mat disparity_sigma;
  double correlation = 7.0; ///< side of the square of pixels that share an error [px]
  cv::Mat left;             ///< rectified colour image (BGR) the cloud belongs to
  cv::Mat right;            ///< the other one; empty for depth images
  StereoIntrinsics intrinsics; ///< baseline 0 for depth images
  double coverage = 0.0;       ///< share of pixels with depth, 0 to 1
  /** Part of the rectified left image that all of these belong to, cloud, images and
   * intrinsics alike; empty: the whole image. */
  CellRect window;
  /** Part that was matched in full detail where the rest was matched at half its size;
   * empty: no such part. */
  CellRect detail;
  /** Stages and their times [ms]: rectify, overview, match ... */
  std::vector<std::pair<std::string, double>> timings_ms;
};

/** \brief What is known of a pair before it is matched: where to look, how far. */
struct StereoWindow {
  CellRect rect;                           ///< part of the rectified left image
  double min_depth = 0.0, max_depth = 0.0; ///< as in StereoOptions, not 0 [m]
};

/** \brief Disparity by block matching (paper, II-A, Eq. 1) and the cloud from it.
 *
 * Sub-pixel disparities are kept (OpenCV's sixteenths) and, unless
 * StereoOptions::refine is off, refined on the images; d = 0 and other marks of
 * missing pixels become NaN, depth is computed in double precision.
 * \ingroup pcl_sq */
class PCL_SQ_EXPORTS StereoReprojector {
public:
  explicit StereoReprojector(StereoCalibration calibration = {})
      : calibration_(std::move(calibration)) {}

  /** \brief Sets the options; invalid ones are refused with a message. */
  void setOptions(const StereoOptions& options);
  const StereoOptions& getOptions() const { return options_; }
  const StereoCalibration& getCalibration() const { return calibration_; }

  /** \brief From a pair of 8-bit images to the cloud. \throws pcl_sq::Exception if the
   * images do not suit each other or the calibration, have no texture, or seem
   * exchanged */
  StereoResult compute(const cv::Mat& left, const cv::Mat& right);

  /** \brief The same for a part of the images: nothing else is matched. The order of
   * the images is not checked. \throws pcl_sq::Exception also if that part is smaller
   * than 32 x 32 px */
  StereoResult
  compute(const cv::Mat& left, const cv::Mat& right, const StereoWindow& window);

  /** \brief The whole pair at half its size, an eighth of the work. The result is as
   * large as compute()'s; its noise says that it is coarser. \throws pcl_sq::Exception
   * as compute() */
  StereoResult computeCoarse(const cv::Mat& left, const cv::Mat& right);

  /** \brief Matches a part of a pair anew, as finely as compute() does.
   * \param[in,out] scene of computeCoarse() \param[in] part of its image
   * \throws pcl_sq::Exception if that part is smaller than 32 x 32 px */
  void computeDetail(StereoResult& scene, const CellRect& part) const;

  /** \brief Disparity of a rectified pair, CV_32F [px], NaN where nothing matched.
   * \throws pcl_sq::Exception as compute() */
  cv::Mat computeDisparity(const cv::Mat& left,
                           const cv::Mat& right,
                           const StereoIntrinsics& intrinsics) const;

private:
  StereoResult rectified(const cv::Mat& left, const cv::Mat& right);
  void match(StereoResult& result) const;
  /** \brief A part of a rectified pair, as a pair of its own. */
  StereoResult matchWindow(const StereoResult& pair, const StereoWindow& window) const;
  /** \brief Asked where little matches. \throws pcl_sq::Exception if the raw images
   * match the other way round */
  void checkOrder(const cv::Mat& left, const cv::Mat& right);

  StereoCalibration calibration_;
  StereoOptions options_;
};

/** \brief The cloud of a disparity image; see StereoResult::cloud.
 * \param[in] disparity CV_32F [px], NaN or infinity = missing
 * \param[in] color 8-bit, grey or BGR, same size */
PCL_SQ_EXPORTS pcl::PointCloud<pcl::PointXYZRGB>::Ptr reprojectDisparity(
    const cv::Mat& disparity, const cv::Mat& color, const StereoIntrinsics& intrinsics);

/** \brief The cloud of a depth image (Kinect, RealSense; the paper's future work).
 * \param[in] depth CV_16U, 0 = missing, or CV_32F [units], NaN = missing
 * \param[in] unit length of one step of \a depth [m]: 0.001 for the Kinect
 * \param[in] color 8-bit of the same size, or empty \throws pcl_sq::Exception */
PCL_SQ_EXPORTS StereoResult reprojectDepth(const cv::Mat& depth,
                                           double unit,
                                           const CameraIntrinsics& intrinsics,
                                           const cv::Mat& color = cv::Mat());

/** \brief Whether the two rectified images match better the other way round. */
PCL_SQ_EXPORTS bool imagesSeemSwapped(const cv::Mat& left, const cv::Mat& right);

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"
#include "pcl_sq/roi.h"

#include <opencv2/core/mat.hpp>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>
#include <vector>

namespace pcl_sq {

/** \brief How the object is told from its surroundings. */
enum class SegmentMethod {
  COLOR,  ///< histogram back-projection in HSV
  GRABCUT ///< graph cut on colour models of object and background (Rother et al. 2004)
};

/** \brief Settings of ObjectSegmenter. */
struct PCL_SQ_EXPORTS SegmenterOptions {
  SegmentMethod method = SegmentMethod::GRABCUT;
  int iterations = 4;      ///< of GrabCut, [1, 50]
  double min_share = 2e-4; ///< smallest object as a share of the image, [0, 1)
  double margin = 0.35; ///< background around the hint, in sides of its box, [0.05, 2]
  double color_radius = 14; ///< tolerance of a seed colour in Lab, [1, 100]
  /** \brief Focal length times baseline of the pair that the cloud was matched in
   * [px m]; 0: of a depth camera. Tells what the right camera does not see beside the
   * object. At least 0 */
  double disparity_scale = 0.0;

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief The object in the image. */
struct Segment {
  cv::Mat mask;  ///< CV_8U, 255 = object, size of the image
  CellRect rect; ///< its box
  /** \brief Whether the mask follows the object's outline; false where colours did not
   * tell it from its surroundings and the mask is the hint's box. */
  bool outlined = true;
  std::vector<std::string> notes; ///< fall-backs, one sentence each
};

/** \brief Finds the object in the image (paper, II: "a color based segmentation process
 * is used to identify the object") from a hint, or on its table without one.
 *
 * All methods return false, with a PCL_WARN that says why (also getFailure()), when
 * there is nothing to find. Images are 8-bit, grey or BGR.
 * \ingroup pcl_sq */
class PCL_SQ_EXPORTS ObjectSegmenter {
public:
  /** \brief Sets all options; kept as they were, with a PCL_ERROR, if not valid. */
  void setOptions(const SegmenterOptions& options);
  const SegmenterOptions& getOptions() const { return options_; }

  /** \brief The object in a box that holds it roughly. */
  [[nodiscard]] bool
  segmentBox(const cv::Mat& image, const CellRect& box, Segment& segment);
  /** \brief The same, helped by depth where GRABCUT is the method: what lies on the
   * plane around the box or at another depth than the box's middle is hardly the
   * object. \param[in] cloud organized, of the image's size, camera's frame [m] */
  [[nodiscard]] bool segmentBox(const cv::Mat& image,
                                const CellRect& box,
                                const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                                Segment& segment);
  /** \brief The object under a pixel. */
  [[nodiscard]] bool segmentClick(const cv::Mat& image, int x, int y, Segment& segment);
  /** \brief The same, helped by depth where GRABCUT is the method: objects of many
   * colours hang together by their depth. \param[in] cloud as in segmentBox() */
  [[nodiscard]] bool segmentClick(const cv::Mat& image,
                                  int x,
                                  int y,
                                  const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                                  Segment& segment);
  /** \brief The largest patch of a colour. \param[in] red, green, blue 0 to 255 */
  [[nodiscard]] bool
  segmentColor(const cv::Mat& image, int red, int green, int blue, Segment& segment);
  /** \brief The object whose outline is known roughly, such as that of a moment ago.
   * \param[in] rough CV_8U, its pixels not 0, of the image's size */
  [[nodiscard]] bool
  segmentMask(const cv::Mat& image, const cv::Mat& rough, Segment& segment);
  /** \brief The largest object that stands on the largest plane, found in the
   * organized cloud and sharpened in the image. */
  [[nodiscard]] bool segmentTabletop(const cv::Mat& image,
                                     const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                                     Segment& segment);

  /** \brief Why the last call found nothing, a sentence; empty if it did not fail. */
  const std::string& getFailure() const { return failure_; }

private:
  bool fail(const std::string& method, const std::string& why, Segment& segment);
  bool finish(const std::string& method, cv::Mat mask, Segment& segment);

  SegmenterOptions options_;
  std::string failure_;
};

/** \brief Smallest box of the set pixels; empty if there is none. */
PCL_SQ_EXPORTS CellRect boundingRect(const cv::Mat& mask);

} // namespace pcl_sq

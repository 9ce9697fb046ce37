// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief OpenCV's codecs, which bring a hundred libraries with them. Where libraries
 * are shared they are a plug-in, so that only runs which touch images load them. */
struct ImageCodecs {
  /** \brief An image of a file's bytes; empty where they are damaged. \param[in] flags
   * as of cv::imread */
  cv::Mat (*decode)(const std::string& bytes, int flags);
  /** \brief The bytes of a file. \param[in] ending as ".png" \return whether there is a
   * codec of that name which can hold such an image */
  bool (*encode)(const std::string& ending,
                 const cv::Mat& image,
                 std::vector<unsigned char>& bytes);
  bool (*canWrite)(const std::string& ending);
};

/** \brief Loads them at the first call. \throw Failure if they cannot be loaded */
const ImageCodecs& imageCodecs();

} // namespace pcl_sq::app

/** \brief The one function of the plug-in. */
extern "C" __attribute__((visibility("default"))) const pcl_sq::app::ImageCodecs*
pcl_sq_image_codecs();

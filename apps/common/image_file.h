// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include <string>

namespace pcl_sq::app {

/** \brief Reads an image: PNG, JPEG, BMP, PNM, PFM or TIFF; what cannot be decoded
 * whole is refused. \param[in] flags as of cv::imread \throw Failure */
cv::Mat readImage(const std::string& path, int flags);

/** \brief As readImage(), of a file's bytes. \param[in] name for messages */
cv::Mat decodeImage(const std::string& bytes, const std::string& name, int flags);

} // namespace pcl_sq::app

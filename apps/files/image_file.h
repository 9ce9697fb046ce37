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

/** \brief Reads an image whose pixels are numbers, such as labels: the numbers
 * themselves where a PNG gives them colours to be looked at. \throw Failure */
cv::Mat readNumbers(const std::string& path);

/** \brief Reads a mask: 255 where a pixel is brighter than half the brightest, so that
 * 0 and 1 tell as much as black and white; 0 elsewhere. Labels of several things and
 * pictures are refused. \throw Failure */
cv::Mat readMask(const std::string& path);

/** \brief claimOutput() for a picture: PNG into pipes and devices, otherwise as the
 * ending says. \throw UsageError too, if no picture has that ending */
void claimImage(const std::string& option, const std::string& path);

/** \brief Writes a picture. \throw Failure */
void writeImage(const std::string& path, const cv::Mat& image);

} // namespace pcl_sq::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>

#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief A pair of images as the matcher wants them: 8 bits a channel, grey or BGR.
 * Deeper ones are scaled, both alike, by the range of their values. \param[out] notes
 * gets a sentence about it \throw Failure */
void readPair(const std::string& left_path,
              const std::string& right_path,
              cv::Mat& left,
              cv::Mat& right,
              std::vector<std::string>& notes);

/** \brief readPair() of images that are in memory. \param[in] left_path,right_path
 * names for messages */
void suitMatcher(const std::string& left_path,
                 const std::string& right_path,
                 cv::Mat& left,
                 cv::Mat& right,
                 std::vector<std::string>& notes);

/** \brief A depth image and the length of one step of it [m]: of 16 bits or floats; of
 * 8 bits with a scale alone. \param[in] scale as given by the user, 0 if it was not:
 * millimetres of integers, metres of floats \param[out] notes gets what was assumed,
 * and doubt \throw Failure */
cv::Mat
readDepth(const std::string& path, double& scale, std::vector<std::string>& notes);

/** \brief readDepth() of an image that is in memory. \param[in] path name for messages
 */
cv::Mat checkedDepth(cv::Mat depth,
                     const std::string& path,
                     double& scale,
                     std::vector<std::string>& notes);

} // namespace pcl_sq::app

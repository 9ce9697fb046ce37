// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>

namespace pcl_sq::detail {

/** \brief Hue, saturation and value of a smoothed image, as colours are told apart. */
cv::Mat smoothHsv(const cv::Mat& bgr);

/** \brief Probability (CV_8U, 255 = 1) that a pixel's colour is the object's: ratio of
 * HSV histograms, back-projected (Swain & Ballard 1991).
 * \param[in] object, background CV_8U masks of samples */
cv::Mat
colorProbability(const cv::Mat& bgr, const cv::Mat& object, const cv::Mat& background);
/** \brief The same of what smoothHsv() gave, where several samples of it are learnt. */
cv::Mat
hsvProbability(const cv::Mat& hsv, const cv::Mat& object, const cv::Mat& background);

/** \brief Pixels that a threshold at one half keeps, without specks. */
cv::Mat cleanMask(const cv::Mat& probability);

/** \brief Whether a cut at a reduced size is all that is wanted. */
enum class Border { ROUGH, FINE };

/** \brief Graph cut from labels (GC_BGD ...); first on a reduced image, then along the
 * border at full size. \return CV_8U mask */
cv::Mat cutGraph(const cv::Mat& bgr,
                 const cv::Mat& labels,
                 int iterations,
                 Border border = Border::FINE);

/** \brief The connected component under a pixel, or the largest. */
cv::Mat componentAt(const cv::Mat& mask, const cv::Point& place);
cv::Mat largestComponents(const cv::Mat& mask);

/** \brief Closes holes smaller than a share of the mask; true gaps, as in a cup's
 * handle, stay. */
void fillSmallHoles(cv::Mat& mask, double share);

} // namespace pcl_sq::detail

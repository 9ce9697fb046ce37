// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/wls/wls_filter.h"

#include <opencv2/ximgproc/disparity_filter.hpp>

namespace pcl_sq::detail {
namespace {

void filterWls(const cv::Mat& left,
               const cv::Mat& right,
               const cv::Mat& guide,
               const cv::Ptr<cv::StereoMatcher>& matcher,
               const StereoOptions& options,
               cv::Mat& fixed,
               cv::Mat& confidence) {
  // the filter makes its own left-right check and confidence from raw disparities
  auto filter = cv::ximgproc::createDisparityWLSFilter(matcher);
  auto right_matcher = cv::ximgproc::createRightMatcher(matcher);
  cv::Mat fixed_left, fixed_right;
  matcher->compute(left, right, fixed_left);
  right_matcher->compute(right, left, fixed_right);
  filter->setLambda(options.wls_lambda);
  filter->setSigmaColor(options.wls_sigma);
  filter->filter(fixed_left, guide, fixed, fixed_right, cv::Rect(), right);
  confidence = filter->getConfidenceMap();
}

} // namespace
} // namespace pcl_sq::detail

pcl_sq::detail::WlsFilter* pcl_sq_wls_filter() {
  return &pcl_sq::detail::filterWls;
}

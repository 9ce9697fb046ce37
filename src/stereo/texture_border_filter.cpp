// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/texture_border_filter.h"

#include <opencv2/imgproc.hpp>
#include <pcl/console/print.h>

#include <cmath>

namespace pcl_sq {
namespace {

/** \brief Mean colour of the masked pixels around each pixel, CV_32FC3. */
cv::Mat localColor(const cv::Mat& bgr, const cv::Mat& mask, int block) {
  cv::Mat color, weight, sum, count;
  bgr.convertTo(color, CV_32FC3);
  color.setTo(cv::Scalar::all(0), mask == 0);
  mask.convertTo(weight, CV_32F, 1.0 / 255.0);
  const cv::Size window(2 * block + 1, 2 * block + 1);
  cv::boxFilter(color, sum, CV_32F, window);
  cv::boxFilter(weight, count, CV_32F, window);
  cv::Mat counts[] = {count + 1e-6f, count + 1e-6f, count + 1e-6f};
  cv::merge(counts, 3, count);
  return sum / count;
}

cv::Mat squaredColorDistance(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat difference = a - b, channels[3];
  cv::split(difference.mul(difference), channels);
  return channels[0] + channels[1] + channels[2];
}

cv::Mat localDeviation(const cv::Mat& bgr) {
  cv::Mat grey, mean, square;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(grey, CV_32F);
  cv::boxFilter(grey, mean, CV_32F, {3, 3});
  cv::boxFilter(grey.mul(grey), square, CV_32F, {3, 3});
  cv::Mat variance = cv::max(square - mean.mul(mean), 0.0), deviation;
  cv::sqrt(variance, deviation);
  return deviation;
}

} // namespace

TextureBorderFilter::TextureBorderFilter(bool extract_removed_indices)
    : pcl::FilterIndices<pcl::PointXYZRGB>(extract_removed_indices) {
  filter_name_ = "TextureBorderFilter";
}

void TextureBorderFilter::setBlockSize(int block_size) {
  if (block_size < 3 || block_size > 51 || block_size % 2 == 0)
    PCL_ERROR("[pcl_sq::TextureBorderFilter::setBlockSize] %d is not odd and 3 to 51; "
              "%d is kept.\n",
              block_size,
              block_size_);
  else
    block_size_ = block_size;
}

void TextureBorderFilter::setMinTexture(double min_texture) {
  if (!(min_texture >= 0.0 && min_texture <= 128.0))
    PCL_ERROR("[pcl_sq::TextureBorderFilter::setMinTexture] %g is not in [0, 128]; %g "
              "is kept.\n",
              min_texture,
              min_texture_);
  else
    min_texture_ = min_texture;
}

cv::Mat TextureBorderFilter::keptPixels() const {
  cv::Mat bgr(mask_.size(), CV_8UC3);
  for (int v = 0; v < bgr.rows; ++v)
    for (int u = 0; u < bgr.cols; ++u) {
      const pcl::PointXYZRGB& p = input_->at(u, v);
      bgr.at<cv::Vec3b>(v, u) = {p.b, p.g, p.r};
    }
  const cv::Mat object = mask_ != 0;
  const int half = block_size_ / 2;
  cv::Mat inside, around;
  cv::erode(object,
            inside,
            cv::getStructuringElement(cv::MORPH_ELLIPSE, {block_size_, block_size_}));
  cv::dilate(object,
             around,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {block_size_, block_size_}));
  cv::Mat color;
  bgr.convertTo(color, CV_32FC3);
  // the object's colour from well inside, the background's from well outside
  const cv::Mat sure = cv::countNonZero(inside) > 0 ? inside : object;
  const cv::Mat to_object =
      squaredColorDistance(color, localColor(bgr, sure, 2 * half + 2));
  const cv::Mat to_background =
      squaredColorDistance(color, localColor(bgr, around == 0, 2 * half + 2));
  const cv::Mat border =
      object & (localDeviation(bgr) >= min_texture_) & (to_object < to_background);
  return inside | border;
}

void TextureBorderFilter::applyFilter(pcl::Indices& indices) {
  indices.clear();
  removed_indices_->clear();
  if (!input_->isOrganized() || mask_.type() != CV_8U ||
      mask_.cols != static_cast<int>(input_->width) ||
      mask_.rows != static_cast<int>(input_->height)) {
    PCL_ERROR("[pcl_sq::TextureBorderFilter::applyFilter] the mask must be 8-bit and "
              "have the size of the organized cloud; set another one.\n");
    return;
  }
  const cv::Mat kept = keptPixels();
  for (const pcl::index_t i : *indices_) {
    const pcl::PointXYZRGB& p = (*input_)[static_cast<std::size_t>(i)];
    // as everywhere in PCL, points without coordinates are in neither list
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      continue;
    const bool keep = kept.ptr<std::uint8_t>()[i] != 0;
    if (keep != negative_)
      indices.push_back(i);
    else if (extract_removed_indices_)
      removed_indices_->push_back(i);
  }
}

} // namespace pcl_sq

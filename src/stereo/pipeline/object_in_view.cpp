// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/pipeline/object_in_view.h"

#include "pcl_sq/exception.h"
#include "pcl_sq/roi_estimator.h"
#include "pcl_sq/stereo/texture_border_filter.h"
#include "stereo/pipeline/texture_check.h"
#include "stereo/segmentation/depth_objects.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {
namespace {

[[noreturn]] void raise(const std::string& what) {
  throw Exception("[pcl_sq::StereoPipeline::look] " + what);
}

Segment segmentOf(const cv::Mat& mask, const StereoResult& scene) {
  if (mask.cols != static_cast<int>(scene.cloud->width) ||
      mask.rows != static_cast<int>(scene.cloud->height))
    raise("the mask and the image differ in size; give a mask of " +
          std::to_string(scene.cloud->width) + " x " +
          std::to_string(scene.cloud->height) + " px, of the rectified left image.");
  Segment segment;
  segment.mask = mask != 0;
  segment.rect = boundingRect(segment.mask);
  if (segment.rect.empty())
    raise("the mask is empty; paint the object white.");
  return segment;
}

/** \brief Disparities in which a table is found: block matching loses most of a slanted
 * one, so that semi-global ones are made beside them. */
pcl::PointCloud<pcl::PointXYZRGB>::ConstPtr
tableCloud(const StereoPipelineOptions& options, const StereoResult& scene) {
  if (scene.disparity.empty() || options.stereo.matcher != StereoMatcher::BM)
    return scene.cloud;
  StereoOptions dense = options.stereo;
  dense.matcher = StereoMatcher::SGBM;
  dense.block_size = 0;
  StereoReprojector reprojector(StereoCalibration::fromRectified(scene.intrinsics));
  reprojector.setOptions(dense);
  return reprojector.compute(scene.left, scene.right).cloud;
}

/** \brief Refuses an object of which nothing was matched but its surroundings. */
void requireTexture(const StereoPipelineOptions& options, const StereoView& view) {
  constexpr double LEAST = 0.05; // a label on a plain body is more
  constexpr double MAJORITY =
      0.5; // where most of the matches are noise, so is the model
  if (view.stereo.disparity.empty() || !view.segment.outlined)
    return;
  // noise of 121 pixels has a correlation of .5 once in ten million times
  const int block =
      std::max(11, options.stereo.blockSizeFor(view.stereo.disparity.cols));
  const TexturedShare share = texturedShare(view.stereo, view.segment.mask, block);
  if (share.of_pixels < LEAST || share.of_matches < MAJORITY)
    raise("hardly anything on the object was matched: it has no texture, so what "
          "the matcher gives is noise; put something with texture on it, project a "
          "pattern, or use a depth camera (--depth).");
}

/** \brief Points of the mask that the border filter keeps. */
void filterBorder(const StereoPipelineOptions& options, StereoView& view) {
  TextureBorderFilter filter;
  filter.setInputCloud(view.stereo.cloud);
  filter.setIndices(pcl::make_shared<pcl::Indices>(view.object));
  filter.setMask(view.segment.mask);
  filter.setBlockSize(
      options.stereo.blockSizeFor(static_cast<int>(view.stereo.cloud->width)));
  filter.filter(view.object);
}

pcl::IndicesPtr maskIndices(const cv::Mat& mask) {
  pcl::IndicesPtr indices(new pcl::Indices);
  const auto* m = mask.ptr<std::uint8_t>();
  for (int i = 0; i < static_cast<int>(mask.total()); ++i)
    if (m[i] != 0)
      indices->push_back(i);
  return indices;
}

/** \brief Whether pixels hang together by more than the windows that are matched are
 * wide: narrower ones, along an outline, may be windows that saw what is behind. */
cv::Mat widerThanWindows(const cv::Mat& pixels, int window) {
  const cv::Mat square = cv::Mat::ones(window, window, CV_8U);
  cv::Mat wide, grown;
  cv::morphologyEx(pixels, wide, cv::MORPH_OPEN, square);
  cv::dilate(wide, grown, square);
  return grown & pixels;
}

/** \brief Points under the mask that are no part of the thing: outside of its box, but
 * for those behind its front, at most as deep as the box is wide, that are no false
 * matches: the inside of a bowl, of which the rim hides what is between. */
pcl::Indices straysOf(const StereoView& view, const pcl::Indices& under_mask) {
  constexpr double REACH =
      0.15;                 // of the box's diagonal: the aperture cuts thin ends off
  constexpr int WINDOW = 9; // of the refinement, the widest that is matched [px]
  if (under_mask.empty())
    return {};
  const double reach = REACH * view.region.sizes().norm();
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach);
  const RoiBox box{view.region.min - margin, view.region.max + margin};
  const double back = view.region.min.z() + view.region.sizes().x() + reach;
  pcl::Indices outside, strays;
  cv::Mat behind = cv::Mat::zeros(view.segment.mask.size(), CV_8U);
  for (const pcl::index_t i : under_mask) {
    const auto& p = (*view.stereo.cloud)[static_cast<std::size_t>(i)];
    const Eigen::Vector3d at = p.getVector3fMap().cast<double>();
    if (!std::isfinite(p.z) || box.contains(at))
      continue;
    outside.push_back(i);
    if (at.z() > view.region.max.z() && at.z() < back)
      behind.ptr<std::uint8_t>()[i] = 255;
  }
  behind = widerThanWindows(behind, WINDOW);
  for (const pcl::index_t i : outside)
    if (behind.ptr<std::uint8_t>()[i] == 0)
      strays.push_back(i);
  return strays;
}

} // namespace

CellRect around(const CellRect& box, double share) {
  constexpr int LEAST = 48; // as wide as some matched windows [px]
  const int dx = std::max(LEAST, static_cast<int>(share * box.width));
  const int dy = std::max(LEAST, static_cast<int>(share * box.height));
  return {box.x - dx, box.y - dy, box.width + 2 * dx, box.height + 2 * dy};
}

bool worthACloseLook(const StereoPipelineOptions& options, const cv::Size& size) {
  constexpr int SMALL = 600; // as for the sizes of block matching [px]
  return options.stereo.matcher == StereoMatcher::SGBM && !options.stereo.wls &&
         size.width >= SMALL;
}

namespace {

/** \brief Box of the thing on the table, found among a quarter of the points. */
CellRect roughlyOnTable(const StereoResult& scene) {
  pcl::PointCloud<pcl::PointXYZRGB> some;
  const auto& all = *scene.cloud;
  some.resize(std::size_t(all.width / 2) * (all.height / 2));
  some.width = all.width / 2;
  some.height = all.height / 2;
  some.is_dense = false;
  for (std::uint32_t v = 0; v < some.height; ++v)
    for (std::uint32_t u = 0; u < some.width; ++u)
      some.at(int(u), int(v)) = all.at(int(2 * u), int(2 * v));
  cv::Mat rough;
  std::string why;
  if (!findTableObject(some, rough, why))
    raise(why + ".");
  const CellRect box = boundingRect(rough);
  return {2 * box.x, 2 * box.y, 2 * box.width, 2 * box.height};
}

} // namespace

CellRect surroundings(const StereoPipelineOptions& options,
                      const StereoResult& coarse) {
  // outlines are cut with the background that far around
  const double share = SegmenterOptions().margin;
  const StereoHint& hint = options.hint;
  const CellRect box = !hint.box.empty()    ? hint.box
                       : !hint.mask.empty() ? boundingRect(hint.mask)
                       : hint.empty()       ? roughlyOnTable(coarse)
                                            : findObject(options, coarse).rect;
  const CellRect part = around(box, share);
  const int x = std::max(0, part.x), y = std::max(0, part.y);
  return {x,
          y,
          std::min(coarse.intrinsics.width, part.x + part.width) - x,
          std::min(coarse.intrinsics.height, part.y + part.height) - y};
}

Segment findObject(const StereoPipelineOptions& options, const StereoResult& scene) {
  const StereoHint& hint = options.hint;
  if (!hint.mask.empty())
    return segmentOf(hint.mask, scene);
  ObjectSegmenter segmenter;
  SegmenterOptions settings;
  settings.method = options.segmentation;
  if (!scene.disparity.empty())
    settings.disparity_scale = scene.intrinsics.fx * scene.intrinsics.baseline;
  segmenter.setOptions(settings);
  Segment segment;
  bool found = false;
  if (hint.click)
    found = segmenter.segmentClick(
        scene.left, (*hint.click)[0], (*hint.click)[1], *scene.cloud, segment);
  else if (hint.color)
    found = segmenter.segmentColor(
        scene.left, (*hint.color)[0], (*hint.color)[1], (*hint.color)[2], segment);
  else if (!hint.box.empty())
    found = segmenter.segmentBox(scene.left, hint.box, *scene.cloud, segment);
  else
    found = segmenter.segmentTabletop(scene.left, *tableCloud(options, scene), segment);
  if (!found)
    raise(segmenter.getFailure() + ".");
  return segment;
}

void findPoints(const StereoPipelineOptions& options, StereoView& view) {
  if (!view.segment.mask.empty()) {
    requireTexture(options, view);
    if (!view.segment.outlined) // a box has no outline that the object could touch
      view.segment.mask.release();
  }
  const cv::Mat& mask = view.segment.mask;
  RoiEstimator<pcl::PointXYZRGB> estimator;
  estimator.setInputCloud(view.stereo.cloud);
  estimator.setRect(view.rect);
  pcl::IndicesPtr under_mask(new pcl::Indices);
  if (!mask.empty()) {
    under_mask = maskIndices(mask);
    estimator.setIndices(under_mask);
  }
  DepthHistogramOptions histogram;
  // of a depth camera, bins are relative to the scene's depth
  histogram.disparity_scale =
      view.stereo.intrinsics.fx * view.stereo.intrinsics.baseline;
  estimator.setHistogramOptions(histogram);
  const bool found = estimator.estimate(view.region, view.object);
  view.histogram = estimator.getHistogram();
  if (!found)
    raise("the region of the image holds no cluster of depths; the object was "
          "not matched: give another region or matcher.");
  view.strays = straysOf(view, *under_mask);
  if (options.border_filter && mask.empty())
    raise("colours do not tell the object from its surroundings, so there is "
          "no outline to filter along; leave out --border-filter.");
  if (options.border_filter)
    filterBorder(options, view);
  if (view.object.empty())
    raise("no point of the object is left; leave out --border-filter.");
}

} // namespace pcl_sq::detail

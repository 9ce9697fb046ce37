// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/stereo/stereo_pipeline.h"

#include "pcl_sq/exception.h"
#include "pcl_sq/stage_timer.h"
#include "stereo/pipeline/object_in_view.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <pcl/console/print.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_sq {
namespace {

/** \brief How far outline and box may move from frame to frame, in sides of the box: as
 * far as a table around the object is seen, too. */
constexpr double FOLLOWED = 0.25;
/** \brief Share of two outlines that both hold of what any of them holds, below which
 * they are not those of one thing a moment later. Looking anew costs time and nothing
 * else, an outline that is wrong costs the model: a can of another colour kept 0.5. */
constexpr double SAME = 0.8;

cv::Rect rectOf(const CellRect& r) {
  return {r.x, r.y, r.width, r.height};
}

/** \brief The last outline where its picture is found now; empty where it is not.
 * \param[in] picture what was seen in \a box, grey \param[in] image the one now */
cv::Mat moved(const cv::Mat& mask,
              const cv::Mat& picture,
              const cv::Rect& box,
              const cv::Mat& image) {
  constexpr double LIKE = 0.5;     // correlation: more is shared than not
  constexpr double LONGEST = 64.0; // a search for a picture of more pixels takes longer
  const double scale = std::min(1.0, LONGEST / std::max(box.width, box.height));
  cv::Mat small_picture, small_image, grey, likeness;
  cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  cv::resize(picture, small_picture, {}, scale, scale, cv::INTER_AREA);
  cv::resize(grey, small_image, {}, scale, scale, cv::INTER_AREA);
  if (small_picture.cols > small_image.cols || small_picture.rows > small_image.rows)
    return {};
  cv::matchTemplate(small_image, small_picture, likeness, cv::TM_CCOEFF_NORMED);
  double best = 0.0;
  cv::Point place;
  cv::minMaxLoc(likeness, nullptr, &best, nullptr, &place);
  if (!(best > LIKE))
    return {};
  const cv::Point by(static_cast<int>(std::lround(place.x / scale)) - box.x,
                     static_cast<int>(std::lround(place.y / scale)) - box.y);
  const cv::Rect all(0, 0, mask.cols, mask.rows), there = all & (all + by);
  cv::Mat result = cv::Mat::zeros(mask.size(), CV_8U);
  mask(there - by).copyTo(result(there));
  return result;
}

bool alike(const cv::Mat& a, const cv::Mat& b) {
  return cv::countNonZero(a & b) > SAME * cv::countNonZero(a | b);
}

} // namespace

void StereoPipeline::setOptions(const StereoPipelineOptions& options) {
  std::string why;
  if (!options.stereo.isValid(&why) || !options.estimation.isValid(&why)) {
    PCL_ERROR("[pcl_sq::StereoPipeline::setOptions] %s; the old options are kept.\n",
              why.c_str());
    return;
  }
  options_ = options;
  reprojector_.setOptions(options.stereo);
  reset();
}

StereoView StereoPipeline::see(const cv::Mat& left, const cv::Mat& right) {
  StereoView view;
  if (options_.progress)
    options_.progress("match", 0.0);
  view.stereo = reprojector_.compute(left, right);
  view.notes = getCalibration().getNotes();
  view.timings_ms = view.stereo.timings_ms;
  return view;
}

StereoView StereoPipeline::look(const cv::Mat& left, const cv::Mat& right) {
  StereoView view;
  if (following_ && last_ && followPair(left, right, view))
    return view;
  if (!seeClosely(left, right, view))
    view = see(left, right);
  finish(view);
  return view;
}

StereoView StereoPipeline::look(StereoResult&& scene) {
  StereoView view;
  view.stereo = std::move(scene);
  view.timings_ms = view.stereo.timings_ms;
  finish(view);
  return view;
}

bool StereoPipeline::seeClosely(const cv::Mat& left,
                                const cv::Mat& right,
                                StereoView& view) {
  if (!detail::worthACloseLook(options_, left.size()))
    return false;
  if (options_.progress)
    options_.progress("match", 0.0);
  try {
    view.stereo = reprojector_.computeCoarse(left, right);
    const CellRect part = detail::surroundings(options_, view.stereo);
    if (part.width * part.height > detail::LARGEST_PART * double(left.total())) {
      view = {};
      return false;
    }
    reprojector_.computeDetail(view.stereo, part);
  } catch (const Exception&) { // all of the pair tells more, and why there is nothing
    view = {};
    return false;
  }
  view.notes = getCalibration().getNotes();
  view.timings_ms = view.stereo.timings_ms;
  return true;
}

bool StereoPipeline::followPair(const cv::Mat& left,
                                const cv::Mat& right,
                                StereoView& view) {
  if (left.size() != last_->mask.size())
    return false;
  try {
    view.stereo =
        reprojector_.compute(left,
                             right,
                             {detail::around(boundingRect(last_->mask), FOLLOWED),
                              last_->min_depth,
                              last_->max_depth});
    view.timings_ms = view.stereo.timings_ms;
    if (!followMask(view))
      return false;
    detail::findPoints(options_, view);
  } catch (const Exception&) { // not as the last frame: to be looked at anew
    view = {};
    return false;
  }
  remember(view);
  return true;
}

bool StereoPipeline::followMask(StereoView& view) const {
  StageTimer timer(view.timings_ms, options_.progress);
  return timer.run("segment", [&] {
    const cv::Rect window = view.stereo.window.empty()
                                ? cv::Rect(0, 0, last_->mask.cols, last_->mask.rows)
                                : rectOf(view.stereo.window);
    const cv::Mat rough = moved(last_->mask(window),
                                last_->picture,
                                cv::boundingRect(last_->mask) - window.tl(),
                                view.stereo.left);
    ObjectSegmenter segmenter;
    SegmenterOptions settings;
    settings.iterations = 1; // colours are learnt from the last outline, which is right
    segmenter.setOptions(settings);
    if (rough.empty() || !segmenter.segmentMask(view.stereo.left, rough, view.segment))
      return false;
    view.rect = view.segment.rect;
    return alike(rough, view.segment.mask);
  });
}

void StereoPipeline::finish(StereoView& view) {
  StageTimer timer(view.timings_ms, options_.progress);
  const StereoHint& hint = options_.hint;
  const auto width = static_cast<int>(view.stereo.cloud->width);
  const auto height = static_cast<int>(view.stereo.cloud->height);
  if (!hint.box.empty() && (rectOf(hint.box) & cv::Rect(0, 0, width, height)).empty())
    throw Exception(
        "[pcl_sq::StereoPipeline::look] --roi lies outside of the image of " +
        std::to_string(width) + " x " + std::to_string(height) +
        " px; give a region within it.");
  if (hint.box_only && hint.mask.empty())
    view.rect = hint.box;
  else {
    const bool followed = following_ && last_ && view.stereo.disparity.empty() &&
                          last_->mask.size() == cv::Size(width, height) &&
                          followMask(view);
    if (!followed)
      view.segment = timer.run(
          "segment", [&] { return detail::findObject(options_, view.stereo); });
    view.rect = view.segment.rect;
    view.notes.insert(
        view.notes.end(), view.segment.notes.begin(), view.segment.notes.end());
  }
  timer.run("roi", [&] {
    detail::findPoints(options_, view);
    return true;
  });
  remember(view);
}

void StereoPipeline::remember(const StereoView& view) {
  last_.reset();
  if (!following_ || view.segment.mask.empty() || view.stereo.left.empty() ||
      !options_.hint.mask.empty())
    return;
  LastFrame last;
  const cv::Rect window = rectOf(view.stereo.window);
  if (window.empty())
    last.mask = view.segment.mask.clone();
  else {
    const StereoIntrinsics k = getCalibration().getIntrinsics();
    last.mask = cv::Mat::zeros(k.height, k.width, CV_8U);
    view.segment.mask.copyTo(last.mask(window));
  }
  cv::cvtColor(
      view.stereo.left(rectOf(view.segment.rect)), last.picture, cv::COLOR_BGR2GRAY);
  // what is seen around the object, and how near and far it may go itself: a part of
  // its depth
  constexpr double MOVES = 0.1, FEW = 0.01;
  std::vector<float> depths;
  const cv::Rect near = rectOf(detail::around(view.segment.rect, FOLLOWED)) &
                        cv::Rect({}, view.segment.mask.size());
  for (int y = near.y; y < near.y + near.height; y += 2)
    for (int x = near.x; x < near.x + near.width; x += 2)
      if (const float z = view.stereo.cloud->at(x, y).z; std::isfinite(z))
        depths.push_back(z);
  std::sort(depths.begin(), depths.end());
  const auto few = static_cast<std::size_t>(FEW * double(depths.size()));
  last.min_depth = std::min(double(depths[few]), (1.0 - MOVES) * view.region.min.z());
  last.max_depth = std::max(double(depths[depths.size() - 1 - few]),
                            (1.0 + MOVES) * view.region.max.z());
  last_ = last;
}

} // namespace pcl_sq

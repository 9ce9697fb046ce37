// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/followed_frames.h"

#include "command_line/app.h"
#include "files/files.h"
#include "files/image_header.h"

#include <opencv2/core.hpp>

#include <exception>

namespace pcl_sq::app {
namespace {

/** \brief Width and height that a frame has, or its file says it has; 0 where it says
 * none. */
std::pair<std::uint64_t, std::uint64_t> sizeOf(const FrontOptions& o) {
  for (const cv::Mat* image : {&o.left_image, &o.depth_image})
    if (!image->empty())
      return {std::uint64_t(image->cols), std::uint64_t(image->rows)};
  ImageHeader header;
  std::string why;
  if (!readImageHeader(readFile(o.left.empty() ? o.depth : o.left), header, &why))
    return {0, 0};
  return {header.width, header.height};
}

} // namespace

StereoModel FollowedFrames::next(const FrontOptions& front,
                                 const ModelOptions& model,
                                 StereoView& view) {
  const auto size = sizeOf(front);
  if (first_)
    size_ = size;
  else if (size != size_ && size_.first > 0)
    throw Failure("the frame has " + std::to_string(size.first) + " x " +
                  std::to_string(size.second) + " px, the first one " +
                  std::to_string(size_.first) + " x " + std::to_string(size_.second) +
                  "; give frames of one camera and one size.");
  first_ = false;
  const auto look = [&] {
    view = runFront(front, model.roi, pipeline_);
    return makeStereoModel(front, view, model);
  };
  const bool again = followed_;
  followed_ = false;
  const auto found = [this](StereoModel made) {
    followed_ = true;
    return made;
  };
  try {
    return found(look());
  } catch (const std::exception&) {
    if (!again)
      throw;
  }
  pipeline_->reset();
  return found(look());
}

} // namespace pcl_sq::app

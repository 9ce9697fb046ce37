// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options/model_options.h"
#include "stereo/stereo_front.h"
#include "stereo/stereo_model.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace pcl_sq::app {

/** \brief One model for each frame of one camera. */
class FollowedFrames {
public:
  /** \brief The model of the next frame. One that fails after others were found is
   * looked at once more, as the first one is: perhaps the scene is another one.
   * \param[in] front with sequence set where frames follow each other
   * \param[out] view what the frame showed
   * \throw Failure if there is no model or the frame has another size */
  StereoModel
  next(const FrontOptions& front, const ModelOptions& model, StereoView& view);

private:
  std::optional<StereoPipeline> pipeline_;
  std::pair<std::uint64_t, std::uint64_t> size_{0, 0}; ///< of the first one [px]
  bool first_ = true, followed_ = false;
};

} // namespace pcl_sq::app

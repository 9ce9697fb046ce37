// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/stereo/stereo_pipeline.h"

namespace pcl_sq::detail {

/** \brief The object in the image, by whatever hint there is, or on its table.
 * \throws pcl_sq::Exception where nothing is found */
Segment findObject(const StereoPipelineOptions& options, const StereoResult& scene);

/** \brief The points of what was found, and the box around them: II-B.
 * \throws pcl_sq::Exception where there are none, or hardly any was matched */
void findPoints(const StereoPipelineOptions& options, StereoView& view);

} // namespace pcl_sq::detail

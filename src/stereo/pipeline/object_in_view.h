// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/stereo/stereo_pipeline.h"

namespace pcl_sq::detail {

/** \brief The object in the image, by whatever hint there is, or on its table.
 * \throws pcl_sq::Exception where nothing is found */
Segment findObject(const StereoPipelineOptions& options, const StereoResult& scene);

/** \brief A larger part of the image is matched as a whole, which costs no more: at
 * half the size everything but an eighth of the work is done once more. */
constexpr double LARGEST_PART = 0.5;

/** \brief A box and what is around it, by a share of its sides. */
CellRect around(const CellRect& box, double share);

/** \brief Whether the pair is to be matched coarsely first and in detail around the
 * object only: the paper's block matching is left as it is, and small images have
 * nothing to spare. */
bool worthACloseLook(const StereoPipelineOptions& options, const cv::Size& size);

/** \brief What is to be matched in detail: the object and the table around it.
 * \param[in] coarse the whole pair \throws pcl_sq::Exception as findObject() */
CellRect surroundings(const StereoPipelineOptions& options, const StereoResult& coarse);

/** \brief The points of what was found, and the box around them: II-B.
 * \throws pcl_sq::Exception where there are none, or hardly any was matched */
void findPoints(const StereoPipelineOptions& options, StereoView& view);

} // namespace pcl_sq::detail

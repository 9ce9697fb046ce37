// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/stereo/stereo_pipeline.h"

#include <CLI/CLI.hpp>

#include <optional>

namespace pcl_sq::app {

/** \brief How an object's cloud is got from images. */
struct FrontOptions {
  std::string left, right; ///< images; \a right is empty with \a depth
  /** \brief The same in memory, where they are no files; names are for messages. */
  cv::Mat left_image, right_image, depth_image, mask_image;
  std::vector<std::string> calib; ///< one or two files
  double calib_unit = 1.0;        ///< of the calibration's lengths [m]
  double baseline = 0.0;          ///< with \a intrinsics instead of \a calib [m]
  StereoOptions stereo;
  /** \brief Not given: semi-global in the best mode, block matching in the paper's. */
  std::optional<StereoMatcher> matcher;
  std::optional<bool> refine;     ///< of the disparities; not given: in the best mode
  std::string depth;              ///< depth image instead of a right one
  double depth_scale = 0.0;       ///< length of its steps [m]; 0: by its kind
  std::vector<double> intrinsics; ///< fx, fy, cx, cy of the images
  std::string segment;            ///< "", "none", "color" or "grabcut"
  std::vector<int> click, color;  ///< hints: pixel; red, green, blue
  std::string mask;               ///< mask image instead of a segmentation
  bool border_filter = false;
  bool sequence = false;     ///< whether the images are patterns of frames that follow
  ProgressCallback progress; ///< is told the stages
};

/** \brief Adds the options to a program, but for those it shares with the model half:
 * mask and intrinsics. */
void addFrontOptions(CLI::App& cli, FrontOptions& options);
/** \brief Those of them that say how images become a cloud. */
void addPairOptions(CLI::App& cli, FrontOptions& options);
/** \brief Refuses contradictions. \throw UsageError */
void checkFrontOptions(const FrontOptions& options, const std::vector<int>& roi);

/** \brief The same for addPairOptions(). \throw UsageError */
void checkPairOptions(const FrontOptions& options);

/** \brief The option that tells another unit of what the images give. */
std::string unitOptionOf(const FrontOptions& options);

/** \brief The pipeline that the options ask for. \param[in] roi box in the image: x, y,
 * w, h, or empty \param[in] size of the images [px] \throw Failure */
StereoPipeline makePipeline(const FrontOptions& options,
                            const std::vector<int>& roi,
                            const cv::Size& size);

/** \brief From the images to the cloud; there is no object yet. \throw Failure */
StereoView readViews(const FrontOptions& options);

/** \brief From the images to the object's points.
 * \param[in,out] pipeline that of the frame before, or none: one is made
 * \param[in] roi as above \throw Failure */
StereoView runFront(const FrontOptions& options,
                    const std::vector<int>& roi,
                    std::optional<StereoPipeline>& pipeline);

} // namespace pcl_sq::app

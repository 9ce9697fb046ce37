// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <string>

namespace pcl_sq {

/** \brief How correspondences are found. */
enum class StereoMatcher {
  BM,  ///< block matching (the paper's choice)
  SGBM ///< semi-global block matching: denser, slower
};

/** \brief Settings of StereoReprojector; the defaults suit images of 0.3 to 2
 * megapixels. */
struct PCL_SQ_EXPORTS StereoOptions {
  StereoMatcher matcher = StereoMatcher::BM;
  /** Side of the matched window [px], odd, 3 to 51; 0: 15 for BM (11 below a width of
   * 600 px), 5 for SGBM. */
  int block_size = 0;
  /** Nearest and farthest depth that is searched [m], 0.001 to 1e6; 0: found on reduced
   * images. A fixed range is faster and surer. */
  double min_depth = 0.0, max_depth = 0.0;
  /** Largest disagreement of the left and right disparity [px], 0 to 100; negative: no
   * check. */
  int left_right_tolerance = 1;
  int uniqueness = 10;        ///< margin of the best over the second best [%], 0 to 100
  int texture_threshold = 10; ///< BM: least texture of a window, 0 to 100000
  int speckle_window = 100;   ///< smallest accepted patch [px], 0 to 100000; 0: all
  int speckle_range = 2;      ///< disparity step inside of a patch [px], 1 to 100
  /** Whether disparities are refined by least-squares matching with slanted windows:
   * less noise, no leaning towards whole pixels, truer limbs; a few hundredths of a
   * second per 100,000 pixels. */
  bool refine = true;
  bool wls = false;            ///< edge-aware smoothing and filling (opencv_ximgproc)
  double wls_lambda = 8000.0;  ///< its strength, [0, 1e6]
  double wls_sigma = 1.5;      ///< its sensitivity to edges, [0.1, 10]
  double wls_confidence = 200; ///< least confidence that is kept, [0, 255]
  /** Whether an order of the images that looks exchanged is an error. */
  bool check_order = true;

  /** \brief Side of the matched window for images of a width [px]. */
  int blockSizeFor(int width) const;
  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_sq {

/** \brief Settings of the search for the object's depth range (II-B, Fig. 2b). */
struct PCL_SQ_EXPORTS DepthHistogramOptions {
  /** \brief Focal length times baseline [px m]: a bin is then one pixel of disparity,
   * as in the paper. 0: bins relative to the depth of the scene, for any depth camera.
   */
  double disparity_scale = 0.0;
  /** \brief Bin over the median inverse depth if there is no disparity_scale: 0.01 is
   * 1 cm at 1 m; (0, 1]. */
  double relative_bin = 0.01;
  int min_count = 3;        ///< a bin needs more than this many points, >= 0 ...
  double min_share = 0.003; ///< ... and more than this share of the pixels, [0, 1]
  int max_gap = 1; ///< bins below the threshold that a cluster may bridge, >= 0

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief Histogram of inverse depths, which are disparities but for a factor, and the
 * aperture: the range of the cluster of connected bins with the most points.
 *
 * Bin b counts inverse depths in [b, b + 1) bin_width. Bin 0, at infinity, is never
 * part of the aperture. */
struct PCL_SQ_EXPORTS DepthHistogram {
  double bin_width = 0.0;            ///< [1/m]
  std::vector<std::uint32_t> counts; ///< points per bin
  double threshold = 0.0;            ///< bins with more points can be in a cluster
  int first_bin = 0, last_bin = -1;  ///< the aperture; empty if last < first
  double median_depth = 0.0;         ///< of the points in the aperture [m]

  /** \brief Bin of a depth [m]; -1 for a depth that is not positive and finite. */
  int binOf(double depth) const;
  /** \brief Whether a depth [m] lies in the aperture. */
  bool contains(double depth) const {
    const int bin = binOf(depth);
    return bin >= first_bin && bin <= last_bin;
  }
  double nearDepth() const { return 1.0 / ((last_bin + 1) * bin_width); } ///< [m]
  double farDepth() const { return 1.0 / (first_bin * bin_width); }       ///< [m]
};

/** \brief Finds the aperture (II-B): the maximal run of bins above the threshold, small
 * gaps bridged, with the largest total count.
 *
 * The object must fill more of the region than anything else at one depth.
 * \param[in] depths z in the camera frame [m]; entries not positive and finite are
 * skipped, bins above 4095 not counted
 * \param[in] pixels size of the 2D region, for min_share
 * \param[out] histogram its counts are also there if no bin is above the threshold
 * \param[out] why what is wrong and what to do, on failure
 * \return whether there is an aperture */
[[nodiscard]] PCL_SQ_EXPORTS bool
computeDepthHistogram(const std::vector<float>& depths,
                      std::size_t pixels,
                      const DepthHistogramOptions& options,
                      DepthHistogram& histogram,
                      std::string* why = nullptr);

} // namespace pcl_sq

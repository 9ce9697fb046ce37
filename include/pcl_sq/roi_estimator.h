// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/depth_histogram.h"
#include "pcl_sq/impl/point_types.hpp"
#include "pcl_sq/roi.h"

#include <pcl/pcl_base.h>

namespace pcl_sq {

/** \brief How the x and y sides of the 3D region follow from the 2D one. */
enum class RoiExtent {
  POINTS,      ///< the smallest that hold all points of the region
  MEDIAN_DEPTH ///< the 2D region back-projected at the points' median depth, as in the
               ///< paper: cuts off corners of what is closer than that
};

/** \brief From a 2D region of an image to the 3D region of the object in it (paper,
 * II-B, Fig. 2).
 *
 * The largest cluster of connected bins in the histogram of the region's inverse
 * depths, which are disparities but for a factor, is the aperture; its ends are the z
 * sides of the box. Works on the clouds of stereo and of depth cameras, in the camera
 * frame (z forward). A mask is handed over by setIndices(); a point counts if it is in
 * both the indices and the rectangle.
 * \tparam PointT point type with x, y, z
 * \ingroup pcl_sq
 */
template <typename PointT>
class RoiEstimator : public pcl::PCLBase<PointT> {
  PCL_SQ_CHECK_POINT_TYPE(PointT);

public:
  using Ptr = pcl::shared_ptr<RoiEstimator<PointT>>;
  using ConstPtr = pcl::shared_ptr<const RoiEstimator<PointT>>;

  /** \brief Sets the 2D region; the cloud must then be organized. It may reach over the
   * image's border. An empty one (default) stands for the whole cloud. */
  void setRect(const CellRect& rect) { rect_ = rect; }
  const CellRect& getRect() const { return rect_; }
  /** \brief Sets the options of the histogram; kept as they were if not valid. */
  void setHistogramOptions(const DepthHistogramOptions& options);
  const DepthHistogramOptions& getHistogramOptions() const { return options_; }
  /** \brief Sets how x and y sides are found. */
  void setExtent(RoiExtent extent) { extent_ = extent; }
  RoiExtent getExtent() const { return extent_; }

  /** \brief Finds the 3D region and its points.
   * \param[out] region the box, in the camera frame [m]
   * \param[out] points indices of the points of the 2D region within the aperture, that
   * is the points of a frustum and not of the box, in the order of the input indices
   * \return false, with no points and a PCL_WARN, if there is no region */
  [[nodiscard]] bool estimate(RoiBox& region, pcl::Indices& points);

  /** \brief The histogram of the last estimate(), with the aperture. */
  const DepthHistogram& getHistogram() const { return histogram_; }

protected:
  using pcl::PCLBase<PointT>::indices_;
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::initCompute;
  using pcl::PCLBase<PointT>::deinitCompute;

private:
  bool findPoints(pcl::Indices& points, std::string& why);
  bool findBox(const pcl::Indices& points, RoiBox& region, std::string& why) const;
  bool findSidesAtMedianDepth(RoiBox& region, std::string& why) const;

  CellRect rect_;
  DepthHistogramOptions options_;
  RoiExtent extent_ = RoiExtent::POINTS;
  DepthHistogram histogram_;
};

/** \brief The line through (pixel, slope) samples of an organized cloud, along one axis
 * of the image: slope = x / z of the ray through a pixel. */
class PCL_SQ_EXPORTS PixelRays {
public:
  void add(double pixel, double slope);
  /** \brief Slope of the ray through a pixel coordinate. \pre isValid() */
  double slopeAt(double pixel) const;
  /** \brief Whether there were samples of at least two pixels and they lie on a line,
   * as those of a pinhole camera do. */
  bool isValid() const;

private:
  double count_ = 0.0, sum_p_ = 0.0, sum_s_ = 0.0;
  double sum_pp_ = 0.0, sum_ps_ = 0.0, sum_ss_ = 0.0;
};

} // namespace pcl_sq

// always: for own point types see impl/point_types.hpp
#include "pcl_sq/impl/roi_estimator.hpp"

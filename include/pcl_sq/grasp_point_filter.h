// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/point_types.hpp"
#include "pcl_sq/point_grasp.h"

#include <pcl/filters/filter_indices.h>

namespace pcl_sq {

/** \brief What makes a point lie on a superquadric's surface. */
enum class SurfaceMetric {
  GAUGE,    ///< |G - 1|, the paper's distance, Eq. (6): relative to the size
  DISTANCE, ///< the first-order distance [m]
  SIGMA     ///< the first-order distance over the cloud's noise
};

/** \brief Keeps the points on the surface of a model (paper, section IV: F = 1): where
 * the estimated shape agrees with what was seen, a gripper can rely on it.
 *
 * A point is on the surface of a union if it is on that of the part that holds it most
 * (smallest G, or smallest signed distance): points inside of another part are not.
 * Points with coordinates that are not finite are in neither list.
 * \tparam PointT point type with x, y, z
 * \ingroup pcl_sq
 */
template <typename PointT>
class GraspPointFilter : public pcl::FilterIndices<PointT> {
  PCL_SQ_CHECK_POINT_TYPE(PointT);

public:
  using Ptr = pcl::shared_ptr<GraspPointFilter<PointT>>;
  using ConstPtr = pcl::shared_ptr<const GraspPointFilter<PointT>>;

  /** \param[in] extract_removed_indices whether getRemovedIndices() is filled */
  explicit GraspPointFilter(bool extract_removed_indices = false);

  /** \brief Sets the model, in the cloud's frame. A model with a part that is not valid
   * is refused. */
  void setModel(const MultiSuperquadric& model);
  const MultiSuperquadric& getModel() const { return model_; }
  /** \brief Selects SurfaceMetric::GAUGE. \param[in] tolerance largest |G - 1|, >= 0 */
  void setGaugeTolerance(double tolerance);
  double getGaugeTolerance() const { return gauge_tolerance_; }
  /** \brief Selects SurfaceMetric::DISTANCE. \param[in] threshold largest distance [m],
   * >= 0 */
  void setDistanceThreshold(double threshold);
  double getDistanceThreshold() const { return distance_threshold_; }
  /** \brief Selects SurfaceMetric::SIGMA: the noise is that of the input itself, 1.4826
   * times the median distance of its points to the surface, so that outliers do not
   * widen it. \param[in] multiples largest distance over it, >= 0 */
  void setSigmaThreshold(double multiples);
  double getSigmaThreshold() const { return sigma_threshold_; }
  /** \brief Noise found by the last filter() with SurfaceMetric::SIGMA [m]. */
  double getSigma() const { return sigma_; }
  SurfaceMetric getMetric() const { return metric_; }

  /** \brief Part, normal and residual of points of the input, in the order of
   * \a indices; NaN stays NaN. \param[out] points header and sensor pose are the
   * input's; empty without a model */
  void describe(const pcl::Indices& indices, pcl::PointCloud<PointGrasp>& points) const;

protected:
  using pcl::FilterIndices<PointT>::filter_name_;
  using pcl::FilterIndices<PointT>::indices_;
  using pcl::FilterIndices<PointT>::input_;
  using pcl::FilterIndices<PointT>::negative_;
  using pcl::FilterIndices<PointT>::extract_removed_indices_;
  using pcl::FilterIndices<PointT>::removed_indices_;
  using pcl::FilterIndices<PointT>::applyFilter;

  void applyFilter(pcl::Indices& indices) override;

private:
  MultiSuperquadric model_;
  SurfaceMetric metric_ = SurfaceMetric::GAUGE;
  double gauge_tolerance_ = 0.05;
  double distance_threshold_ = 0.005;
  double sigma_threshold_ = 2.0;
  double sigma_ = 0.0;
};

/** \brief Which points are on the surface of a union of superquadrics.
 * \param[in] points 3 x N, finite [m]
 * \param[in] tolerance of |G - 1| or of the distance [m]
 * \return one entry per point */
PCL_SQ_EXPORTS std::vector<bool>
onSurface(const MultiSuperquadric& model,
          const Eigen::Ref<const Eigen::Matrix3Xd>& points,
          SurfaceMetric metric,
          double tolerance);

/** \brief Robust standard deviation of the points' distances to a union's surface [m]:
 * 1.4826 times their median. \param[in] points 3 x N [m]; non-finite columns are left
 * out \return 0 for no points or no parts */
PCL_SQ_EXPORTS double surfaceNoise(const MultiSuperquadric& model,
                                   const Eigen::Ref<const Eigen::Matrix3Xd>& points);

} // namespace pcl_sq

// always: for own point types see impl/point_types.hpp
#include "pcl_sq/impl/grasp_point_filter.hpp"

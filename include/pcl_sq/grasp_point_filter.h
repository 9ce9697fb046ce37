// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

#include <pcl/filters/filter_indices.h>

namespace pcl_sq {

/** \brief What makes a point lie on a superquadric's surface. */
enum class SurfaceMetric {
  GAUGE,   ///< |G - 1|, the paper's distance, Eq. (6): relative to the size
  DISTANCE ///< the first-order distance [m]
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
  SurfaceMetric getMetric() const { return metric_; }

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

} // namespace pcl_sq

#ifdef PCL_NO_PRECOMPILE
#include "pcl_sq/impl/grasp_point_filter.hpp"
#endif

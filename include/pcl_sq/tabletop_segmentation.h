// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"
#include "pcl_sq/impl/point_types.hpp"
#include "pcl_sq/table_plane.h"

#include <pcl/pcl_base.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pcl_sq {

/** \brief Settings of TabletopSegmentation. */
struct PCL_SQ_EXPORTS TabletopOptions {
  /** \brief Points nearer to the plane than this belong to it [m]; 0: 0.5 % of the
   * cloud's extent. */
  double plane_distance = 0.0;
  /** \brief Gap that separates two objects [m]; 0: 1 % of the cloud's extent. */
  double cluster_gap = 0.0;
  int max_iterations = 500; ///< of RANSAC, [1, 100000]

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief Finds the object that stands on a table: the largest plane of the cloud, then
 * the largest connected cluster above it, within the plane's outline. \tparam PointT
 * point type with x, y, z \ingroup pcl_sq
 */
template <typename PointT>
class TabletopSegmentation : public pcl::PCLBase<PointT> {
  PCL_SQ_CHECK_POINT_TYPE(PointT);

public:
  /** \brief Sets all options; kept as they were, with a PCL_ERROR, if not valid. */
  void setOptions(const TabletopOptions& options);
  const TabletopOptions& getOptions() const { return options_; }

  /** \brief Restricts the object, but not the plane, to some of the input indices; null
   * (default) for no restriction. */
  void setCandidates(const pcl::IndicesConstPtr& candidates) {
    candidates_ = candidates;
  }

  /** \brief Finds the object.
   * \param[out] object its points, in the order of the input indices; empty on failure
   * \return false, with a PCL_WARN, if there is no plane or nothing above it */
  [[nodiscard]] bool segment(pcl::Indices& object);

  /** \brief The plane of the last successful segment(). */
  const TablePlane& getPlane() const { return plane_; }
  /** \brief Why the last segment() failed, a sentence; empty if it did not. */
  const std::string& getFailure() const { return failure_; }

protected:
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::indices_;
  using pcl::PCLBase<PointT>::initCompute;
  using pcl::PCLBase<PointT>::deinitCompute;

private:
  TabletopOptions options_;
  pcl::IndicesConstPtr candidates_;
  TablePlane plane_;
  std::string failure_;
};

/** \brief The algorithm of TabletopSegmentation on bare points.
 * \param[in] points 3 x N; non-finite columns are left out
 * \param[in] viewpoint the camera's place [m]
 * \param[in] candidates whether a column may belong to the object; empty: all may
 * \param[out] object columns of the object; empty on failure
 * \param[out] why the reason of a failure as a sentence (optional) */
[[nodiscard]] PCL_SQ_EXPORTS bool
findTabletopObject(const Eigen::Matrix3Xf& points,
                   const Eigen::Vector3f& viewpoint,
                   const std::vector<bool>& candidates,
                   const TabletopOptions& options,
                   TablePlane& plane,
                   std::vector<int>& object,
                   std::string* why = nullptr);

} // namespace pcl_sq

// always: for own point types see impl/point_types.hpp
#include "pcl_sq/impl/tabletop_segmentation.hpp"

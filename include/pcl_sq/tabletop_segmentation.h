// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/point_types.hpp"
#include "pcl_sq/object_view.h"

#include <pcl/pcl_base.h>

#include <string>
#include <vector>

namespace pcl_sq {

/** \brief Settings of TabletopSegmentation. */
struct PCL_SQ_EXPORTS TabletopOptions {
  /** \brief Points nearer to the plane than this belong to it [m]; 0: from the points'
   * noise. */
  double plane_distance = 0.0;
  /** \brief Gap that separates two objects [m]; 0: from the points' spacing, in an
   * image from the depth. */
  double cluster_gap = 0.0;
  /** \brief The camera's place in the cloud's frame [m]; without it an image tells, or
   * the cloud's sensor_origin_ where that is not zero. */
  std::optional<Eigen::Vector3d> viewpoint;
  /** \brief Direction away from the ground in the cloud's frame; the table lies across
   * it. */
  std::optional<Eigen::Vector3d> up;
  std::optional<TableModel> table; ///< the table, where it is known

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief Finds the object that stands on a table: the plane that things stand on,
 * which need not be the largest one, and the largest thing on it. Organized clouds are
 * looked at as images in their camera's frame, whatever frame they are in. \tparam
 * PointT point type with x, y, z \ingroup pcl_sq
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
  const TablePlane& getPlane() const { return table_; }
  /** \brief The same with its noise. */
  const TableModel& getTable() const { return table_; }
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
  TableModel table_;
  std::string failure_;
};

/** \brief The algorithm of TabletopSegmentation on bare points.
 * \param[in] points 3 x (width height), row by row for an organized cloud; non-finite
 * columns are left out \param[in] width, height of the organized cloud; height 1: a
 * list \param[in] candidates whether a column may belong to the object; empty: all may.
 * Of an organized cloud those of a box around the thing that is meant \param[out]
 * object columns of the object, ascending; empty on failure \param[out] why the reason
 * of a failure as a sentence (optional) */
[[nodiscard]] PCL_SQ_EXPORTS bool
findTabletopObject(const CloudPoints& points,
                   int width,
                   int height,
                   const std::vector<bool>& candidates,
                   const TabletopOptions& options,
                   TableModel& table,
                   std::vector<int>& object,
                   std::string* why = nullptr);

} // namespace pcl_sq

// always: for own point types see impl/point_types.hpp
#include "pcl_sq/impl/tabletop_segmentation.hpp"

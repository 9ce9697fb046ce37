// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/estimation_options.h"
#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/impl/point_types.hpp"
#include "pcl_sq/multi_superquadric.h"

#include <pcl/PointIndices.h>
#include <pcl/pcl_base.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl_sq {

/** \brief What happened to one part of the object. */
struct PartReport {
  pcl::PointIndices indices; ///< points it was fitted to, in the input cloud
  FitSummary fit;
  double fit_ms = 0.0;  ///< time of the fit [ms]
  int model_part = -1;  ///< its index in the model; -1 if it gave none (see fit)
  ShapeCandidate shape; ///< family of shapes chosen (Decomposition::PARTS)
  double margin = 0.0;  ///< BIC by which the next family is worse
};

/** \brief What an estimation did, stage by stage. */
struct EstimationReport {
  std::string failure; ///< why there is no model, a sentence; empty on success
  /** \brief Fall-backs and what to do about them, one sentence each, those of the view
   * among them. */
  std::vector<std::string> notes;
  RoiBox region;                 ///< box that was divided [m]
  std::size_t region_points = 0; ///< finite points in it
  VoxelLayout voxels;            ///< empty without a decomposition
  std::vector<Prism> prisms;     ///< empty without a decomposition
  std::vector<PartReport> parts; ///< one per prism; one without a decomposition
  pcl::Indices object_indices;   ///< the object's points in the input cloud
  pcl::Indices grasp_indices;    ///< those of them on the union's surface
  ObservedObject view;           ///< what was seen (Decomposition::PARTS)
  /** \brief D of the union, Eq. (7), semi-axes in metres, for the object's points. */
  double distortion = 0.0;
  double rms_distance = 0.0; ///< of the object's points to the union [m]
  /** \brief How far the model explains what was seen, 0 to 1: the share of the points
   * that lie on it to within their noise, times that of the object's pixels that it
   * covers, times that of its pixels through which no background is seen. Below a half,
   * and where fewer than four in five of the pixels are covered, there is no model but
   * a failure (Decomposition::PARTS). */
  double confidence = 0.0;
  std::vector<std::pair<std::string, double>> timings_ms; ///< stage, [ms], in order
};

/** \brief Object surface by a union of superquadrics: the paper in one function.
 *
 * \code
 * pcl_sq::ObjectSurfaceEstimation<pcl::PointXYZ> estimation;
 * estimation.setInputCloud(object_cloud);
 * pcl_sq::MultiSuperquadric model;
 * if (estimation.estimate(model))
 *   std::cout << model.size() << " superquadrics\n";
 * \endcode
 * The camera looks along z with y down, as in every image-based cloud.
 *
 * Which points are the object is said in one of these ways:
 *
 * | said with | the object is |
 * |---|---|
 * | setIndices() | exactly these points, also where they are all of the cloud |
 * | ViewOptions::mask | exactly the pixels under the mask of an organized cloud |
 * | setRegion() | looked for in this box: the thing that the box was drawn around |
 * | setIndices() and setRegion() | looked for among those of the points in the box |
 * | nothing | looked for in the whole view: the largest thing that stands on a table |
 *
 * To look for it takes an image, that is an organized cloud, with a table in it, and
 * the best mode (Decomposition::PARTS, the default). Elsewhere, in lists of points and
 * in the paper's chain, the object is all points that are left: those of the indices,
 * in the box. A whole organized cloud that is the object is said with all its indices.
 * For a rectangle of the image, RoiEstimator gives the points for setIndices() and the
 * box for setRegion(). What the view is known to hold besides, the table, the
 * viewpoint, the camera, is said in EstimationOptions::view.
 *
 * \tparam PointT point type with x, y, z
 * \ingroup pcl_sq
 */
template <typename PointT>
class ObjectSurfaceEstimation : public pcl::PCLBase<PointT> {
  PCL_SQ_CHECK_POINT_TYPE(PointT);

public:
  using Ptr = pcl::shared_ptr<ObjectSurfaceEstimation<PointT>>;
  using ConstPtr = pcl::shared_ptr<const ObjectSurfaceEstimation<PointT>>;

  /** \brief Sets all options; kept as they were, with a PCL_ERROR, if not valid. */
  void setOptions(const EstimationOptions& options);
  const EstimationOptions& getOptions() const { return options_; }

  /** \brief Looks for the object in a box of the cloud's frame [m]; see above. */
  void setRegion(const RoiBox& region) { region_ = region; }
  /** \brief Takes the box back. */
  void unsetRegion() { region_.reset(); }
  /** \brief Whether a box is set. */
  bool hasRegion() const { return region_.has_value(); }
  /** \brief The box set. \pre hasRegion() */
  const RoiBox& getRegion() const { return *region_; }

  /** \brief Number of threads for the fits, 0 for all cores. The result does not depend
   * on it. */
  void setNumberOfThreads(unsigned int threads = 0) { threads_ = threads; }
  unsigned int getNumberOfThreads() const { return threads_; }

  /** \brief Estimates the object's surface.
   * \param[out] model one superquadric per part; empty on failure
   * \return false, with a PCL_WARN that says why, if the data give no model */
  [[nodiscard]] bool estimate(MultiSuperquadric& model);

  /** \brief What the last estimate() did. */
  const EstimationReport& getReport() const { return report_; }

protected:
  using pcl::PCLBase<PointT>::input_;
  using pcl::PCLBase<PointT>::indices_;
  using pcl::PCLBase<PointT>::use_indices_;
  using pcl::PCLBase<PointT>::fake_indices_;
  using pcl::PCLBase<PointT>::initCompute;
  using pcl::PCLBase<PointT>::deinitCompute;

private:
  EstimationOptions options_;
  std::optional<RoiBox> region_;
  unsigned int threads_ = 0;
  EstimationReport report_;
};

} // namespace pcl_sq

// always: for own point types see impl/point_types.hpp
#include "pcl_sq/impl/object_surface_estimation.hpp"

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/adaptive_voxel_grid.h"
#include "pcl_sq/fit_parts.h"
#include "pcl_sq/grasp_point_filter.h"
#include "pcl_sq/object_surface_estimation.h"
#include "pcl_sq/prism_segmentation.h"
#include "pcl_sq/roi_crop.h"
#include "pcl_sq/stage_timer.h"

#include <pcl/console/print.h>

#include <algorithm>
#include <utility>

namespace pcl_sq {

namespace detail {

/** \brief The chosen points as columns. */
template <typename PointT>
Eigen::Matrix3Xf gatherPoints(const pcl::PointCloud<PointT>& cloud,
                              const pcl::Indices& indices) {
  Eigen::Matrix3Xf points(3, static_cast<Eigen::Index>(indices.size()));
  for (std::size_t i = 0; i < indices.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) = cloud[indices[i]].getVector3fMap();
  return points;
}

} // namespace detail

template <typename PointT>
void ObjectSurfaceEstimation<PointT>::setOptions(const EstimationOptions& options) {
  std::string why;
  if (options.isValid(&why))
    options_ = options;
  else
    PCL_ERROR("[pcl_sq::ObjectSurfaceEstimation::setOptions] %s; the options stay as "
              "they were.\n",
              why.c_str());
}

template <typename PointT>
bool ObjectSurfaceEstimation<PointT>::estimate(MultiSuperquadric& model) {
  model = {};
  report_ = {};
  if (!initCompute())
    return fail("there is no input cloud; call setInputCloud first");
  StageTimer timer(report_.timings_ms);
  // II-B: the points of the query region
  pcl::IndicesPtr object(new pcl::Indices);
  bool found = timer.run("crop", [&] { return cropRegion(object); });
  // the best mode looks at the whole view instead of the region's points alone
  const bool parts = options_.decomposition == Decomposition::PARTS;
  if (parts)
    found = found && timer.run("observe", [&] { return observe(object); });
  // III-C, Figs. 3 and 4: voxels relative to the region, prisms of connected voxels
  std::vector<pcl::PointIndices> clusters;
  found = found && (parts || timer.run("decompose",
                                       [&] { return decompose(object, clusters); }));
  // III-B, Eqs. (4)-(7): one superquadric per prism; their union is the object
  found = found && timer.run("fit", [&] {
    return parts ? fitObject(model) : fitParts(object, clusters, model);
  });
  if (found)
    timer.run("evaluate", [&] {
      evaluate(object, model);
      return true;
    });
  // III-C, end: the points on the union's surface are where a hand may touch
  if (found)
    timer.run("grasp_points", [&] {
      findGraspPoints(object, model);
      return true;
    });
  deinitCompute();
  return found;
}

template <typename PointT>
bool ObjectSurfaceEstimation<PointT>::fail(const std::string& sentence) {
  report_.failure = sentence;
  PCL_WARN("[pcl_sq::ObjectSurfaceEstimation::estimate] %s.\n", sentence.c_str());
  return false;
}

template <typename PointT>
bool ObjectSurfaceEstimation<PointT>::cropRegion(pcl::IndicesPtr& object) {
  Eigen::AlignedBox3d box;
  if (has_region_) {
    RoiCrop<PointT> crop;
    crop.setInputCloud(input_);
    crop.setIndices(indices_);
    crop.setRegion(region_);
    crop.filter(*object);
    box = Eigen::AlignedBox3d(region_.min, region_.max);
  } else {
    for (const auto index : *indices_) {
      const auto point = (*input_)[index].getVector3fMap();
      if (!point.allFinite())
        continue;
      object->push_back(index);
      box.extend(point.template cast<double>());
    }
  }
  report_.region_points = object->size();
  if (object->empty())
    return fail("no finite point lies in the region; check the box against the cloud's "
                "extent");
  constexpr double FARTHEST = 1e7; // [m]; beyond, single precision has no shape left
  if (box.min().minCoeff() < -FARTHEST || box.max().maxCoeff() > FARTHEST)
    return fail("the region reaches farther than 1e7 m; remove the outliers or set a "
                "region");
  report_.region.min = box.min();
  report_.region.max = box.max();
  return true;
}

template <typename PointT>
bool ObjectSurfaceEstimation<PointT>::observe(pcl::IndicesPtr& object) {
  // the coordinates where they are: a copy of a whole image takes longer than the rest
  const auto& cloud_points = input_->points;
  const Eigen::Map<const Eigen::Matrix3Xf, 0, Eigen::OuterStride<>> points(
      cloud_points.empty() ? nullptr : cloud_points.front().data,
      3,
      static_cast<Eigen::Index>(cloud_points.size()),
      Eigen::OuterStride<>(sizeof(PointT) / sizeof(float)));
  ViewOptions view = options_.view;
  const Eigen::Vector3d origin =
      input_->sensor_origin_.template head<3>().template cast<double>();
  if (!view.viewpoint && origin.norm() > 0.0)
    view.viewpoint = origin;
  view.object_is_region = has_region_;
  // all points are no choice: the object is still to be found among them
  std::vector<int> columns;
  if (has_region_ || indices_->size() < input_->size())
    columns.assign(object->begin(), object->end());
  std::string why;
  if (!observeObject(points,
                     static_cast<int>(input_->width),
                     static_cast<int>(input_->height),
                     columns,
                     view,
                     report_.view,
                     &why))
    return fail(why);
  report_.region.min = report_.view.points.rowwise().minCoeff();
  report_.region.max = report_.view.points.rowwise().maxCoeff();
  if (!report_.view.pixels.cells.empty()) {
    // all the object's pixels but those whose match went elsewhere
    const Eigen::Vector3d margin =
        Eigen::Vector3d::Constant(0.25 * report_.view.extent);
    const Eigen::AlignedBox3d box(report_.region.min - margin,
                                  report_.region.max + margin);
    object->clear();
    for (std::size_t i = 0; i < input_->size(); ++i)
      if (report_.view.pixels.cells[i] &&
          box.contains(points.col(Eigen::Index(i)).template cast<double>()))
        object->push_back(static_cast<pcl::index_t>(i));
  }
  report_.region_points = object->size();
  return true;
}

template <typename PointT>
bool ObjectSurfaceEstimation<PointT>::fitObject(MultiSuperquadric& model) {
  ObjectFitOptions options = options_.object_fit;
  options.fit.threads = threads_;
  ObjectFit fit = pcl_sq::fitObject(report_.view, options);
  if (fit.model.empty())
    return fail(std::to_string(report_.view.points.cols()) +
                " points give no superquadric: they must span a volume");
  model = fit.model;
  report_.parts.resize(fit.parts.size());
  for (std::size_t k = 0; k < fit.parts.size(); ++k) {
    PartReport& part = report_.parts[k];
    part.indices.header = input_->header;
    part.fit = fit.parts[k].fit;
    part.shape = fit.parts[k].chosen;
    part.margin = fit.parts[k].margin;
    part.model_part = static_cast<int>(k);
    for (std::size_t i = 0; i < fit.labels.size(); ++i)
      if (fit.labels[i] == static_cast<int>(k))
        part.indices.indices.push_back(report_.view.columns[i]);
    std::sort(part.indices.indices.begin(), part.indices.indices.end());
  }
  return true;
}

template <typename PointT>
bool ObjectSurfaceEstimation<PointT>::decompose(
    const pcl::IndicesPtr& object, std::vector<pcl::PointIndices>& clusters) {
  if (options_.decomposition == Decomposition::NONE) {
    clusters.resize(1);
    clusters[0].header = input_->header;
    clusters[0].indices = *object;
    return true;
  }
  std::string why; // the grid itself could only warn
  if (!makeVoxelLayout(report_.region, options_.voxels, report_.voxels, &why))
    return fail(why);
  AdaptiveVoxelGrid<PointT> grid;
  grid.setInputCloud(input_);
  grid.setIndices(object);
  grid.setRegion(report_.region);
  grid.setOptions(options_.voxels);
  pcl::PointCloud<PointT> centroids;
  grid.filter(centroids);
  report_.voxels = grid.getVoxelLayout();

  PrismSegmentation<PointT> segmentation;
  segmentation.setInputCloud(input_);
  segmentation.setIndices(object);
  segmentation.setVoxelLayout(report_.voxels);
  segmentation.setOptions(options_.prisms);
  segmentation.setExclusive(options_.exclusive_points);
  if (!segmentation.segment(clusters))
    return fail("no prism of connected voxels holds enough points; give more points or "
                "ask for fewer divisions");
  report_.prisms = segmentation.getPrisms();
  return true;
}

template <typename PointT>
bool ObjectSurfaceEstimation<PointT>::fitParts(const pcl::IndicesPtr& object,
                                               std::vector<pcl::PointIndices>& clusters,
                                               MultiSuperquadric& model) {
  std::vector<RoiBox> regions;
  for (const Prism& prism : report_.prisms)
    regions.push_back(prism.box);
  if (regions.empty())
    regions.push_back(report_.region);
  // not in the call: the points would stay in memory during the fits
  Eigen::Matrix3d object_rotation = Eigen::Matrix3d::Identity();
  if (options_.fit == FitMode::PAPER && options_.pca == PcaScope::OBJECT)
    object_rotation = principalAxes(detail::gatherPoints(*input_, *object));
  const std::vector<PartFit> fits = pcl_sq::fitParts(
      regions,
      object_rotation,
      [&](std::size_t part) {
        return detail::gatherPoints(*input_, clusters[part].indices);
      },
      options_,
      threads_);
  for (std::size_t i = 0; i < fits.size(); ++i) {
    PartReport part;
    part.indices = std::move(clusters[i]);
    part.fit = fits[i].summary;
    part.fit_ms = fits[i].milliseconds;
    if (part.fit.ok()) {
      part.model_part = static_cast<int>(model.size());
      model.parts.push_back(part.fit.model);
    }
    report_.parts.push_back(std::move(part));
  }
  if (!model.empty())
    return true;
  return fail(std::to_string(object->size()) + " points give no superquadric (" +
              toString(report_.parts.front().fit.termination) +
              "): at least ten are needed, and they must span a volume");
}

template <typename PointT>
void ObjectSurfaceEstimation<PointT>::evaluate(const pcl::IndicesPtr& object,
                                               const MultiSuperquadric& model) {
  report_.object_indices = *object;
  const Eigen::Matrix3Xf points = detail::gatherPoints(*input_, *object);
  const SurfaceStatistics statistics = model.statistics(points);
  report_.distortion = statistics.distortion;
  report_.rms_distance = statistics.rms_distance;
}

template <typename PointT>
void ObjectSurfaceEstimation<PointT>::findGraspPoints(const pcl::IndicesPtr& object,
                                                      const MultiSuperquadric& model) {
  GraspPointFilter<PointT> filter;
  filter.setInputCloud(input_);
  filter.setIndices(object);
  filter.setModel(model);
  filter.setGaugeTolerance(options_.grasp_threshold);
  filter.filter(report_.grasp_indices);
}

} // namespace pcl_sq

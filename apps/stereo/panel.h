// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/depth_histogram.h"
#include "pcl_sq/object_surface_estimation.h"

#include <opencv2/core/mat.hpp>
#include <pcl/point_types.h>

namespace pcl_sq::app {

/** \brief What the panel shows. */
struct PanelInput {
  cv::Mat image; ///< rectified left image, BGR
  cv::Mat mask;  ///< of the object; empty if only a box is known
  CellRect rect; ///< 2D query
  DepthHistogram histogram;
  double disparity_scale = 0.0; ///< focal length times baseline [px m]
  PinholeCamera camera;         ///< of the image
  RoiBox region;                ///< 3D query
  pcl::PointCloud<pcl::PointXYZRGBA>::ConstPtr cloud;  ///< the whole scene
  pcl::PointCloud<pcl::PointXYZRGBA>::ConstPtr object; ///< NaN outside of the object
  EstimationReport report;
  MultiSuperquadric model;
};

/** \brief The paper's Fig. 5 as one picture, BGR: segmented image, query with the
 * histogram's aperture, voxels, prisms (in the best mode: outline and parts), the
 * model's outline over the image, superquadrics over the cloud. */
cv::Mat drawPanel(const PanelInput& input);

} // namespace pcl_sq::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/superquadric_segmentation.h"

// the base class's body; PCL's library with it would bring VTK
#include <pcl/segmentation/impl/sac_segmentation.hpp>

namespace pcl_sq {

template <typename PointT>
SuperquadricSegmentation<PointT>::SuperquadricSegmentation(bool random)
    : pcl::SACSegmentation<PointT>(random) {
  model_type_ = Model::MODEL_TYPE;
  method_type_ = pcl::SAC_RANSAC;
}

template <typename PointT>
void SuperquadricSegmentation<PointT>::segment(
    pcl::PointIndices& inliers, pcl::ModelCoefficients& model_coefficients) {
  inliers.indices.clear();
  model_coefficients.values.clear();
  const char* why = nullptr;
  if (!input_)
    why = "there is no input cloud; call setInputCloud first";
  else if (!(threshold_ > 0.0))
    why = "no point can be near enough; call setDistanceThreshold first";
  else if (method_type_ != pcl::SAC_RANSAC && method_type_ != pcl::SAC_MSAC)
    why = "the method must be pcl::SAC_RANSAC or pcl::SAC_MSAC";
  if (why)
    PCL_ERROR("[pcl_sq::SuperquadricSegmentation::segment] %s.\n", why);
  else
    pcl::SACSegmentation<PointT>::segment(inliers, model_coefficients);
}

template <typename PointT>
bool SuperquadricSegmentation<PointT>::initSACModel(const int /*model_type*/) {
  const auto model = pcl::make_shared<Model>(input_, *indices_, sample_size_, random_);
  model->setFitOptions(fit_options_);
  model->setRadiusLimits(radius_min_, radius_max_);
  model->setAxis(axis_);
  if (eps_angle_ > 0.0)
    model->setEpsAngle(eps_angle_);
  model_ = model;
  return true;
}

} // namespace pcl_sq

PCL_SQ_INSTANTIATE(extern template class PCL_SQ_EXPORTS, SuperquadricSegmentation)

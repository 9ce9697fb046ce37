// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/impl/coordinates.hpp"
#include "pcl_sq/superquadric_segmentation.h"

// the base class's body; PCL's library with it would bring VTK
#include <pcl/segmentation/impl/sac_segmentation.hpp>

namespace pcl_sq {

namespace detail {

/** \brief Counts points by what they tell for a model, see supportOf(). */
template <typename PointT>
class LikelihoodModel : public SampleConsensusModelSuperquadric<PointT> {
public:
  using Base = SampleConsensusModelSuperquadric<PointT>;
  LikelihoodModel(const typename Base::PointCloudConstPtr& cloud,
                  const pcl::Indices& indices,
                  unsigned int sample_size,
                  bool random)
      : Base(cloud, indices, sample_size, random) {
    for (const pcl::index_t i : indices) {
      const Eigen::Vector3f p = (*cloud)[static_cast<std::size_t>(i)].getVector3fMap();
      if (p.allFinite())
        box_.extend(p);
    }
  }
  std::size_t countWithinDistance(const Eigen::VectorXf& model_coefficients,
                                  double threshold) const override {
    const std::size_t count = Base::countWithinDistance(model_coefficients, threshold);
    if (count == 0 || count == indices_->size())
      return count;
    const auto margin = static_cast<float>(2.0 * threshold);
    return supportOf(Superquadric::fromCoefficients(model_coefficients),
                     count,
                     threshold,
                     double((box_.sizes().array() + margin).prod()));
  }

private:
  using Base::indices_;
  Eigen::AlignedBox3f box_;
};

} // namespace detail

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
  if (const char* wrong = detail::contradictionOf(*input_, *indices_)) {
    PCL_ERROR("[pcl_sq::SuperquadricSegmentation::segment] %s.\n", wrong);
    return false;
  }
  const auto model = pcl::make_shared<detail::LikelihoodModel<PointT>>(
      input_, *indices_, sample_size_, random_);
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

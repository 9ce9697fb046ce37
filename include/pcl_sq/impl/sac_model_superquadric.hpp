// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/sac_model_superquadric.h"

#include <pcl/common/io.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_sq {

template <typename PointT>
SampleConsensusModelSuperquadric<PointT>::SampleConsensusModelSuperquadric(
    const PointCloudConstPtr& cloud, unsigned int sample_size, bool random)
    : pcl::SampleConsensusModel<PointT>(cloud, random) {
  initialise(sample_size);
}

template <typename PointT>
SampleConsensusModelSuperquadric<PointT>::SampleConsensusModelSuperquadric(
    const PointCloudConstPtr& cloud,
    const pcl::Indices& indices,
    unsigned int sample_size,
    bool random)
    : pcl::SampleConsensusModel<PointT>(cloud, indices, random) {
  initialise(sample_size);
}

template <typename PointT>
void SampleConsensusModelSuperquadric<PointT>::initialise(unsigned int sample_size) {
  model_name_ = "SampleConsensusModelSuperquadric";
  model_size_ = 11;
  sample_size_ = std::max(sample_size, MIN_SAMPLE_SIZE);
  if (sample_size < MIN_SAMPLE_SIZE)
    PCL_WARN("[pcl_sq::%s] %u points do not determine a superquadric; %u are drawn.\n",
             model_name_.c_str(),
             sample_size,
             sample_size_);
}

template <typename PointT>
void SampleConsensusModelSuperquadric<PointT>::setFitOptions(
    const FitOptions& options) {
  std::string why;
  if (!options.isValid(&why) || options.fixed != FIX_NOTHING) {
    PCL_ERROR("[pcl_sq::%s::setFitOptions] %s; the old options are kept.\n",
              model_name_.c_str(),
              why.empty() ? "a sample has no start to hold parameters at"
                          : why.c_str());
    return;
  }
  options_ = options;
}

template <typename PointT>
Eigen::Matrix3Xf
SampleConsensusModelSuperquadric<PointT>::gather(const pcl::Indices& indices) const {
  Eigen::Matrix3Xf points(3, static_cast<Eigen::Index>(indices.size()));
  for (std::size_t i = 0; i < indices.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) =
        (*input_)[static_cast<std::size_t>(indices[i])].getVector3fMap();
  return points;
}

template <typename PointT>
Eigen::VectorXd SampleConsensusModelSuperquadric<PointT>::distances(
    const pcl::Indices& indices, const Eigen::VectorXf& model_coefficients) const {
  return surfaceDistances(Superquadric::fromCoefficients(model_coefficients),
                          gather(indices))
      .cwiseAbs();
}

template <typename PointT>
double SampleConsensusModelSuperquadric<PointT>::nextReach() {
  if (samples_radius_ > 0.0)
    return samples_radius_;
  if (!(radius_max_ < std::numeric_limits<double>::max()))
    return std::numeric_limits<double>::infinity();
  constexpr double SHARES[] = {1.0, 0.5, 0.25};
  return std::max(2.0 * radius_max_ * SHARES[draws_++ % 3], 2.0 * radius_min_);
}

template <typename PointT>
bool SampleConsensusModelSuperquadric<PointT>::drawNearby(double reach,
                                                          pcl::Indices& samples) {
  // a shuffle that stops early: [0, accepted) are near, [accepted, next) are not
  const std::size_t size = shuffled_indices_.size();
  std::size_t accepted = 0;
  Eigen::Vector3f first;
  for (std::size_t next = 0; next < size && accepted < samples.size(); ++next) {
    const std::size_t drawn =
        next + static_cast<std::size_t>(this->rnd()) % (size - next);
    std::swap(shuffled_indices_[next], shuffled_indices_[drawn]);
    const Eigen::Vector3f point =
        (*input_)[static_cast<std::size_t>(shuffled_indices_[next])].getVector3fMap();
    if (next == 0)
      first = point;
    if ((point - first).norm() <= reach) // never with NaN
      std::swap(shuffled_indices_[accepted++], shuffled_indices_[next]);
  }
  std::copy_n(shuffled_indices_.begin(), samples.size(), samples.begin());
  return accepted == samples.size();
}

template <typename PointT>
void SampleConsensusModelSuperquadric<PointT>::getSamples(int& iterations,
                                                          pcl::Indices& samples) {
  const double reach = nextReach();
  if (indices_->size() < sample_size_ || std::isinf(reach)) {
    pcl::SampleConsensusModel<PointT>::getSamples(iterations, samples);
    return;
  }
  constexpr int MAX_TRIES = 100; // each may look at all points
  samples.resize(sample_size_);
  for (int i = 0; i < MAX_TRIES; ++i)
    if (drawNearby(i == 0 ? reach : nextReach(), samples) && isSampleGood(samples))
      return;
  samples.clear();
}

template <typename PointT>
bool SampleConsensusModelSuperquadric<PointT>::isSampleGood(
    const pcl::Indices& samples) const {
  return samples.size() == sample_size_ && spansVolume(gather(samples));
}

template <typename PointT>
bool SampleConsensusModelSuperquadric<PointT>::isModelValid(
    const Eigen::VectorXf& model_coefficients) const {
  if (!pcl::SampleConsensusModel<PointT>::isModelValid(model_coefficients) ||
      !model_coefficients.allFinite())
    return false;
  const Superquadric s = Superquadric::fromCoefficients(model_coefficients);
  if (s.semi_axes.minCoeff() <= 0.0 || s.semi_axes.minCoeff() < radius_min_ ||
      s.semi_axes.maxCoeff() > radius_max_)
    return false;
  const double length = axis_.norm();
  if (length <= 0.0F)
    return true;
  const double cosine =
      std::abs(s.rotation.col(2).dot(axis_.template cast<double>())) / length;
  return std::acos(std::min(cosine, 1.0)) <= eps_angle_;
}

template <typename PointT>
bool SampleConsensusModelSuperquadric<PointT>::computeModelCoefficients(
    const pcl::Indices& samples, Eigen::VectorXf& model_coefficients) const {
  if (samples.size() != sample_size_) {
    PCL_ERROR("[pcl_sq::%s::computeModelCoefficients] The sample has %zu points; it "
              "must have %u.\n",
              model_name_.c_str(),
              samples.size(),
              sample_size_);
    return false;
  }
  const FitSummary summary = fitSuperquadric(gather(samples), options_);
  if (!summary.ok())
    return false;
  model_coefficients = summary.model.toCoefficients().template cast<float>();
  // here as well as in the other methods: MSAC would else ask for ever
  return isModelValid(model_coefficients);
}

template <typename PointT>
void SampleConsensusModelSuperquadric<PointT>::getDistancesToModel(
    const Eigen::VectorXf& model_coefficients, std::vector<double>& distances) const {
  distances.clear();
  if (!isModelValid(model_coefficients))
    return;
  const Eigen::VectorXd d = this->distances(*indices_, model_coefficients);
  distances.assign(d.data(), d.data() + d.size());
}

template <typename PointT>
void SampleConsensusModelSuperquadric<PointT>::selectWithinDistance(
    const Eigen::VectorXf& model_coefficients,
    double threshold,
    pcl::Indices& inliers) {
  inliers.clear();
  error_sqr_dists_.clear();
  if (!isModelValid(model_coefficients))
    return;
  const Eigen::VectorXd d = distances(*indices_, model_coefficients);
  for (std::size_t i = 0; i < indices_->size(); ++i) {
    const double distance = d[static_cast<Eigen::Index>(i)];
    if (distance <= threshold) {
      inliers.push_back((*indices_)[i]);
      error_sqr_dists_.push_back(distance * distance);
    }
  }
}

template <typename PointT>
std::size_t SampleConsensusModelSuperquadric<PointT>::countWithinDistance(
    const Eigen::VectorXf& model_coefficients, double threshold) const {
  if (!isModelValid(model_coefficients))
    return 0;
  return static_cast<std::size_t>(
      (distances(*indices_, model_coefficients).array() <= threshold).count());
}

template <typename PointT>
void SampleConsensusModelSuperquadric<PointT>::optimizeModelCoefficients(
    const pcl::Indices& inliers,
    const Eigen::VectorXf& model_coefficients,
    Eigen::VectorXf& optimized_coefficients) const {
  // SampleConsensus::refineModel() hands over one vector as both arguments
  // NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
  const Eigen::VectorXf start = model_coefficients;
  optimized_coefficients = start;
  if (!isModelValid(start) || inliers.size() < MIN_SAMPLE_SIZE) {
    PCL_ERROR("[pcl_sq::%s::optimizeModelCoefficients] %zu inliers of the model given "
              "do not determine a superquadric; it is returned as it is.\n",
              model_name_.c_str(),
              inliers.size());
    return;
  }
  const FitSummary summary =
      fitSuperquadric(gather(inliers), Superquadric::fromCoefficients(start), options_);
  if (!summary.ok())
    return;
  const Eigen::VectorXf optimized =
      summary.model.toCoefficients().template cast<float>();
  if (isModelValid(optimized))
    optimized_coefficients = optimized;
}

template <typename PointT>
void SampleConsensusModelSuperquadric<PointT>::projectPoints(
    const pcl::Indices& inliers,
    const Eigen::VectorXf& model_coefficients,
    PointCloud& projected_points,
    bool copy_data_fields) const {
  if (!isModelValid(model_coefficients)) {
    PCL_ERROR("[pcl_sq::%s::projectPoints] The coefficients are no model of this kind; "
              "nothing is projected.\n",
              model_name_.c_str());
    projected_points.clear();
    return;
  }
  if (copy_data_fields)
    projected_points = *input_;
  else
    pcl::copyPointCloud(*input_, inliers, projected_points);
  const Superquadric s = Superquadric::fromCoefficients(model_coefficients);
  for (std::size_t i = 0; i < inliers.size(); ++i) {
    const auto source = static_cast<std::size_t>(inliers[i]);
    PointT& target = projected_points[copy_data_fields ? source : i];
    const Eigen::Vector3d p =
        (*input_)[source].getVector3fMap().template cast<double>();
    if (p.allFinite())
      target.getVector3fMap() = s.closestPoint(p).template cast<float>();
  }
}

template <typename PointT>
bool SampleConsensusModelSuperquadric<PointT>::doSamplesVerifyModel(
    const std::set<pcl::index_t>& indices,
    const Eigen::VectorXf& model_coefficients,
    double threshold) const {
  if (!isModelValid(model_coefficients))
    return false;
  const pcl::Indices listed(indices.begin(), indices.end());
  return (distances(listed, model_coefficients).array() <= threshold).all();
}

} // namespace pcl_sq

PCL_SQ_INSTANTIATE(extern template class PCL_SQ_EXPORTS,
                   SampleConsensusModelSuperquadric)

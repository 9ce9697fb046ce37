// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/sac_model_superquadric.h"

#include <pcl/segmentation/sac_segmentation.h>

namespace pcl_sq {

namespace detail {

/** \brief What points near a body tell for it, as a number of points: the logarithm of
 * their likelihood when they lie evenly on its surface within the threshold, over that
 * when they lie anywhere in a box, relative to that of the smallest body. A large body
 * through parts of two things has more points near to it than either thing, but most of
 * its surface has none.
 * \param[in] count points within the threshold \param[in] threshold [m]
 * \param[in] volume of the box of all points [m^3]
 * \return from 0 to \a count */
PCL_SQ_EXPORTS std::size_t
supportOf(const Superquadric& body, std::size_t count, double threshold, double volume);

} // namespace detail

/** \brief pcl::SACSegmentation that finds superquadrics.
 *
 * Everything of the base class works as ever: input and indices, threshold, iterations,
 * probability, threads, optimised coefficients. What is special:
 *   - the model type is set, and setModelType() has no effect;
 *   - the methods are pcl::SAC_RANSAC (default) and pcl::SAC_MSAC; others are refused,
 *     for PCL's ignore their iteration limit when models are rejected;
 *   - setRadiusLimits() bounds the semi-axes [m]. Give them: samples then come from
 *     places of that size, so that a scene of several things is taken apart by
 * repeating segment() and taking the inliers out. setSamplesMaxDist(radius, nullptr)
 * chooses that size itself, see SampleConsensusModelSuperquadric;
 *   - setAxis() and setEpsAngle() bound the direction of the axis of epsilon1;
 *   - with RANSAC models compete by the likelihood of their points, not by their number
 *     alone: of things side by side, each is found and not a body through two of them.
 *
 * The coefficients are those of Superquadric::toCoefficients().
 * \code
 * pcl_sq::SuperquadricSegmentation<pcl::PointXYZ> segmentation;
 * segmentation.setInputCloud(cloud);
 * segmentation.setDistanceThreshold(0.003); // [m]
 * segmentation.setRadiusLimits(0.01, 0.15); // [m]
 * pcl::PointIndices inliers;
 * pcl::ModelCoefficients coefficients;
 * segmentation.segment(inliers, coefficients);
 * if (!inliers.indices.empty())
 *   std::cout << pcl_sq::Superquadric::fromCoefficients(coefficients.values) << '\n';
 * \endcode
 * The header brings PCL's segmentation headers, but needs no library of PCL beyond
 * core's. \tparam PointT point type with x, y, z
 * \ingroup pcl_sq
 */
template <typename PointT>
class SuperquadricSegmentation : public pcl::SACSegmentation<PointT> {
public:
  using Ptr = pcl::shared_ptr<SuperquadricSegmentation<PointT>>;
  using ConstPtr = pcl::shared_ptr<const SuperquadricSegmentation<PointT>>;
  using Model = SampleConsensusModelSuperquadric<PointT>;

  /** \param[in] random whether the generator is seeded by the time; else it repeats */
  explicit SuperquadricSegmentation(bool random = false);

  /** \brief Sets the number of points drawn for a model, at least
   * SampleConsensusModelSuperquadric::MIN_SAMPLE_SIZE. */
  void setSampleSize(unsigned int sample_size) { sample_size_ = sample_size; }
  unsigned int getSampleSize() const { return sample_size_; }
  /** \brief Sets the options of the fits to samples and to inliers. */
  void setFitOptions(const FitOptions& options) { fit_options_ = options; }
  const FitOptions& getFitOptions() const { return fit_options_; }

  /** \brief Finds the superquadric that the points near to it tell most for.
   * \param[out] inliers its points, in the input cloud; empty, with a PCL_ERROR, if
   * there is none \param[out] model_coefficients eleven, or none */
  void segment(pcl::PointIndices& inliers,
               pcl::ModelCoefficients& model_coefficients) override;

protected:
  using pcl::SACSegmentation<PointT>::input_;
  using pcl::SACSegmentation<PointT>::indices_;
  using pcl::SACSegmentation<PointT>::model_;
  using pcl::SACSegmentation<PointT>::model_type_;
  using pcl::SACSegmentation<PointT>::method_type_;
  using pcl::SACSegmentation<PointT>::threshold_;
  using pcl::SACSegmentation<PointT>::radius_min_;
  using pcl::SACSegmentation<PointT>::radius_max_;
  using pcl::SACSegmentation<PointT>::axis_;
  using pcl::SACSegmentation<PointT>::eps_angle_;
  using pcl::SACSegmentation<PointT>::random_;

  bool initSACModel(const int model_type) override;
  std::string getClassName() const override { return "SuperquadricSegmentation"; }

private:
  unsigned int sample_size_ = Model::DEFAULT_SAMPLE_SIZE;
  FitOptions fit_options_;
};

} // namespace pcl_sq

// always: for own point types see impl/point_types.hpp
#include "pcl_sq/impl/superquadric_segmentation.hpp"

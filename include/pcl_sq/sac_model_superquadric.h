// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/fit_superquadric.h"
#include "pcl_sq/impl/point_types.hpp"

#include <pcl/sample_consensus/sac_model.h>

namespace pcl_sq {

/** \brief Superquadrics behind PCL's sample consensus: give it to
 * pcl::RandomSampleConsensus (also with several threads) or
 * pcl::MEstimatorSampleConsensus.
 *
 * The model coefficients are those of Superquadric::toCoefficients():
 *   - \b center.x, \b center.y, \b center.z : the centre [m]
 *   - \b roll, \b pitch, \b yaw : the rotation [rad], as in pcl::getTransformation
 *   - \b a1, \b a2, \b a3 : the semi-axes [m]
 *   - \b epsilon1, \b epsilon2 : the exponents
 *
 * A sample is fitted robustly, with a mixture that knows outliers; it need not be free
 * of them, and a sample larger than the eleven points that determine a superquadric
 * pays. Distances are those of Superquadric::footPointDistance().
 *
 * Limits on the semi-axes are the base class's setRadiusLimits(); any other wish is a
 * function for setModelConstraints().
 *
 * Where a cloud holds several things, hardly any sample from all over it belongs to one
 * of them. The points of a sample are therefore drawn near to its first one:
 *   - setRadiusLimits(min, max) makes "near" twice the largest semi-axis, a half and a
 *     quarter of it in turn, though never less than twice the smallest: give the limits
 *     and the things of a scene are found one after the other (RANSAC, take the inliers
 *     out, again). The largest should not be much larger than half of the largest
 * thing, or one superquadric over two neighbours may have more inliers than either;
 *   - setSamplesMaxDist(radius, search) makes it that radius [m]. The search is not
 *     needed and may be null: points that are not among the indices are never drawn;
 *   - with neither, samples come from the whole cloud: right for a single thing.
 *
 * RANSAC and MSAC are supported; RRANSAC and RMSAC
 * of PCL ignore their iteration limit when models are rejected.
 * \tparam PointT point type with x, y, z
 * \ingroup pcl_sq
 */
template <typename PointT>
class SampleConsensusModelSuperquadric : public pcl::SampleConsensusModel<PointT> {
public:
  using PointCloud = typename pcl::SampleConsensusModel<PointT>::PointCloud;
  using PointCloudPtr = typename pcl::SampleConsensusModel<PointT>::PointCloudPtr;
  using PointCloudConstPtr =
      typename pcl::SampleConsensusModel<PointT>::PointCloudConstPtr;
  using Ptr = pcl::shared_ptr<SampleConsensusModelSuperquadric<PointT>>;
  using ConstPtr = pcl::shared_ptr<const SampleConsensusModelSuperquadric<PointT>>;

  /** \brief Number of points drawn for a model unless told otherwise. */
  static constexpr unsigned int DEFAULT_SAMPLE_SIZE = 30;
  /** \brief Smallest number of points that determine a model. */
  static constexpr unsigned int MIN_SAMPLE_SIZE = 12;
  /** \brief The value of getModelType(): free in pcl::SacModel, the largest that its
   * range of values holds. */
  static constexpr int MODEL_TYPE = 31;

  /** \param[in] cloud the points
   * \param[in] sample_size points drawn for a model, at least MIN_SAMPLE_SIZE
   * \param[in] random whether the generator is seeded by the time; else it repeats */
  explicit SampleConsensusModelSuperquadric(
      const PointCloudConstPtr& cloud,
      unsigned int sample_size = DEFAULT_SAMPLE_SIZE,
      bool random = false);
  /** \param[in] cloud the points
   * \param[in] indices those of the points that count
   * \param[in] sample_size points drawn for a model, at least MIN_SAMPLE_SIZE
   * \param[in] random whether the generator is seeded by the time; else it repeats */
  SampleConsensusModelSuperquadric(const PointCloudConstPtr& cloud,
                                   const pcl::Indices& indices,
                                   unsigned int sample_size = DEFAULT_SAMPLE_SIZE,
                                   bool random = false);
  /** \brief Not to be copied: the base class's generator refers to its own source. */
  SampleConsensusModelSuperquadric(const SampleConsensusModelSuperquadric&) = delete;
  SampleConsensusModelSuperquadric&
  operator=(const SampleConsensusModelSuperquadric&) = delete;

  /** \brief Sets the options of the fits to samples and to inliers. An invalid set is
   * refused. */
  void setFitOptions(const FitOptions& options);
  const FitOptions& getFitOptions() const { return options_; }
  /** \brief Sets the direction that the axis of epsilon1 must be parallel to; zero: any
   * (default). Acts together with setEpsAngle(). */
  void setAxis(const Eigen::Vector3f& axis) { axis_ = axis; }
  Eigen::Vector3f getAxis() const { return axis_; }
  /** \brief Sets the largest angle between the axis of epsilon1 and setAxis() [rad]. */
  void setEpsAngle(double angle) { eps_angle_ = angle; }
  double getEpsAngle() const { return eps_angle_; }

  /** \brief Draws a sample, see the class for where from.
   * \param[in,out] iterations set to a large number where there are too few points
   * \param[out] samples indices; empty if no good sample is found */
  void getSamples(int& iterations, pcl::Indices& samples) override;
  /** \brief Superquadric of a sample. \return false where there is none, or none that
   * respects the limits */
  bool computeModelCoefficients(const pcl::Indices& samples,
                                Eigen::VectorXf& model_coefficients) const override;
  /** \brief Unsigned distance of each point of getIndices(), in their order [m]. */
  void getDistancesToModel(const Eigen::VectorXf& model_coefficients,
                           std::vector<double>& distances) const override;
  /** \brief Those of getIndices() that are no farther than \a threshold [m]. */
  void selectWithinDistance(const Eigen::VectorXf& model_coefficients,
                            double threshold,
                            pcl::Indices& inliers) override;
  /** \brief Number of the points no farther than \a threshold [m]; thread-safe. */
  std::size_t countWithinDistance(const Eigen::VectorXf& model_coefficients,
                                  double threshold) const override;
  /** \brief Fit to \a inliers that starts from \a model_coefficients. Both coefficient
   * arguments may be one vector; where no fit succeeds they are equal. */
  void
  optimizeModelCoefficients(const pcl::Indices& inliers,
                            const Eigen::VectorXf& model_coefficients,
                            Eigen::VectorXf& optimized_coefficients) const override;
  /** \brief Moves points to the closest place on the surface. \param[in]
   * copy_data_fields whether the output is the whole cloud, or the \a inliers alone */
  void projectPoints(const pcl::Indices& inliers,
                     const Eigen::VectorXf& model_coefficients,
                     PointCloud& projected_points,
                     bool copy_data_fields = true) const override;
  /** \brief Whether all the points are no farther than \a threshold [m]. */
  bool doSamplesVerifyModel(const std::set<pcl::index_t>& indices,
                            const Eigen::VectorXf& model_coefficients,
                            double threshold) const override;
  pcl::SacModel getModelType() const override {
    return static_cast<pcl::SacModel>(MODEL_TYPE);
  }

protected:
  using pcl::SampleConsensusModel<PointT>::model_name_;
  using pcl::SampleConsensusModel<PointT>::input_;
  using pcl::SampleConsensusModel<PointT>::indices_;
  using pcl::SampleConsensusModel<PointT>::radius_min_;
  using pcl::SampleConsensusModel<PointT>::radius_max_;
  using pcl::SampleConsensusModel<PointT>::sample_size_;
  using pcl::SampleConsensusModel<PointT>::model_size_;
  using pcl::SampleConsensusModel<PointT>::error_sqr_dists_;
  using pcl::SampleConsensusModel<PointT>::samples_radius_;
  using pcl::SampleConsensusModel<PointT>::shuffled_indices_;

  bool isModelValid(const Eigen::VectorXf& model_coefficients) const override;
  bool isSampleGood(const pcl::Indices& samples) const override;

private:
  void initialise(unsigned int sample_size);
  /** \brief How far from the first one the points of the next sample may lie [m];
   * infinite where nothing is set. */
  double nextReach();
  /** \brief Fills \a samples with random points that near to each other. \return false
   * if there are not as many around the first */
  bool drawNearby(double reach, pcl::Indices& samples);
  /** \brief Coordinates of points as columns. */
  Eigen::Matrix3Xf gather(const pcl::Indices& indices) const;
  /** \brief Unsigned distances of points; infinite where a coordinate is not finite. */
  Eigen::VectorXd distances(const pcl::Indices& indices,
                            const Eigen::VectorXf& model_coefficients) const;

  FitOptions options_;
  Eigen::Vector3f axis_ = Eigen::Vector3f::Zero();
  double eps_angle_ = 0.1;
  unsigned int draws_ = 0; ///< samples drawn so far
};

} // namespace pcl_sq

// always: for own point types see impl/point_types.hpp
#include "pcl_sq/impl/sac_model_superquadric.hpp"

// SPDX-License-Identifier: BSD-3-Clause
// Private. The two ways from points to a model: estimate_parts.cpp, the default, and
// estimate_prisms.cpp, the paper's. What they share is in
// object_surface_estimation.cpp.
#pragma once

#include "pcl_sq/impl/object_surface_estimation.hpp"
#include "pcl_sq/stage_timer.h"

namespace pcl_sq::detail {

/** \brief One estimation: the input, the settings and what is found. */
class SurfaceEstimator {
public:
  SurfaceEstimator(const EstimationInput& input,
                   const EstimationOptions& options,
                   unsigned int threads,
                   EstimationReport& report)
      : input_(input), options_(options), threads_(threads), report_(report),
        timer_(report.timings_ms, options.progress) {}

  bool estimate(MultiSuperquadric& model);

private:
  /** \brief The default mode: as many parts as the data ask for. */
  bool estimateParts(MultiSuperquadric& model);
  /** \brief The paper's: one superquadric per prism, or one for the region. */
  bool estimatePrisms(MultiSuperquadric& model);
  template <typename Step>
  bool run(const char* name, const Step& step) {
    return timer_.run(name, step);
  }
  /** \brief Ends the estimation with a sentence. */
  bool fail(const std::string& sentence);
  bool crop();
  bool observe();
  bool decompose();
  bool fitObject(MultiSuperquadric& model);
  bool fitPrisms(MultiSuperquadric& model);
  /** \brief Takes points that are not the model's surface out of the object's. */
  void dropStrays(const MultiSuperquadric& model, double noise);
  bool evaluate(MultiSuperquadric& model);
  bool findGraspPoints(const MultiSuperquadric& model);

  /** \brief Points of the cloud as columns. */
  Eigen::Matrix3Xf gather(const pcl::Indices& indices) const;

  const EstimationInput& input_;
  const EstimationOptions& options_;
  const unsigned int threads_;
  EstimationReport& report_;
  StageTimer timer_;
  pcl::Indices object_;
  std::vector<pcl::PointIndices> clusters_;
};

} // namespace pcl_sq::detail

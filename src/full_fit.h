// SPDX-License-Identifier: BSD-3-Clause
// Private. The stages of the full fit, all in the frame of the points.
#pragma once

#include "levenberg_marquardt.h"

namespace pcl_sq::detail {

/** \brief Gaussian on the surface and uniform outliers in the region of the points. */
struct Mixture {
  double sigma = 0.1;         ///< of the Gaussian
  double outlier_share = 0.1; ///< expected
  double volume = 1.0;        ///< of the region

  /** \brief The kernels' c for a surface of this area. */
  double outlier(double area) const;
};

/** \brief A superquadric with its mixture and how well both explain the points. */
struct Candidate {
  Superquadric model;
  Mixture mixture;
  double nll = 0.0; ///< negative log-likelihood per point
};

/** \brief Settings of the stages that come from the options and the cloud. */
struct FitSetting {
  FitOptions options;
  double volume = 1.0;      ///< of the points' region
  double min_sigma = 1e-6;  ///< noise is never believed to be smaller
  double fixed_sigma = 0.0; ///< 0: estimated
  double max_axis = 1e3;
  Contributor contributor;
  int iterations = 0; ///< spent so far
};

/** \brief Starts from the moments of the dense points. */
std::vector<Superquadric> startShapes(const UnitPoints& dense);

/** \brief Multi-start search. */
Candidate search(const UnitPoints& points, FitSetting& setting);

/** \brief Foot-point refinement with estimation of the mixture. */
Candidate refine(const UnitPoints& points,
                 const Candidate& start,
                 FitSetting& setting,
                 LmResult& last);

} // namespace pcl_sq::detail

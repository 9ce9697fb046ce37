// SPDX-License-Identifier: BSD-3-Clause
// Private. What a cloud of points says about a superquadric: points lie uniformly on
// its surface with Gaussian noise, some elsewhere, uniformly in the cloud's region.
#pragma once

#include "solver/levenberg_marquardt.h"

namespace pcl_sq::detail {

/** \brief The distribution of the points around a surface; lengths in the unit of the
 * points. */
struct Mixture {
  double sigma = 0.1;         ///< of the noise across the surface
  double outlier_share = 0.1; ///< of the points
  double volume = 1.0;        ///< of the cloud's region

  /** \brief An area times the Gaussian's width is the volume that its points fill: the
   * body's own and 4 pi sigma^2, for areas grow away from a convex surface (Steiner
   * 1840). Without it a body far smaller than the noise would explain any cloud. */
  double filledArea(double area) const;
  /** \brief The kernels' c: density of the outliers over the peak of the Gaussian's,
   * for a surface of this area. */
  double outlier(double area) const;
  /** \brief Negative log-likelihood per point from the cost of \a count points. */
  double negativeLogLikelihood(double cost, std::size_t count, double area) const;
};

/** \brief What bounds the mixture's estimation. */
struct MixtureLimits {
  bool robust = true;       ///< false: no outliers
  double fixed_sigma = 0.0; ///< 0: estimated
  double min_sigma = 1e-6;  ///< rounding of single precision
  double max_outlier_share = 0.6;
};

/** \brief The mixture that the sums of an evaluation imply (M20, the M-step).
 * \param[in] share, weighted as in SquareSums */
Mixture estimated(const Mixture& before,
                  double share,
                  double weighted,
                  std::size_t count,
                  const MixtureLimits& limits);

/** \brief Area of a superquadric's surface. */
double surfaceArea(const Superquadric& model);

/** \brief Preference for the smaller surface as a cost in squared lengths.
 *
 * Points uniform around a surface have the density 1/A of what they fill, A =
 * filledArea(), which adds N ln A to the negative log-likelihood. Noise across a curved
 * surface pushes points outwards, which takes half of it back (exactly so for a
 * sphere): N/2 ln A remains. Times 2 sigma^2, to be a cost, it vanishes with the noise
 * and shifts a well-seen axis a by no more than about sigma^2 / a, the noise's own
 * bias, with the opposite sign; it decides only in directions that the points leave
 * open. \param[in] inliers their expected number */
Contributor sizePrior(double sigma, double inliers);

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// Private. The stages of the full fit, all in the frame of the points.
#pragma once

#include "solver/gaussian_uniform.h"

namespace pcl_sq::detail {

constexpr std::size_t COARSE_POINTS = 256; ///< among which starts are compared
constexpr std::size_t MEDIUM_POINTS = 512; ///< for the best of them

/** \brief A superquadric with its mixture and how well both explain the points. */
struct Candidate {
  Superquadric model;
  Mixture mixture;
  double nll = 0.0; ///< negative log-likelihood per point, cf. Mixture
};

/** \brief Settings of the stages, from the options and the cloud. */
struct FitSetting {
  LmOptions lm; ///< bounds, free directions, contributor
  MixtureLimits limits;
  bool size_prior = true;
  int max_iterations = 60;
  int iterations = 0; ///< counted by the stages
};

/** \brief The setting for a cloud of \a count points; a noise that is given needs the
 * cloud's unit and is left to the caller. */
FitSetting settingOf(const FitOptions& options, std::size_t count);

/** \brief Fits of one start; the mixture is estimated anew after each round.
 * \param[in] slowest factor by which sigma may shrink in a round at most: the basin
 * narrows with it */
Candidate anneal(const UnitPoints& points,
                 const Candidate& start,
                 kernels::Residual residual,
                 int rounds,
                 FitSetting& setting);

/** \brief The best of many starts on a subset of the points. \param[in] doubted a fit
 * that is likely to be wrong: more starts, also along its axes, and more of them
 * carried on; nullptr where there is none */
Candidate
search(const UnitPoints& points, const Superquadric* doubted, FitSetting& setting);

/** \brief Fit to all points by the distance to the foot point, to convergence of model
 * and mixture. \param[out] last of the Levenberg-Marquardt runs */
Candidate refine(const UnitPoints& points,
                 const Candidate& start,
                 FitSetting& setting,
                 LmResult& last);

/** \brief Whether a fit is likely to be a wrong minimum: its residuals are systematic,
 * or it takes a part of the surface for outliers. */
bool doubtful(const UnitPoints& points, const Candidate& candidate);

} // namespace pcl_sq::detail

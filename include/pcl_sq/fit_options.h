// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <string>

namespace pcl_sq {

/** \brief What a fit minimises over the points. */
enum class Cost {
  PAPER,  ///< Eq. (7): sqrt(a1 a2 a3) mean (G - 1)^2
  SOLINA, ///< Solina & Bajcsy 1990: a1 a2 a3 mean (F^e1 - 1)^2
  RADIAL  ///< Gross & Boult 1988: mean (|y| (1 - 1/G))^2
};

/** \brief Which principal axis becomes the axis of epsilon1. */
enum class AxisAssignment {
  DEPTH,    ///< a3 is the depth, as the paper has it: upright cylinders have no model
  BEST_OF_3 ///< the cyclic permutation with the smallest cost
};

/** \brief How a1 and a2 follow from the points. */
enum class Extents {
  EXTREMES, ///< the outermost points, as the paper has it
  QUANTILES ///< robust against border noise
};

/** \brief Settings of the paper's constrained fit (III-B): pose, a1 and a2 come from
 * the region and the points' extents; epsilon1, epsilon2 and a3 are estimated. */
struct PCL_SQ_EXPORTS PaperFitOptions {
  Cost cost = Cost::PAPER;
  AxisAssignment axis_assignment = AxisAssignment::DEPTH;
  Extents extents = Extents::EXTREMES;
  double quantile = 0.01;       ///< share cut off at each end by QUANTILES, [0, 0.25]
  double min_epsilon = 0.1;     ///< lower bound of both exponents, [0.05, 1]
  double max_epsilon = 1.9;     ///< upper bound of both exponents, [1, 2]
  double min_depth_ratio = 0.2; ///< lower bound of a3 over its start, (0, 1]
  double max_depth_ratio = 1.5; ///< upper bound of a3 over its start, [1, 10]
  /** \brief Whether the start's front stays in place while a3 is estimated, the centre
   * moving with it, instead of the centre. */
  bool keep_front = false;
  int max_iterations = 50; ///< of Levenberg-Marquardt, [1, 1000]

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

/** \brief Parameters that a fit can hold at the start's value; combine with |. */
enum FixedParameters : unsigned {
  FIX_NOTHING = 0,
  FIX_CENTER = 0x007,
  FIX_ROTATION = 0x038,
  FIX_SEMI_AXIS_1 = 0x040,
  FIX_SEMI_AXIS_2 = 0x080,
  FIX_SEMI_AXIS_3 = 0x100,
  FIX_SEMI_AXES = 0x1c0,
  FIX_EPSILON_1 = 0x200,
  FIX_EPSILON_2 = 0x400
};

/** \brief Settings of the full fit: all eleven parameters from bare points. */
struct PCL_SQ_EXPORTS FitOptions {
  double min_epsilon = 0.05; ///< lower bound of both exponents, [0.05, 1]
  double max_epsilon = 2.0;  ///< upper bound of both exponents, [1, 2]
  bool robust = true;        ///< weigh points down that look like outliers
  /** \brief Largest share of outliers that is believed, [0, 0.9]. */
  double max_outlier_share = 0.6;
  /** \brief Standard deviation of the points' noise [m], >= 0; 0: estimated. */
  double noise = 0.0;
  /** \brief Prefer the smaller of two superquadrics that noise cannot tell apart. Acts
   * with the square of the noise, so that it vanishes for exact points. */
  bool size_prior = true;
  /** \brief Parameters held at the start's value (needs a start): FixedParameters. */
  unsigned fixed = FIX_NOTHING;
  int max_iterations = 60; ///< of the last stage's Levenberg-Marquardt, [1, 1000]

  /** \brief Whether every setting is in its range. \param[out] why the first that is
   * not */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

} // namespace pcl_sq

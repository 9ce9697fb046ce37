// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/fit_superquadric.h"

namespace pcl_sq {

/** \brief When fitTapered() tapers. */
enum class Tapering {
  AUTOMATIC, ///< where the points demand it: a margin above TaperedFit::DEMAND
  ALWAYS     ///< the best taper, however small
};

/** \brief Result of fitTapered(). */
struct PCL_SQ_EXPORTS TaperedFit {
  /** \brief Margin from which on the points demand a taper [nats]. Twice the "very
   * strong" of Kass & Raftery 1995: noise that is not alike everywhere, as that of
   * stereo, now and then favours a taper that is not there. */
  static constexpr double DEMAND = 10.0;

  Superquadric model; ///< without taper where none was chosen
  /** \brief By how much the taper wins, [nats]: the gain in log-likelihood less ln N
   * for the two further parameters (half of Schwarz's BIC 1978). */
  double margin = 0.0;
  double kx_deviation = 0.0;  ///< standard deviation of kx; zero where none was chosen
  double ky_deviation = 0.0;  ///< and of ky
  double rms_distance = 0.0;  ///< of the foot-point distance to \a model [m]
  double sigma = 0.0;         ///< noise of the points on the surface of \a model [m]
  double outlier_share = 0.0; ///< share of points that belong elsewhere
  FitSummary untapered;       ///< the full fit; says why where there is none

  /** \brief Whether \a model is usable. */
  [[nodiscard]] bool ok() const { return untapered.ok(); }
};

/** \brief The full fit, and a taper where the points demand one.
 *
 * After fitSuperquadric() all three axes and the starts of its search are tried with
 * the two parameters of the taper free, with the same mixture and distance; the best is
 * compared with the best body without taper that either fit finds, by their distances
 * to the points alone. 2,048 of the points decide and 16,384 determine the result; some
 * 50 ms, whether there is a taper or not.
 * \param[in] points 3 x N in the cloud's frame [m]; non-finite columns are left out
 * \param[in] options as of fitSuperquadric(); nothing may be fixed */
PCL_SQ_EXPORTS TaperedFit fitTapered(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                     const FitOptions& options = {},
                                     Tapering tapering = Tapering::AUTOMATIC);

} // namespace pcl_sq

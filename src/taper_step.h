// SPDX-License-Identifier: BSD-3-Clause
// Private. Steps of a fit over the thirteen parameters of a tapered superquadric.
#pragma once

#include "levenberg_marquardt.h"
#include "taper_row.h"

namespace pcl_sq::detail {

using Matrix13 = Eigen::Matrix<double, 13, 13>;

/** \brief A tapered superquadric moved by a step, shortened to the range of trust; all
 * held in bounds. \param[out] limited whether the step was shortened */
TaperedSuperquadric moved(const TaperedSuperquadric& model,
                          const Vector13& step,
                          const LmOptions& options,
                          bool& limited);

/** \brief Whether a direction leads out of a bound that the model already touches. */
bool leadsOut(const TaperedSuperquadric& model,
              const Vector13& direction,
              const LmOptions& options);

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/roi_estimator.h"

#include <pcl/point_types.h>

namespace pcl_sq {

void PixelRays::add(double pixel, double slope) {
  count_ += 1.0;
  sum_p_ += pixel;
  sum_s_ += slope;
  sum_pp_ += pixel * pixel;
  sum_ps_ += pixel * slope;
  sum_ss_ += slope * slope;
}

double PixelRays::slopeAt(double pixel) const {
  const double mean_p = sum_p_ / count_, mean_s = sum_s_ / count_;
  const double variance_p = sum_pp_ / count_ - mean_p * mean_p;
  const double covariance = sum_ps_ / count_ - mean_p * mean_s;
  return mean_s + covariance / variance_p * (pixel - mean_p);
}

bool PixelRays::isValid() const {
  if (count_ < 2.0)
    return false;
  const double mean_p = sum_p_ / count_, mean_s = sum_s_ / count_;
  const double variance_p = sum_pp_ / count_ - mean_p * mean_p;
  const double variance_s = sum_ss_ / count_ - mean_s * mean_s;
  const double covariance = sum_ps_ / count_ - mean_p * mean_s;
  // pixels are integers: those of two columns have a variance of at least 1/count
  return variance_p * count_ > 0.25 && covariance > 0.0 &&
         covariance * covariance > 0.99 * variance_p * variance_s;
}

} // namespace pcl_sq

PCL_SQ_INSTANTIATE(template class, RoiEstimator)

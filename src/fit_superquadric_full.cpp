// SPDX-License-Identifier: BSD-3-Clause
#include "full_fit.h"

namespace pcl_sq {

namespace {

using namespace detail;

FitSummary fit(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
               const Superquadric* initial,
               const FitOptions& options) {
  FitSummary summary;
  if (!options.isValid()) {
    summary.termination = Termination::INVALID_OPTIONS;
    return summary;
  }
  UnitFrame frame;
  if (!principalFrame(points, frame)) {
    summary.termination = Termination::DEGENERATE;
    return summary;
  }
  const UnitPoints all = toUnit(points, frame);
  summary.points = all.size();
  if (all.size() < 12) {
    summary.termination = Termination::TOO_FEW_POINTS;
    return summary;
  }
  FitSetting setting;
  setting.options = options;
  setting.fixed_sigma = options.noise / frame.scale;
  Eigen::Vector3f low = all[0], high = all[0];
  for (std::size_t i = 0; i < all.size(); ++i) {
    low = low.cwiseMin(all[i]);
    high = high.cwiseMax(all[i]);
  }
  setting.volume = (high - low).cast<double>().cwiseMax(0.1).prod();
  setting.max_axis = 20.0;
  Candidate best;
  if (initial) {
    best.model = frame.toUnit(*initial);
    best.mixture.volume = setting.volume;
  } else
    best = search(all, setting);
  LmResult last;
  best = refine(all, best, setting, last);
  summary.model = frame.toCloud(best.model);
  summary.iterations = setting.iterations;
  summary.termination = last.termination;
  summary.sigma = best.mixture.sigma * frame.scale;
  summary.rms_distance = summary.sigma;
  summary.outlier_share = best.mixture.outlier_share;
  summary.distortion = best.nll; // DEV
  return summary;
}

} // namespace

FitSummary fitSuperquadric(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                           const FitOptions& options) {
  return fit(points, nullptr, options);
}

FitSummary fitSuperquadric(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                           const Superquadric& initial,
                           const FitOptions& options) {
  return fit(points, &initial, options);
}

} // namespace pcl_sq

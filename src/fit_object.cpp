// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/fit_object.h"

namespace pcl_sq {

ObjectFit fitObject(const ObservedObject& observed, const ObjectFitOptions& options) {
  ObjectFit fit;
  SupportFitOptions single = options.fit;
  single.effective_points = observed.effective_points;
  single.max_semi_axis = 2.4 * observed.extent;
  fit.parts.push_back(fitWithSupports(
      observed.points,
      observed.evidence(observed.contour, options.silhouette_lines, true),
      single));
  if (!fit.parts.front().fit.ok())
    return {};
  fit.model.parts.push_back(fit.parts.front().fit.model);
  fit.labels.assign(std::size_t(observed.points.cols()), 0);
  return fit;
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#include "all_round.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int CELLS = 16; ///< per edge of the cube that is projected onto a part

} // namespace

double outerArea(const std::vector<Superquadric>& parts) {
  double sum = 0.0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Superquadric& part = parts[k];
    const double cell = 4.0 / (CELLS * CELLS) * part.semi_axes.prod();
    for (int face = 0; face < 6; ++face)
      for (int i = 0; i < CELLS * CELLS; ++i) {
        Eigen::Vector3d d;
        d[face / 2] = face % 2 ? -1.0 : 1.0;
        d[(face / 2 + 1) % 3] = 2.0 * (i % CELLS + 0.5) / CELLS - 1.0;
        d[(face / 2 + 2) % 3] = 2.0 * (i / CELLS + 0.5) / CELLS - 1.0;
        const Eigen::Vector3d out = part.toWorld(d.cwiseProduct(part.semi_axes));
        // the cone over a cell of the face, cut off at gauge one, has the area vector
        // G^-3 grad G, times its volume over that of the cube's third
        const double shrink = 1.0 / part.gauge(out);
        const double area =
            cell * shrink * shrink * shrink * part.gaugeGradient(out).norm();
        const Eigen::Vector3d p = part.center + shrink * (out - part.center);
        // a cell that another part's surface crosses counts in part
        double visible = 1.0;
        for (std::size_t j = 0; j < parts.size() && visible > 0.0; ++j)
          if (j != k)
            visible =
                std::min(visible,
                         std::clamp(0.5 + parts[j].footPointDistance(p) / std::sqrt(area),
                                    0.0,
                                    1.0));
        sum += visible * area;
      }
  }
  return sum;
}

} // namespace pcl_sq::detail

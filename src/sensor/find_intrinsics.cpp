// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/object_view.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq {

bool findIntrinsics(const CloudPoints& points,
                    int width,
                    int height,
                    PinholeCamera& camera) {
  // X / Z = (u - cx) / fx: a straight line in u, and likewise in v
  double n = 0.0, su = 0.0, sv = 0.0, sx = 0.0, sy = 0.0, suu = 0.0, svv = 0.0;
  double sux = 0.0, svy = 0.0;
  const int step = std::max(1, width * height / 20000);
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> samples;
  for (int c = 0; c < width * height; c += step) {
    const Eigen::Vector3d p = points.col(c).cast<double>();
    if (!p.allFinite() || !(p.z() > 0.0))
      continue;
    const int column = c % width, row = c / width;
    const double u = column, v = row, x = p.x() / p.z(), y = p.y() / p.z();
    samples.push_back({{u, v}, {x, y}});
    n += 1.0;
    su += u;
    sv += v;
    sx += x;
    sy += y;
    suu += u * u;
    svv += v * v;
    sux += u * x;
    svy += v * y;
  }
  if (n < 30.0)
    return false;
  const double bx = (n * sux - su * sx) / (n * suu - su * su);
  const double by = (n * svy - sv * sy) / (n * svv - sv * sv);
  if (!(bx > 1e-6 && by > 1e-6) || !std::isfinite(bx) || !std::isfinite(by))
    return false;
  camera = {};
  camera.fx = 1.0 / bx;
  camera.fy = 1.0 / by;
  camera.cx = (su - sx / bx) / n;
  camera.cy = (sv - sy / by) / n;
  std::size_t off = 0;
  for (const auto& [pixel, slope] : samples)
    off += std::abs(camera.fx * slope.x() + camera.cx - pixel.x()) > 1.0 ||
           std::abs(camera.fy * slope.y() + camera.cy - pixel.y()) > 1.0;
  return double(off) < 0.05 * n;
}

} // namespace pcl_sq

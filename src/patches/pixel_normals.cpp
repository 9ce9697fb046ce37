// SPDX-License-Identifier: BSD-3-Clause
#include "patches/pixel_normals.h"

#include "util/parallel_for.h"

#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int HALF = 4;        ///< pixels about each: a superpixel's size
constexpr int SPARSE_STEP = 2; ///< of them are looked at: neighbours share their errors
constexpr float LEAST = 6.0F;  ///< of a plane's pixels

/** \brief Moments of a plane's inverse depths, which are linear in the pixel. */
struct Moments {
  float n = 0.0F, x = 0.0F, y = 0.0F, d = 0.0F;
  float xx = 0.0F, xy = 0.0F, yy = 0.0F, xd = 0.0F, yd = 0.0F;

  void add(float u, float v, float w) {
    n += 1.0F;
    x += u;
    y += v;
    d += w;
    xx += u * u;
    xy += u * v;
    yy += v * v;
    xd += u * w;
    yd += v * w;
  }
};

} // namespace

Eigen::Matrix3Xf
pixelNormals(const SceneView& view, const CellMask& pixels, double jump) {
  Eigen::Matrix3Xf normals = Eigen::Matrix3Xf::Zero(3, view.points.cols());
  const auto fx = static_cast<float>(view.camera.fx);
  const auto fy = static_cast<float>(view.camera.fy);
  const auto cx = static_cast<float>(view.camera.cx);
  const auto cy = static_cast<float>(view.camera.cy);
  const auto row = [&](std::size_t index) {
    const int y = int(index);
    for (int x = 0; x < view.width; ++x) {
      if (!pixels(x, y))
        continue;
      const int c = y * view.width + x;
      const float here = 1.0F / view.points(2, c);
      Moments m;
      for (int v = -HALF; v <= HALF; v += SPARSE_STEP)
        for (int u = -HALF; u <= HALF; u += SPARSE_STEP) {
          if (!pixels(x + u, y + v))
            continue;
          const float w = 1.0F / view.points(2, c + v * view.width + u) - here;
          const auto far = float(std::max(std::abs(u), std::abs(v)));
          if (std::abs(w) <= float(STEEPEST) * far * here / fx + float(jump))
            m.add(float(u), float(v), w);
        }
      const float xx = m.xx - m.x * m.x / m.n, yy = m.yy - m.y * m.y / m.n;
      const float xy = m.xy - m.x * m.y / m.n;
      const float xd = m.xd - m.x * m.d / m.n, yd = m.yd - m.y * m.d / m.n;
      const float det = xx * yy - xy * xy;
      if (m.n < LEAST || det < 1e-3F * xx * yy)
        continue;
      const float a = (xd * yy - yd * xy) / det, b = (yd * xx - xd * xy) / det;
      const float middle = here + (m.d - a * m.x - b * m.y) / m.n;
      // n . ray = 1 / z on the plane n . p = 1
      const Eigen::Vector3f n(
          a * fx, b * fy, middle - a * (float(x) - cx) - b * (float(y) - cy));
      normals.col(c) = -n.normalized();
    }
  };
  parallelFor(std::size_t(view.height), view.threads, row);
  return normals;
}

} // namespace pcl_sq::detail

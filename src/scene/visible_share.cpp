// SPDX-License-Identifier: BSD-3-Clause
#include "scene/visible_share.h"

#include "pcl_sq/line_intersection.h"
#include "pieces/body_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_sq::detail {

namespace {

constexpr double SAMPLE = 1500.0; ///< pixels that are looked at: two in a hundred
constexpr double NEARER = 0.01;   ///< of the depth: what is in front, beyond its noise

/** \brief Depth at which a ray first meets a model; infinite where it misses. */
double depthOf(const MultiSuperquadric& model,
               const PinholeCamera& camera,
               const Eigen::Vector3d& ray) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Superquadric& part : model.parts) {
    LineInterval inside;
    if (intersectLineBox(part, camera.center, ray, inside) &&
        intersectLine(part, camera.center, ray, inside) && inside.leave > 0.0)
      nearest = std::min(nearest, inside.enter);
  }
  return std::isfinite(nearest) ? camera.depthOf(camera.center + nearest * ray)
                                : nearest;
}

/** \brief Box of a model in the image, within it. */
CellRect boxInImage(const MultiSuperquadric& model,
                    const PinholeCamera& camera,
                    int width,
                    int height) {
  Eigen::AlignedBox2d box;
  const Eigen::AlignedBox3d body = model.boundingBox();
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d p = body.corner(Eigen::AlignedBox3d::CornerType(k));
    if (camera.depthOf(p) > 0.0)
      box.extend(camera.project(p));
  }
  if (box.isEmpty())
    return {};
  const auto cell = [](double v, int size) {
    return int(std::clamp(std::round(v), 0.0, double(size - 1)));
  };
  const int x = cell(box.min().x(), width), y = cell(box.min().y(), height);
  return {
      x, y, cell(box.max().x(), width) - x + 1, cell(box.max().y(), height) - y + 1};
}

} // namespace

double visibleShare(const SceneObject& object,
                    const PinholeCamera& camera,
                    const CloudPoints& points,
                    const LabelImage& labels) {
  const CellRect box = boxInImage(object.model, camera, labels.width, labels.height);
  const int step = std::max(1, int(std::sqrt(double(box.area()) / SAMPLE)));
  std::vector<RayTest> bodies;
  for (const Superquadric& part : object.model.parts)
    bodies.emplace_back(part, camera.center);
  int covered = 0, hidden = 0;
  for (int y = box.y; y < box.y + box.height; y += step)
    for (int x = box.x; x < box.x + box.width; x += step) {
      const Eigen::Vector3d ray = camera.ray({double(x), double(y)});
      if (std::none_of(bodies.begin(), bodies.end(), [&](const RayTest& b) {
            return b.hits(ray);
          }))
        continue;
      ++covered;
      const int c = y * labels.width + x;
      const Eigen::Vector3d p = points.col(c).cast<double>();
      hidden += labels.values[std::size_t(c)] != object.label && p.allFinite() &&
                camera.depthOf(p) < (1.0 - NEARER) * depthOf(object.model, camera, ray);
    }
  return covered > 0 ? 1.0 - double(hidden) / double(covered) : 1.0;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// Whether what is taken for one object are several.
#include "scene/patches.h"
#include "sensor/camera_pose.h"
#include "sensor/observation.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

/** \brief Of an object's pixels: a smaller piece is a handle, a label, or a scrap of
 * what stands beside it. */
constexpr double GOOD_SHARE = 0.15;

} // namespace

int countThings(const ObservedObject& object,
                const CloudPoints& points,
                const ColorMatrix& colors) {
  const CellMask& mask = object.pixels;
  if (!object.table || mask.cells.empty() ||
      Eigen::Index(mask.cells.size()) != points.cols())
    return 1;
  const CameraPose pose(object.camera);
  Eigen::Matrix3Xf moved;
  if (!pose.isIdentity())
    moved = pose.toCamera(points);
  const CloudPoints seen = moved.size() == 0 ? points : CloudPoints(moved);
  PinholeCamera camera = object.camera;
  camera.center.setZero();
  camera.rotation.setIdentity();
  const SceneView view{
      seen, mask.width, mask.height, colors, camera, pose.toCamera(*object.table)};
  CellMask pixels = mask;
  for (std::size_t i = 0; i < pixels.cells.size(); ++i)
    if (const int c = int(i); pixels.cells[i])
      pixels.cells[i] =
          view.finite(c) && view.table.height(view.at(c)) >
                                standingHeight(view.table, double(view.points(2, c)));
  const double least = GOOD_SHARE * double(pixels.count());
  const std::vector<Patch> things =
      joinPatches(view, patchesOf(view, divide(view, pixels)));
  const auto count = std::count_if(things.begin(), things.end(), [&](const Patch& t) {
    return double(t.pixels.size()) > least &&
           !isThin(t.pixels, view.width, view.height);
  });
  return std::max(1, int(count));
}

} // namespace pcl_sq::detail

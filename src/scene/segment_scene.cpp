// SPDX-License-Identifier: BSD-3-Clause
// Things told apart (M25): superpixels joined to patches where nothing speaks against
// it, patches to things where the evidence is for one thing.
#include "scene/segment_scene.h"

#include "patches/patches.h"
#include "scene/scene_table.h"
#include "scene/table_color.h"
#include "sensor/camera_pose.h"
#include "sensor/observation.h"
#include "table/depth_regions.h"
#include "table/table_search.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

/** \brief Whether pixels are of what goes from side to side of the image: a wall, an
 * arm. */
bool isCutTwice(const std::vector<int>& pixels, int width, int height) {
  Region region;
  for (const int c : pixels) {
    const int x = c % width, y = c / width;
    region.sides |= int(x == 0) | int(y == 0) << 1 | int(x == width - 1) << 2 |
                    int(y == height - 1) << 3;
  }
  return !region.cutOnce();
}

/** \brief Of an object's pixels: a smaller piece is a handle, a label, or a scrap of
 * what stands beside it. */
constexpr double GOOD_SHARE = 0.15;

} // namespace

SceneSegments segmentScene(const SceneView& view, int min_pixels) {
  const CellMask above = pixelsAbove(view.table, view.points, view.width, view.height);
  const TableArea area(view.table, view.points, view.width, view.height, view.camera);
  CellMask over = above;
  if (!area.empty())
    for (std::size_t i = 0; i < over.cells.size(); ++i)
      over.cells[i] = over.cells[i] && area.isOver(view.at(int(i)));
  CellMask pixels(view.width, view.height);
  for (const Region& region : regionsOf(view.points, over))
    for (const int c : region.pixels)
      pixels.cells[std::size_t(c)] = 1;
  const TableColor table(view, above);
  table.removeHalo(pixels);
  Patches patches = patchesOf(view, divide(view, pixels));
  const std::vector<bool> rims = table.rimsOf(patches);
  for (std::size_t k = 0; k < rims.size(); ++k)
    if (rims[k])
      patches.list[k].pixels.clear();
  LabelImage labels(view.width, view.height);
  std::uint16_t next = 1;
  for (const Patch& thing : joinPatches(view, std::move(patches))) {
    const std::vector<int> own = withoutStrays(thing.pixels, view.width, view.height);
    if (int(own.size()) < min_pixels || isThin(own, view.width, view.height) ||
        isCutTwice(own, view.width, view.height))
      continue;
    for (const int c : own)
      labels.values[std::size_t(c)] = next;
    ++next;
  }
  table.growFeet(labels);
  return {labels, table.outlined(labels)};
}

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
  ColorMatrix plain; // of a cloud without colours all has one
  if (colors.size() == 0)
    plain.setZero(3, points.cols());
  const SceneView view{seen,
                       mask.width,
                       mask.height,
                       colors.size() > 0 ? colors : plain,
                       camera,
                       pose.toCamera(*object.table),
                       1};
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

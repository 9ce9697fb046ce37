// SPDX-License-Identifier: BSD-3-Clause
// Things told apart (M25): superpixels joined to patches where nothing speaks against
// it, patches to things where the evidence is for one thing.
#include "scene/segment_scene.h"

#include "scene/patches.h"
#include "scene/table_color.h"
#include "sensor/camera_pose.h"
#include "table/depth_regions.h"
#include "table/table_search.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

constexpr double BELOW = 3.0; ///< standing heights below the table: not on it
constexpr double MOST = 0.5;  ///< of what is seen beneath a region
constexpr int BENEATH = 4;    ///< pixels that are looked at: some are missing

/** \brief Whether a region stands beyond the table's edge: beneath its lowest pixels
 * there is neither the table nor another thing, but what lies far below. */
bool besideTheTable(const SceneView& view,
                    const Region& region,
                    const CellMask& above) {
  std::vector<int> lowest(std::size_t(view.width), -1); // of each column
  for (const int c : region.pixels) {
    int& low = lowest[std::size_t(c % view.width)];
    low = std::max(low, c);
  }
  int below = 0, known = 0;
  for (const int c : lowest) {
    if (c < 0)
      continue;
    const int x = c % view.width, y = c / view.width;
    for (int far = 1; far <= BENEATH && y + far < view.height; ++far) {
      const int d = c + far * view.width;
      if (above(x, y + far) || !view.finite(d))
        continue;
      ++known;
      below += view.table.height(view.at(d)) <
               -BELOW * standingHeight(view.table, double(view.points(2, d)));
      break;
    }
  }
  return double(below) > MOST * double(known);
}

/** \brief Of an object's pixels: a smaller piece is a handle, a label, or a scrap of
 * what stands beside it. */
constexpr double GOOD_SHARE = 0.15;

} // namespace

SceneSegments segmentScene(const SceneView& view, int min_pixels) {
  CellMask pixels(view.width, view.height);
  const CellMask above = pixelsAbove(view.table, view.points, view.width, view.height);
  for (const Region& region : regionsOf(view.points, above)) {
    if (!region.cutOnce() || besideTheTable(view, region, above))
      continue;
    for (const int c : region.pixels)
      pixels.cells[std::size_t(c)] = 1;
  }
  const TableColor table(view, above);
  Patches patches = patchesOf(view, divide(view, pixels));
  for (Patch& patch : patches.list)
    if (table.isRim(patch))
      patch.pixels.clear();
  LabelImage labels(view.width, view.height);
  std::uint16_t next = 1;
  for (const Patch& thing : joinPatches(view, std::move(patches))) {
    if (int(thing.pixels.size()) < min_pixels ||
        isThin(thing.pixels, view.width, view.height))
      continue;
    for (const int c : thing.pixels)
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
  const SceneView view{
      seen, mask.width, mask.height, colors, camera, pose.toCamera(*object.table), 1};
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

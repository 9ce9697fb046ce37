// SPDX-License-Identifier: BSD-3-Clause
// An object in an organized cloud: its pixels, outline, points and table.
#include "observe/observe_parts.h"
#include "sensor/depth_patch.h"
#include "table/table_search.h"
#include "tuning/observe_tuning.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

using namespace tuning::observe_image;

/** \brief Sets pixels that most of their neighbours set, within the bounds. */
void fillHoles(CellMask& mask, const CellRect& box) {
  for (int pass = 0; pass < 3; ++pass) {
    const CellMask before = mask;
    for (int y = box.y; y < box.y + box.height; ++y)
      for (int x = box.x; x < box.x + box.width; ++x) {
        if (before(x, y))
          continue;
        int set = 0;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx)
            set += before(x + dx, y + dy);
        if (set >= 5)
          mask.set(x, y);
      }
  }
}

/** \brief Leaves of a region's pixels those of the thing that it was drawn around.
 * \return the plane on which it was found, if it was */
std::optional<TableModel> keepTheThing(Observation& o) {
  const Standing found = findInRegion(o, o.out.pixels);
  if (found.thing.empty())
    return std::nullopt;
  CellMask thing(o.width, o.height);
  for (const int c : found.thing)
    thing.cells[std::size_t(c)] = 1;
  const int left_out = o.out.pixels.count() - thing.count();
  o.out.pixels = std::move(thing);
  if (left_out > 0)
    o.out.notes.push_back(std::to_string(left_out) +
                          " pixels of the region are the table's or another thing's");
  return found.table;
}

} // namespace

bool observeImage(Observation& o, std::string& why) {
  ObservedObject& out = o.out;
  const bool has_mask = !o.view.mask.cells.empty();
  std::optional<TableModel> plane = o.view.table; // beside the object
  out.outline = has_mask ? OutlineSource::MASK : OutlineSource::DEPTH;
  if (has_mask)
    out.pixels = o.view.mask;
  else if (o.object.empty()) {
    const Standing found = findInImage(o.points, o.width, o.height, o.view);
    out.pixels = CellMask(o.width, o.height);
    out.table = found.thing.empty() ? o.view.table : found.table;
    plane = out.table;
    for (const int c : found.thing)
      out.pixels.cells[std::size_t(c)] = 1;
    if (found.thing.empty()) {
      for (int c = 0; c < o.width * o.height; ++c)
        out.pixels.cells[static_cast<std::size_t>(c)] = o.finite(c);
      out.notes.push_back("nothing was found that stands on a table; all points are "
                          "taken as the object; give a region or a mask of it");
    } else
      out.notes.push_back(
          "the object is the largest thing that stands on the table; a region or a "
          "mask chooses another");
  } else {
    out.pixels = CellMask(o.width, o.height);
    for (const int c : o.object)
      out.pixels.cells[static_cast<std::size_t>(c)] = o.finite(c);
    if (o.view.object_is_region)
      plane = keepTheThing(o);
  }
  const CellRect box = boundingRect(out.pixels);
  if (box.area() == 0) {
    why = has_mask ? "the mask is empty; mark the object's pixels"
                   : "the object has no finite point; give another region";
    return false;
  }
  if (!has_mask)
    fillHoles(out.pixels, box);
  if (box.x == 0 || box.y == 0 || box.x + box.width == o.width ||
      box.y + box.height == o.height)
    out.notes.push_back("the image border cuts the object: what lies beyond it was not "
                        "seen, and the model there is a guess");
  const bool sharp = has_mask || (plane && errorsAreIndependent(o, *plane));
  const int rim = sharp ? RIM_OF_MASK : RIM_OF_DEPTH;
  DepthPatch patch(o, box);
  choosePoints(o, box, patch, rim);
  if (out.points.cols() < MIN_IMAGE_POINTS) {
    why = "fewer than " + std::to_string(MIN_IMAGE_POINTS) + " points lie under the " +
          (has_mask ? "mask; it must cover the object"
                    : "object's pixels; give a larger region, or a cloud from nearer");
    return false;
  }
  measure(out);
  out.sideways = lateralNoise(o, patch);
  if (o.view.table)
    out.table = *o.view.table;
  else if (!out.table && o.view.find_table)
    findTable(o, box);
  // its pixels end above the table, or at what hides them
  if (!has_mask || !o.view.others.cells.empty())
    findFoot(o, box, rim);
  checkTable(out);
  findFreeSpace(o, box, FREE_MARGIN + (has_mask ? 0 : rim));
  findGap(o, box);
  out.outline_sigma = sharp ? o.view.mask_sigma : 1.5;
  out.outline_correlation = has_mask ? o.view.mask_correlation : OUTLINE_CORRELATION;
  out.outline_dilation = sharp ? o.view.mask_dilation : 1.5;
  const double missing = has_mask ? 0.0 : missingEdge(o);
  out.outline_offset = missing > 0.0 ? -0.5 * missing : sharp ? 0.0 : FATTENING;
  patch.markOthers(o);
  // just above the table the cluster ends before the object does
  const double floor = has_mask || !out.table ? -1e300 : lowestOutline(out);
  out.contour = contourOf(out.pixels, [&](int x, int y) {
    const int c = y * o.width + x;
    if (!has_mask && out.table && o.finite(c) && out.table->height(o.at(c)) < floor)
      return true;
    return besideAnother(o, patch, x, y) || occluded(o, patch, x, y);
  });
  return true;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// Private. Things in an image: pixels that hang together without a jump in depth.
#pragma once

#include "pcl_sq/cell_mask.h"
#include "pcl_sq/object_view.h"
#include "pcl_sq/superquadric.h"

#include <vector>

namespace pcl_sq::detail {

struct Region {
  std::vector<int> pixels;
  int sides = 0; ///< of the image that cut it, one bit each
  bool cut() const { return sides != 0; }
  /** \brief Cut by one side, as things are at whose edge a picture ends; what goes from
   * side to side is a wall or a floor. */
  bool cutOnce() const { return (sides & (sides - 1)) == 0; }
};

/** \brief All regions of at least a few pixels. \param[in] points in the camera's frame
 */
[[nodiscard]] std::vector<Region> regionsOf(const CloudPoints& points,
                                            const CellMask& above);

/** \brief The largest region that the image border does not cut, with its pieces; if
 * there is none, the largest that but one of its sides cuts.
 * \param[in] points in the camera's frame \param[in] above pixels above the table */
[[nodiscard]] Region
largestThing(const CloudPoints& points, const CellMask& above, const TableModel& table);

/** \brief The pixels of the thing whose box is the given one. It may be in pieces: a
 * bowl's wall and its inside, a handle beyond its own shadow. A piece belongs to it
 * where it lies at its depth, and the box does not cut it or it makes the whole fit the
 * box better. \param[in] size of the box over the depth */
[[nodiscard]] std::vector<int> thingOfBox(const CloudPoints& points,
                                          const CellMask& above,
                                          const CellRect& box,
                                          float size);

} // namespace pcl_sq::detail

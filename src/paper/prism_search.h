// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/prism.h"

namespace pcl_sq {

/** \brief PrismMethod::FIGURE_4, up to the last pass. */
std::vector<CellRect> scanFigure4(const CellMask& mask, const PrismOptions& options);
/** \brief Keeps as many of the largest prisms as merging and dropping can handle. */
void keepLargest(std::vector<CellRect>& rects);
/** \brief Fuses nearly equal prisms. */
void mergePrisms(std::vector<CellRect>& rects, const PrismOptions& options);
/** \brief Drops prisms with fewer than \a least cells of their own; one remains. */
void dropPrisms(const CellMask& mask, std::vector<CellRect>& rects, double least);
/** \brief PrismMethod::RECTANGLES. */
std::vector<CellRect> findRectangles(const CellMask& mask, const PrismOptions& options);

/** \brief Resets the cells of a rectangle. */
inline void clearCells(CellMask& mask, const CellRect& rect) {
  for (int y = rect.y; y < rect.y + rect.height; ++y)
    for (int x = rect.x; x < rect.x + rect.width; ++x)
      mask.set(x, y, false);
}

/** \brief Number of set cells in a rectangle. */
inline int countCells(const CellMask& mask, const CellRect& rect) {
  int count = 0;
  for (int y = rect.y; y < rect.y + rect.height; ++y)
    for (int x = rect.x; x < rect.x + rect.width; ++x)
      count += mask(x, y);
  return count;
}

} // namespace pcl_sq

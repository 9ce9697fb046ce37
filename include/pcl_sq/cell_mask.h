// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/config.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_sq {

/** \brief Rectangle of grid cells or pixels, x to the right and y down as in an image.
 */
struct CellRect {
  int x = 0, y = 0;          ///< leftmost column, topmost row
  int width = 0, height = 0; ///< [cells]

  int area() const { return width * height; }
  bool empty() const { return width <= 0 || height <= 0; }
  bool contains(int column, int row) const {
    return column >= x && row >= y && static_cast<long long>(column) - x < width &&
           static_cast<long long>(row) - y < height;
  }
  bool operator==(const CellRect& o) const {
    return x == o.x && y == o.y && width == o.width && height == o.height;
  }
};

/** \brief Cells that both rectangles hold; of no size where there are none. */
inline CellRect intersection(const CellRect& a, const CellRect& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x,
          y,
          std::max(0, std::min(a.x + a.width, b.x + b.width) - x),
          std::max(0, std::min(a.y + a.height, b.y + b.height) - y)};
}

/** \brief Smallest rectangle that holds both. */
inline CellRect boundingRect(const CellRect& a, const CellRect& b) {
  const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x,
          y,
          std::max(a.x + a.width, b.x + b.width) - x,
          std::max(a.y + a.height, b.y + b.height) - y};
}

/** \brief Which cells of a 2D grid are set; reads false outside of the grid. */
struct CellMask {
  int width = 0, height = 0;
  std::vector<std::uint8_t> cells; ///< row by row, width * height

  CellMask() = default;
  CellMask(int columns, int rows)
      : width(columns), height(rows),
        cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0) {}

  std::size_t indexOf(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
  bool operator()(int column, int row) const {
    return column >= 0 && row >= 0 && column < width && row < height &&
           cells[indexOf(column, row)] != 0;
  }
  void set(int column, int row, bool value = true) {
    cells[indexOf(column, row)] = value;
  }
  int count() const {
    return static_cast<int>(cells.size() - static_cast<std::size_t>(std::count(
                                               cells.begin(), cells.end(), 0)));
  }
};

/** \brief Smallest rectangle that holds all set cells; of no size where there are none.
 */
inline CellRect boundingRect(const CellMask& mask) {
  int x0 = mask.width, x1 = -1, y0 = 0, y1 = -1;
  for (int y = 0; y < mask.height; ++y) {
    const std::uint8_t* row = mask.cells.data() + mask.indexOf(0, y);
    std::uint8_t any = 0; // most rows are empty: seen at once, many cells at a time
    for (int x = 0; x < mask.width; ++x)
      any = static_cast<std::uint8_t>(any | row[x]);
    if (!any)
      continue;
    y0 = y1 < 0 ? y : y0;
    y1 = y;
    int first = 0, last = mask.width - 1;
    while (!row[first])
      ++first;
    while (!row[last])
      --last;
    x0 = std::min(x0, first);
    x1 = std::max(x1, last);
  }
  return y1 < 0 ? CellRect{} : CellRect{x0, y0, x1 - x0 + 1, y1 - y0 + 1};
}

} // namespace pcl_sq

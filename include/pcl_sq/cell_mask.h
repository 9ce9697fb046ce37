// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_sq {

/** \brief Rectangle of grid cells, x to the right and y down as in an image. */
struct CellRect {
  int x = 0, y = 0;          ///< leftmost column, topmost row
  int width = 0, height = 0; ///< [cells]

  int area() const { return width * height; }
  bool contains(int column, int row) const {
    return column >= x && column < x + width && row >= y && row < y + height;
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

} // namespace pcl_sq

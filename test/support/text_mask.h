// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/cell_mask.h"

#include <initializer_list>
#include <random>
#include <string>

namespace pcl_sq::test {

/** \brief A mask drawn as text: '#' is a valid cell. */
inline CellMask mask(std::initializer_list<std::string> rows) {
  CellMask result(static_cast<int>(rows.begin()->size()),
                  static_cast<int>(rows.size()));
  int y = 0;
  for (const std::string& row : rows) {
    for (int x = 0; x < result.width; ++x)
      result.set(x, y, row[static_cast<std::size_t>(x)] == '#');
    ++y;
  }
  return result;
}

/** \brief The drawing of a mask, for messages. */
inline std::string drawing(const CellMask& mask) {
  std::string text;
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x)
      text += mask(x, y) ? '#' : '.';
    text += '\n';
  }
  return text;
}

/** \brief Each cell valid with a probability. */
inline CellMask
randomMask(std::mt19937& engine, int width, int height, double probability) {
  CellMask result(width, height);
  std::bernoulli_distribution coin(probability);
  for (auto& cell : result.cells)
    cell = coin(engine);
  return result;
}

} // namespace pcl_sq::test

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_sq::app {

/** \brief Cells of a line of numbers. Blanks, tabs, commas and semicolons separate;
 * nothing between two commas or semicolons is an empty cell. */
void splitCells(std::string_view line, std::vector<std::string_view>& cells);

/** \brief Which cells of a line are what. */
struct TextColumns {
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::optional<std::array<std::size_t, 3>> colors; ///< red, green, blue
  double color_scale = 1.0;                         ///< to 0..255
  std::size_t names = 0;          ///< cells that the header names; 0 without one
  std::vector<std::string> units; ///< of axes that name theirs, as unitNamed() has it

  /** \brief The same columns behind others. */
  void moveBy(std::size_t columns) {
    for (std::size_t& axis : axes)
      axis += columns;
    for (std::size_t k = 0; k < 3 && colors; ++k)
      (*colors)[k] += columns;
  }
};

/** \brief Reads a header's line, comment marks in front allowed.
 * \return nothing if it does not name x, y and z */
std::optional<TextColumns> readColumnNames(std::string_view line);

/** \brief The unit that a word names: mm for millimetres or [mm], "?ft" for a length
 * that is none of m, cm, mm and in; empty if the word is no unit of length. */
std::string unitNamed(std::string_view word);

/** \brief The unit of a comment: "# unit: mm", "// units = inches". */
std::string unitOfComment(std::string_view line);

/** \brief Whether the commas of a line of numbers are decimal ones: 1,5 2,5 3,5 or
 * 1,5;2,5;3,5. */
bool hasDecimalCommas(std::string_view line);

} // namespace pcl_sq::app

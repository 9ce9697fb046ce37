// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "input/lines.h"
#include "input/scalar.h"

#include <optional>
#include <string>
#include <vector>

namespace pcl_sq::app {

/** \brief A property of a PLY element: a number, or a list with its number in front. */
struct PlyProperty {
  std::string name;
  Scalar type = Scalar::F32;
  std::optional<Scalar> count_type; ///< of lists
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /** \brief Bytes of an item, at least where there are lists. */
  std::size_t bytes() const;
  bool hasLists() const;
};

struct PlyHeader {
  enum class Format { TEXT, LITTLE, BIG } format = Format::TEXT;
  std::vector<PlyElement> elements;
  std::uint64_t grid_columns = 0, grid_rows = 0; ///< obj_info num_cols, num_rows
};

/** \brief Takes the header from \a lines.
 * \throw Failure naming the line */
PlyHeader readPlyHeader(Lines& lines);

} // namespace pcl_sq::app

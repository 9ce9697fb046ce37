// SPDX-License-Identifier: BSD-3-Clause
#include "input/ply_header.h"

#include "command_line/app.h"
#include "report/text.h"

#include <algorithm>

namespace pcl_sq::app {

namespace {

Scalar plyScalar(std::string_view name, std::size_t line) {
  const struct {
    const char *old_name, *new_name;
    Scalar type;
  } types[] = {{"char", "int8", Scalar::I8},
               {"uchar", "uint8", Scalar::U8},
               {"short", "int16", Scalar::I16},
               {"ushort", "uint16", Scalar::U16},
               {"int", "int32", Scalar::I32},
               {"uint", "uint32", Scalar::U32},
               {"long", "int64", Scalar::I64},
               {"ulong", "uint64", Scalar::U64},
               {"float", "float32", Scalar::F32},
               {"double", "float64", Scalar::F64}};
  for (const auto& type : types)
    if (name == type.old_name || name == type.new_name)
      return type.type;
  failInLine(line, app::quoted(name) + " is no type of numbers");
}

void readFormat(std::string_view words, std::size_t line, PlyHeader& header) {
  const std::string_view name = takeWord(words);
  using Format = PlyHeader::Format;
  if (name == "ascii")
    header.format = Format::TEXT;
  else if (name == "binary_little_endian")
    header.format = Format::LITTLE;
  else if (name == "binary_big_endian")
    header.format = Format::BIG;
  else
    failInLine(line,
               app::quoted(name) + " is no format of PLY (ascii, binary_little_endian, "
                                   "binary_big_endian)");
}

void readElement(std::string_view words, std::size_t line, PlyHeader& header) {
  PlyElement element;
  element.name = std::string(takeWord(words));
  const std::string_view count = takeWord(words);
  if (!parseCount(count, element.count))
    failInLine(line, app::quoted(count) + " is no number of elements");
  header.elements.push_back(element);
}

void readProperty(std::string_view words, std::size_t line, PlyHeader& header) {
  if (header.elements.empty())
    failInLine(line, "a property stands before the first element");
  PlyProperty property;
  std::string_view type = takeWord(words);
  if (type == "list") {
    property.count_type = plyScalar(takeWord(words), line);
    type = takeWord(words);
  }
  property.type = plyScalar(type, line);
  property.name = std::string(takeWord(words));
  if (property.name.empty())
    failInLine(line, "the property has no name");
  header.elements.back().properties.push_back(property);
}

} // namespace

std::size_t PlyElement::bytes() const {
  std::size_t sum = 0;
  for (const PlyProperty& p : properties)
    sum += sizeOf(p.count_type.value_or(p.type));
  return sum;
}

bool PlyElement::hasLists() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) {
    return p.count_type.has_value();
  });
}

PlyHeader readPlyHeader(Lines& lines) {
  PlyHeader header;
  std::string_view line;
  if (!lines.next(line) || takeWord(line) != "ply")
    throw Failure("it does not start with the line 'ply'");
  bool has_format = false;
  while (lines.next(line)) {
    const std::string_view key = takeWord(line);
    if (key == "end_header") {
      if (!has_format)
        throw Failure("its PLY header lacks the line 'format'");
      return header;
    }
    if (key == "format") {
      readFormat(line, lines.number(), header);
      has_format = true;
    } else if (key == "element")
      readElement(line, lines.number(), header);
    else if (key == "property")
      readProperty(line, lines.number(), header);
    else if (key == "obj_info") {
      const std::string_view name = takeWord(line);
      if (name == "num_cols")
        parseCount(takeWord(line), header.grid_columns);
      else if (name == "num_rows")
        parseCount(takeWord(line), header.grid_rows);
    } else if (!key.empty() && key != "comment")
      failInLine(lines.number(), app::quoted(key) + " is no word of a PLY header");
  }
  throw Failure("its PLY header has no end: the line 'end_header' is missing");
}

} // namespace pcl_sq::app

// SPDX-License-Identifier: BSD-3-Clause
#include "input/text_columns.h"

#include "input/lines.h"

#include <algorithm>

namespace pcl_sq::app {

namespace {

bool isSpace(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && (isSpace(text.front()) || text.front() == '"'))
    text.remove_prefix(1);
  while (!text.empty() && (isSpace(text.back()) || text.back() == '"'))
    text.remove_suffix(1);
  return text;
}

std::string_view withoutMarks(std::string_view line) {
  while (!line.empty() && (isSpace(line.front()) || line.front() == '#' ||
                           line.front() == '/' || line.front() == '%'))
    line.remove_prefix(1);
  return line;
}

/** \brief Names of a header's line; only one separator there, for "X [m]" is one name.
 */
std::vector<std::string> splitNames(std::string_view line) {
  line = withoutMarks(line);
  std::vector<std::string> names;
  for (const char separator : {';', ',', '\t'}) {
    if (line.find(separator) == std::string_view::npos)
      continue;
    while (!line.empty()) {
      const std::size_t end = std::min(line.find(separator), line.size());
      names.push_back(lowered(trimmed(line.substr(0, end))));
      line.remove_prefix(std::min(end + 1, line.size()));
    }
    return names;
  }
  for (auto word = takeWord(line); !word.empty(); word = takeWord(line))
    if (!names.empty() && (word.front() == '[' || word.front() == '('))
      names.back() += lowered(trimmed(word)); // X [m] Y [m] Z [m]
    else
      names.push_back(lowered(trimmed(word)));
  return names;
}

/** \brief Takes the unit off the end of an axis' name: x [mm], x(mm), x_mm, x/mm, x in
 * mm. \return the unit, or nothing */
std::string takeUnit(std::string& name) {
  std::string unit;
  if (const std::size_t bracket = name.find_first_of("[(");
      bracket != std::string::npos) {
    if (name.back() == ']' || name.back() == ')')
      unit = unitNamed(std::string_view(name).substr(bracket));
    name.resize(bracket);
  } else if (const std::size_t joint = name.find_last_of("_./- ");
             joint != std::string::npos && joint > 0) {
    unit = unitNamed(std::string_view(name).substr(joint + 1));
    if (!unit.empty())
      name.resize(joint);
  }
  while (!name.empty() && isSpace(name.back()))
    name.pop_back();
  if (!unit.empty() && name.size() > 3 && name.substr(name.size() - 3) == " in")
    name.resize(name.size() - 3);
  return unit;
}

/** \brief Whether a name, without its unit, means an axis: x, pos_x, points:0. */
bool meansAxis(const std::string& name, std::size_t axis) {
  const char letter = static_cast<char>('x' + axis);
  if (name == std::string(1, letter) || name == "points:" + std::to_string(axis))
    return true;
  for (const char* stem : {"p", "pos", "position", "point", "points", "coord"})
    for (const char* joint : {"_", ".", ":", ""})
      if (name == std::string(stem) + joint + letter)
        return true;
  for (const char* ending : {"_coord", "coord", "_coordinate"})
    if (name == letter + std::string(ending))
      return true;
  const char* const surveyors[] = {"easting", "northing", "height"};
  return name == surveyors[axis] || (axis == 2 && name == "elevation");
}

/** \brief Place of the first name that is one of \a wanted. */
std::optional<std::size_t> placeOf(const std::vector<std::string>& names,
                                   std::initializer_list<const char*> wanted) {
  for (const char* name : wanted)
    for (std::size_t k = 0; k < names.size(); ++k)
      if (names[k] == name)
        return k;
  return std::nullopt;
}

} // namespace

std::string unitNamed(std::string_view word) {
  std::string name = lowered(trimmed(word));
  for (const char* mark : {"[", "]", "(", ")"})
    if (const std::size_t at = name.find(mark); at != std::string::npos)
      name.erase(at, 1);
  name = std::string(trimmed(name));
  if (name.size() > 4 && name.back() == 's')
    name.pop_back(); // meters
  const struct {
    const char* unit;
    std::initializer_list<const char*> names;
  } units[] = {
      {"m", {"m", "meter", "metre"}},
      {"cm", {"cm", "centimeter", "centimetre"}},
      {"mm", {"mm", "millimeter", "millimetre"}},
      {"in", {"in", "inch", "inche", "\""}},
      {"?", {"um", "\xc2\xb5m", "\xce\xbcm", "micron", "micrometer", "micrometre"}},
      {"?", {"nm", "dm", "km", "ft", "foot", "feet", "yd", "yard"}}};
  for (const auto& [unit, names] : units)
    for (const char* known : names)
      if (name == known)
        return unit[0] == '?' ? unit + name : unit;
  return {};
}

std::string unitOfComment(std::string_view line) {
  line = withoutMarks(line);
  const std::string word = lowered(takeWord(line));
  const std::string key = word.substr(0, word.find_first_of(":="));
  if (key != "unit" && key != "units")
    return {};
  std::string rest = word.substr(key.size()) + std::string(line);
  rest.erase(0, rest.find_first_not_of(":= \t"));
  return unitNamed(rest);
}

void splitCells(std::string_view line, std::vector<std::string_view>& cells) {
  cells.clear();
  std::size_t at = 0;
  const auto skipBlanks = [&] {
    while (at < line.size() && isSpace(line[at]))
      ++at;
  };
  for (skipBlanks(); at < line.size(); skipBlanks()) {
    const std::size_t begin = at;
    while (at < line.size() && !isSpace(line[at]) && line[at] != ',' && line[at] != ';')
      ++at;
    std::string_view cell = line.substr(begin, at - begin);
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"')
      cell = cell.substr(1, cell.size() - 2);
    cells.push_back(cell);
    skipBlanks();
    if (at >= line.size() || (line[at] != ',' && line[at] != ';'))
      continue;
    ++at;
    if (at == line.size() && cells.size() < 3)
      cells.emplace_back(); // "1;2;": the third number is the missing one
  }
}

std::optional<TextColumns> readColumnNames(std::string_view line) {
  std::vector<std::string> names = splitNames(line);
  std::vector<std::string> units;
  for (std::string& name : names)
    units.push_back(takeUnit(name));
  TextColumns columns;
  columns.names = names.size();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::size_t matches = 0;
    for (std::size_t k = 0; k < names.size(); ++k)
      if (meansAxis(names[k], axis)) {
        columns.axes[axis] = k;
        ++matches;
      }
    if (matches != 1)
      return std::nullopt;
  }
  for (const std::size_t k : columns.axes)
    if (!units[k].empty())
      columns.units.push_back(units[k]);
  const auto red = placeOf(names, {"r", "red"}), green = placeOf(names, {"g", "green"}),
             blue = placeOf(names, {"b", "blue"});
  if (red && green && blue)
    columns.colors = {*red, *green, *blue};
  // CloudCompare's floats
  const auto rf = placeOf(names, {"rf"}), gf = placeOf(names, {"gf"}),
             bf = placeOf(names, {"bf"});
  if (rf && gf && bf) {
    columns.colors = {*rf, *gf, *bf};
    columns.color_scale = 255.0;
  }
  return columns;
}

bool hasDecimalCommas(std::string_view line) {
  while (!line.empty() && (isSpace(line.back()) || line.back() == ';'))
    line.remove_suffix(1); // as lists of numbers in code end
  const bool semicolons = line.find(';') != std::string_view::npos;
  if (line.find(',') == std::string_view::npos ||
      (!semicolons && line.find('.') != std::string_view::npos))
    return false;
  // each piece with a comma is one number, and there are several pieces
  std::size_t pieces = 0, numbers = 0;
  while (!line.empty()) {
    std::string_view piece = line.substr(0, line.find(';'));
    if (semicolons)
      line.remove_prefix(std::min(piece.size() + 1, line.size()));
    else
      piece = takeWord(line);
    pieces += !piece.empty();
    const std::size_t comma = piece.find(',');
    if (comma == std::string_view::npos)
      continue;
    if (comma == 0 || comma + 1 == piece.size() || !isDigit(piece[comma - 1]) ||
        !isDigit(piece[comma + 1]) ||
        piece.find(',', comma + 1) != std::string_view::npos)
      return false;
    ++numbers;
  }
  return pieces >= 3 && numbers > 0;
}

} // namespace pcl_sq::app

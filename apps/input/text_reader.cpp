// SPDX-License-Identifier: BSD-3-Clause
// Lines of numbers: .xyz, .txt, .asc, .csv, .pts ...
#include "command_line/app.h"
#include "input/lines.h"
#include "input/shape.h"
#include "input/text_columns.h"
#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_sq::app {

namespace {

class TextReader {
public:
  /** \param[in] first_column of the numbers; those before it are no coordinates */
  explicit TextReader(std::string_view bytes, std::size_t first_column = 0)
      : lines_(bytes), first_column_(first_column) {}

  /** \brief Whether the first of more columns than coordinates counts the lines, from 0
   * or from 1: points in a row with such coordinates are none of a surface. */
  bool isNumbered() const {
    constexpr std::size_t CHANCE = 8; // lines that may count by accident
    return counting_ && counted_ >= CHANCE;
  }

  Shape read() {
    std::string_view line;
    while (lines_.next(line)) {
      std::string_view rest = line;
      const std::string_view word = takeWord(rest);
      if (word.empty())
        continue;
      if (word[0] == '#' || word[0] == '%' || word.substr(0, 2) == "//")
        readComment(line);
      else if (hasDecimalCommas(line))
        failInLine(lines_.number(), DECIMAL_COMMAS);
      else
        readCells(line);
    }
    if (promised_ > shape_.points.size())
      throw Failure("its first line promises " + std::to_string(promised_) +
                    " points, but it holds " + std::to_string(shape_.points.size()) +
                    "; it is truncated");
    return std::move(shape_);
  }

private:
  void readComment(std::string_view line) {
    if (!shape_.points.empty())
      return;
    takeUnit(unitOfComment(line));
    if (const auto columns = readColumnNames(line); columns && !has_header_) {
      columns_ = columns;
      takeUnits();
    }
  }

  void takeUnits() {
    for (const std::string& unit : columns_->units)
      takeUnit(unit);
  }

  void takeUnit(const std::string& unit) {
    if (unit.empty())
      return;
    if (unit[0] == '?')
      failInLine(lines_.number(),
                 "the unit " + unit.substr(1) +
                     " of its header is none of mm, cm, m and in; convert the numbers");
    if (!shape_.unit.empty() && shape_.unit != unit)
      failInLine(lines_.number(),
                 "its header names two units, " + shape_.unit + " and " + unit +
                     "; correct it");
    shape_.unit = unit;
  }

  /** \brief A line of units below the line of names. */
  bool readUnits() {
    if (!has_header_ || cells_.size() != columns_->names ||
        unitNamed(cells_[columns_->axes[0]]).empty())
      return false;
    for (const std::size_t k : columns_->axes)
      takeUnit(unitNamed(cells_[k]));
    return true;
  }

  void readCells(std::string_view line) {
    splitCells(line, cells_);
    if (shape_.points.empty() && (readCount() || readUnits() || readNames(line)))
      return;
    if (shape_.points.empty())
      start(line);
    if (pairs_ && areTorn())
      failInLine(lines_.number(), DECIMAL_COMMAS);
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t k = columns_->axes[axis];
      if (k >= cells_.size())
        failInLine(lines_.number(),
                   columns_->names == 0 ? "it does not hold three numbers"
                                        : std::to_string(cells_.size()) +
                                              " values, but the header names " +
                                              std::to_string(columns_->names));
      double value = std::numeric_limits<double>::quiet_NaN();
      if (!cells_[k].empty() && !parseNumber(cells_[k], value))
        failInLine(lines_.number(), whyNoNumber(cells_[k]));
      point[static_cast<Eigen::Index>(axis)] = value;
    }
    follow();
    shape_.points.push_back(point);
    if (columns_->colors)
      readColor();
  }

  /** \brief A number of points alone on its line, as .pts files begin. */
  bool readCount() {
    std::uint64_t count = 0;
    if (cells_.size() != 1 || !parseCount(cells_[0], count))
      return false;
    if (has_count_)
      failInLine(
          lines_.number(),
          "a second number of points, as a PTX file has; export the cloud as PCD, "
          "PLY or text without a header");
    has_count_ = true;
    promised_ = count;
    return true;
  }

  /** \brief A line of words in front of the numbers. */
  bool readNames(std::string_view line) {
    double value = 0.0;
    std::size_t words = 0;
    for (const std::string_view cell : cells_) {
      if (parseNumber(cell, value))
        return false;
      words += !cell.empty();
    }
    if (has_header_ || words == 0)
      return false;
    columns_ = readColumnNames(line);
    if (!columns_)
      failInLine(
          lines_.number(),
          app::quoted(line) +
              " is neither three numbers nor does it name the columns x, y and z");
    has_header_ = true;
    takeUnits();
    return true;
  }

  /** \brief The header against the first line of numbers. */
  void start(std::string_view line) {
    const std::size_t count = cells_.size();
    const std::size_t names = columns_ ? columns_->names : 0;
    if (names > 0 && count == 2 * names && line.find(',') != std::string_view::npos)
      failInLine(lines_.number(), DECIMAL_COMMAS);
    if (names > count && has_header_)
      failInLine(lines_.number(),
                 std::to_string(count) + " values, but the header names " +
                     std::to_string(names));
    if (names + first_column_ != count && !has_header_)
      columns_.reset(); // a comment like any other
    pairs_ = count >= 6 && count % 2 == 0 && line.find(',') != std::string_view::npos;
    if (columns_) {
      if (first_column_ + names == count)
        columns_->moveBy(first_column_);
      return;
    }
    columns_ = TextColumns();
    columns_->moveBy(first_column_);
    // .pts: x y z intensity r g b; all else: x y z r g b
    const std::size_t more = first_column_;
    const std::size_t red = more + (has_count_ && count >= more + 7 ? 4 : 3);
    if (count >= red + 3)
      columns_->colors = {red, red + 1, red + 2};
  }

  /** \brief Whether the first column goes on counting. */
  void follow() {
    const std::size_t named = columns_->names;
    double value = -1.0;
    const bool spare = named == 0 ? cells_.size() > 3 : cells_.size() == named + 1;
    if (!counting_ || !spare || !parseNumber(cells_[0], value)) {
      counting_ = false;
      return;
    }
    if (counted_ == 0)
      counted_from_ = value;
    counting_ = (counted_from_ == 0.0 || counted_from_ == 1.0) &&
                value == counted_from_ + static_cast<double>(counted_++);
  }

  /** \brief Whether the cells are what decimal commas tear apart: 0,0075 -> 0 0075. */
  bool areTorn() const {
    bool zero = false;
    for (const std::string_view cell : cells_) {
      if (cell.find_first_not_of("-+0123456789") != std::string_view::npos)
        return false;
      zero = zero || (cell.size() > 1 && cell[0] == '0');
    }
    return zero;
  }

  /** \brief Three levels of 0 to 255; a line that has none shows that they are no
   * colours (normals, for example). */
  void readColor() {
    std::uint32_t color = 0;
    for (const std::size_t k : *columns_->colors) {
      double level = -1.0;
      if (k >= cells_.size() || !parseNumber(cells_[k], level))
        level = -1.0;
      level *= columns_->color_scale;
      const bool whole = columns_->color_scale != 1.0 || level == std::floor(level);
      if (!(level >= 0.0 && level <= 255.0 && whole)) {
        columns_->colors.reset();
        shape_.colors.clear();
        return;
      }
      color = color << 8U | static_cast<std::uint32_t>(std::lround(level));
    }
    shape_.colors.push_back(color);
  }

  Lines lines_;
  std::size_t first_column_;
  bool counting_ = true;      ///< the first column, so far
  double counted_from_ = 0.0; ///< its first number
  std::size_t counted_ = 0;   ///< lines
  std::vector<std::string_view> cells_;
  std::optional<TextColumns> columns_;
  bool has_count_ = false, has_header_ = false;
  bool pairs_ = false; ///< commas, and an even number of cells
  std::uint64_t promised_ = 0;
  Shape shape_;
};

} // namespace

Shape readText(std::string_view bytes) {
  TextReader reader(bytes);
  Shape shape = reader.read();
  if (!reader.isNumbered())
    return shape;
  shape = TextReader(bytes, 1).read();
  shape.notes.emplace_back("the first column counts the lines, so x, y and z are taken "
                           "from the columns after it");
  return shape;
}

} // namespace pcl_sq::app

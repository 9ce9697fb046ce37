// SPDX-License-Identifier: BSD-3-Clause
#include "input/pcd_header.h"

#include "command_line/app.h"
#include "report/text.h"

#include <cmath>
#include <optional>

namespace pcl_sq::app {

namespace {

std::optional<Scalar> pcdScalar(std::string_view type, std::uint64_t size) {
  const Scalar signed_types[] = {Scalar::I8, Scalar::I16, Scalar::I32, Scalar::I64};
  const Scalar unsigned_types[] = {Scalar::U8, Scalar::U16, Scalar::U32, Scalar::U64};
  if (type == "F" && size == 8)
    return Scalar::F64;
  if (type == "F" && size == 4)
    return Scalar::F32;
  for (unsigned k = 0; k < 4; ++k)
    if (size == 1U << k && (type == "I" || type == "U"))
      return type == "I" ? signed_types[k] : unsigned_types[k];
  return std::nullopt;
}

class HeaderReader {
public:
  explicit HeaderReader(Lines& lines) : lines_(lines) {}

  PcdHeader read() {
    readLines();
    layOut();
    return std::move(header_);
  }

private:
  using Words = std::vector<std::string_view>;

  void readLines() {
    std::string_view line;
    while (header_.kind.empty()) {
      if (!lines_.next(line))
        throw Failure("it has no PCD header: no line starts with DATA");
      const std::string key = lowered(takeWord(line));
      Words words;
      for (auto word = takeWord(line); !word.empty(); word = takeWord(line))
        words.push_back(word);
      if (key == "fields" || key == "columns")
        names_ = words;
      else if (key == "size")
        sizes_ = counts(words, "SIZE");
      else if (key == "type")
        types_ = words;
      else if (key == "count")
        counts_ = counts(words, "COUNT");
      else if (key == "width")
        width_ = count(words, "WIDTH");
      else if (key == "height")
        height_ = count(words, "HEIGHT");
      else if (key == "points")
        points_ = count(words, "POINTS");
      else if (key == "viewpoint")
        readViewpoint(words);
      else if (key == "data")
        readKind(words);
      // other lines are comments of some program
    }
  }

  std::vector<std::uint64_t> counts(const Words& words, const char* key) const {
    std::vector<std::uint64_t> values;
    for (const std::string_view word : words) {
      values.emplace_back();
      if (!parseCount(word, values.back()))
        failInLine(lines_.number(),
                   std::string(key) + " " + quoted(word) + " is no count");
    }
    return values;
  }

  std::uint64_t count(const Words& words, const char* key) const {
    const auto values = counts(words, key);
    constexpr std::uint64_t MOST = 0xffffffffU; // PCL's own limit; products fit
    if (values.size() != 1 || values[0] > MOST)
      failInLine(lines_.number(), std::string(key) + " needs one number of points");
    return values[0];
  }

  void readViewpoint(const Words& words) {
    double v[7] = {};
    bool good = words.size() == 7;
    for (std::size_t k = 0; k < 7 && good; ++k)
      good = parseNumber(words[k], v[k]) && std::isfinite(v[k]);
    const Eigen::Quaterniond turn(v[3], v[4], v[5], v[6]);
    if (!good || !(turn.norm() > 0.0) || !std::isfinite(turn.norm()))
      failInLine(lines_.number(),
                 "VIEWPOINT needs seven numbers: a place x y z and a turn w x y z");
    header_.origin = Eigen::Vector3d(v[0], v[1], v[2]);
    header_.orientation = turn.normalized();
  }

  void readKind(const Words& words) {
    header_.kind = words.empty() ? "" : lowered(words[0]);
    if (header_.kind != "ascii" && header_.kind != "binary" &&
        header_.kind != "binary_compressed")
      failInLine(lines_.number(),
                 "DATA " + (words.empty() ? "" : quoted(words[0])) +
                     " is none of ascii, binary and binary_compressed");
  }

  /** \brief Where each field of a point lies, and whether the file backs the points. */
  void layOut() {
    if (names_.empty())
      throw Failure("its PCD header lacks the line FIELDS");
    const auto fits = [&](std::size_t size, const char* key) {
      if (size != 0 && size != names_.size())
        throw Failure("its PCD header has " + std::to_string(names_.size()) +
                      " FIELDS but " + std::to_string(size) + " of " + key);
    };
    fits(sizes_.size(), "SIZE");
    fits(types_.size(), "TYPE");
    fits(counts_.size(), "COUNT");
    const std::uint64_t body = lines_.rest().size();
    for (std::size_t k = 0; k < names_.size(); ++k) {
      PcdField field;
      field.name = std::string(names_[k]);
      const std::uint64_t size = sizes_.empty() ? 4 : sizes_[k];
      const std::string_view type = types_.empty() ? "F" : types_[k];
      const auto scalar = pcdScalar(type, size);
      if (!scalar)
        throw Failure("its field " + quoted(names_[k]) + " has TYPE " + quoted(type) +
                      " SIZE " + std::to_string(size) + ", which is no number");
      field.type = *scalar;
      field.count = counts_.empty() ? 1 : counts_[k];
      if (field.count > body + 1)
        throw Failure("its field " + quoted(names_[k]) + " has an impossible COUNT " +
                      std::to_string(field.count));
      field.offset = header_.point_bytes;
      field.position = header_.point_values;
      header_.point_bytes += field.count * size;
      header_.point_values += field.count;
      header_.fields.push_back(field);
    }
    for (std::size_t k = 0; k < 3; ++k)
      header_.axes[k] = axis(k);
    for (const char* name : {"rgb", "rgba"})
      if (const int k = find(name); k >= 0 && header_.color < 0) {
        const PcdField& field = header_.fields[std::size_t(k)];
        if (sizeOf(field.type) == 4 && field.count == 1)
          header_.color = k;
      }
    header_.total = width_ ? *width_ * height_.value_or(1) : points_.value_or(0);
    if (!width_ && !points_)
      throw Failure("its PCD header lacks the line WIDTH");
    if (points_ && *points_ != header_.total)
      throw Failure("its PCD header's WIDTH x HEIGHT differs from its POINTS");
    header_.width = static_cast<std::uint32_t>(width_.value_or(header_.total));
    header_.height = static_cast<std::uint32_t>(width_ ? height_.value_or(1) : 1);
    // a digit and a separator for each number of a text, without the last separator
    const std::uint64_t least =
        header_.kind == "ascii" ? 2 * header_.point_values : header_.point_bytes;
    const std::uint64_t available = header_.kind == "ascii" ? body + 1 : body;
    if (header_.kind != "binary_compressed" && header_.total > available / least)
      throw Failure("its header promises " + std::to_string(header_.total) +
                    " points, but it holds " + std::to_string(available / least) +
                    " at most; it is truncated or corrupt");
  }

  int find(const std::string& name) const {
    for (std::size_t k = 0; k < header_.fields.size(); ++k)
      if (header_.fields[k].name == name)
        return int(k);
    return -1;
  }

  std::size_t axis(std::size_t k) const {
    const std::string name(1, static_cast<char>('x' + k));
    int place = find(name);
    if (place < 0)
      place = find(std::string(1, static_cast<char>('X' + k)));
    if (place < 0)
      throw Failure("it has no field '" + name + "'");
    const std::uint64_t count = header_.fields[std::size_t(place)].count;
    if (count != 1)
      throw Failure("its field '" + name + "' holds " + std::to_string(count) +
                    " numbers instead of one");
    return std::size_t(place);
  }

  Lines& lines_;
  PcdHeader header_;
  Words names_, types_;
  std::vector<std::uint64_t> sizes_, counts_;
  std::optional<std::uint64_t> width_, height_, points_;
};

} // namespace

PcdHeader readPcdHeader(Lines& lines) {
  return HeaderReader(lines).read();
}

} // namespace pcl_sq::app

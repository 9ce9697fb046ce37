// SPDX-License-Identifier: BSD-3-Clause
// PCD: text, binary and compressed, versions .5 to .7.
#include "command_line/app.h"
#include "input/lines.h"
#include "input/scalar.h"
#include "input/shape.h"
#include "report/text.h"

#include <pcl/io/lzf.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <optional>

namespace pcl_sq::app {

namespace {

struct Field {
  std::string name;
  Scalar type = Scalar::F32;
  std::uint64_t count = 1;    ///< numbers of a point
  std::uint64_t offset = 0;   ///< bytes of a point before it
  std::uint64_t position = 0; ///< numbers of a point before it
};

std::optional<Scalar> scalarOf(std::string_view type, std::uint64_t size) {
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

class PcdReader {
public:
  explicit PcdReader(std::string_view bytes) : lines_(bytes) {}

  Shape read() {
    readHeader();
    layOut();
    if (kind_ == "ascii")
      readLines();
    else if (kind_ == "binary")
      decode(lines_.rest().data(), false);
    else {
      const std::unique_ptr<char[]> data = unpack();
      decode(data.get(), true);
    }
    return std::move(shape_);
  }

private:
  using Words = std::vector<std::string_view>;

  void readHeader() {
    std::string_view line;
    while (kind_.empty()) {
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
                   std::string(key) + " " + app::quoted(word) + " is no count");
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
    shape_.origin = Eigen::Vector3d(v[0], v[1], v[2]);
    shape_.orientation = turn.normalized();
  }

  void readKind(const Words& words) {
    kind_ = words.empty() ? "" : lowered(words[0]);
    if (kind_ != "ascii" && kind_ != "binary" && kind_ != "binary_compressed")
      failInLine(lines_.number(),
                 "DATA " + (words.empty() ? "" : app::quoted(words[0])) +
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
      Field field;
      field.name = std::string(names_[k]);
      const std::uint64_t size = sizes_.empty() ? 4 : sizes_[k];
      const std::string_view type = types_.empty() ? "F" : types_[k];
      const auto scalar = scalarOf(type, size);
      if (!scalar)
        throw Failure("its field " + app::quoted(names_[k]) + " has TYPE " +
                      app::quoted(type) + " SIZE " + std::to_string(size) +
                      ", which is no number");
      field.type = *scalar;
      field.count = counts_.empty() ? 1 : counts_[k];
      if (field.count > body + 1)
        throw Failure("its field " + app::quoted(names_[k]) +
                      " has an impossible COUNT " + std::to_string(field.count));
      field.offset = point_bytes_;
      field.position = point_values_;
      point_bytes_ += field.count * size;
      point_values_ += field.count;
      fields_.push_back(field);
    }
    for (std::size_t k = 0; k < 3; ++k)
      axes_[k] = axis(k);
    for (const char* name : {"rgb", "rgba"})
      if (const Field* field = find(name);
          field && !color_ && sizeOf(field->type) == 4 && field->count == 1)
        color_ = field;
    total_ = width_ ? *width_ * height_.value_or(1) : points_.value_or(0);
    if (!width_ && !points_)
      throw Failure("its PCD header lacks the line WIDTH");
    if (points_ && *points_ != total_)
      throw Failure("its PCD header's WIDTH x HEIGHT differs from its POINTS");
    shape_.width = static_cast<std::uint32_t>(width_.value_or(total_));
    shape_.height = static_cast<std::uint32_t>(width_ ? height_.value_or(1) : 1);
    // a digit and a separator for each number of a text, without the last separator
    const std::uint64_t least = kind_ == "ascii" ? 2 * point_values_ : point_bytes_;
    const std::uint64_t available = kind_ == "ascii" ? body + 1 : body;
    if (kind_ != "binary_compressed" && total_ > available / least)
      throw Failure("its header promises " + std::to_string(total_) +
                    " points, but it holds " + std::to_string(available / least) +
                    " at most; it is truncated or corrupt");
  }

  const Field* find(const std::string& name) const {
    for (const Field& field : fields_)
      if (field.name == name)
        return &field;
    return nullptr;
  }

  const Field* axis(std::size_t k) const {
    const std::string name(1, static_cast<char>('x' + k));
    const Field* field = find(name);
    if (!field)
      field = find(std::string(1, static_cast<char>('X' + k)));
    if (!field)
      throw Failure("it has no field '" + name + "'");
    if (field->count != 1)
      throw Failure("its field '" + name + "' holds " + std::to_string(field->count) +
                    " numbers instead of one");
    return field;
  }

  void readLines() {
    shape_.points.reserve(total_);
    std::string_view line;
    while (shape_.points.size() < total_) {
      if (!lines_.next(line))
        throw Failure("its header promises " + std::to_string(total_) +
                      " points, but it ends after " +
                      std::to_string(shape_.points.size()) + "; it is truncated");
      std::string_view word = takeWord(line);
      if (word.empty() || word[0] == '#' || word.substr(0, 2) == "//")
        continue;
      readPoint(word, line);
    }
  }

  void readPoint(std::string_view word, std::string_view line) {
    Eigen::Vector3d point;
    double color = 0.0;
    for (std::uint64_t position = 0; position < point_values_; ++position) {
      if (word.empty())
        failInLine(lines_.number(),
                   std::to_string(position) + " numbers instead of " +
                       std::to_string(point_values_));
      for (std::size_t k = 0; k < 3; ++k)
        if (axes_[k]->position == position &&
            !parseNumber(word, point[Eigen::Index(k)]))
          failInLine(lines_.number(), app::quoted(word) + " is no number");
      if (color_ && color_->position == position && !parseNumber(word, color))
        failInLine(lines_.number(), app::quoted(word) + " is no colour");
      word = takeWord(line);
    }
    shape_.points.push_back(point);
    if (color_)
      shape_.colors.push_back(colorOf(color));
  }

  /** \brief A colour of a text: the bits of a float, or their value as an integer. */
  std::uint32_t colorOf(double value) const {
    constexpr double MOST = 4294967296.0;
    const bool integer = value >= 1.0 && value < MOST && value == std::floor(value);
    std::uint32_t bits = 0;
    if (color_->type != Scalar::F32 || integer) {
      if (value > -MOST && value < MOST)
        bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
    } else {
      const float single = static_cast<float>(value);
      std::memcpy(&bits, &single, sizeof(bits));
    }
    return bits & 0xffffffU;
  }

  /** \brief The compressed numbers: all of the first field, all of the second ... */
  std::unique_ptr<char[]> unpack() const {
    constexpr std::uint64_t MAX_RATIO = 300; // LZF packs at most 264 bytes into 3
    const std::string_view body = lines_.rest();
    std::uint32_t packed = 0, unpacked = 0;
    if (body.size() >= 8) {
      std::memcpy(&packed, body.data(), 4);
      std::memcpy(&unpacked, body.data() + 4, 4);
    }
    const bool backed =
        body.size() >= 8 && packed <= body.size() - 8 && unpacked <= MAX_RATIO * packed;
    if (!backed || unpacked % point_bytes_ != 0 || unpacked / point_bytes_ != total_)
      throw Failure("its compressed data are not the " + std::to_string(total_) +
                    " points that the header promises; it is truncated or corrupt");
    std::unique_ptr<char[]> data(new char[unpacked + 1]);
    if (unpacked > 0 &&
        pcl::lzfDecompress(body.data() + 8, packed, data.get(), unpacked) != unpacked)
      throw Failure("its compressed data are corrupt");
    return data;
  }

  void decode(const char* data, bool by_fields) {
    shape_.points.resize(total_);
    const auto start = [&](const Field& f) {
      return data + (by_fields ? total_ * f.offset : f.offset);
    };
    const auto stride = [&](const Field& f) {
      return by_fields ? f.count * sizeOf(f.type) : point_bytes_;
    };
    if (total_ == 0)
      return;
    for (std::size_t k = 0; k < 3; ++k)
      decodeColumn(start(*axes_[k]),
                   stride(*axes_[k]),
                   total_,
                   axes_[k]->type,
                   false,
                   shape_.points[0].data() + k,
                   3);
    if (!color_)
      return;
    shape_.colors.resize(total_);
    for (std::size_t i = 0; i < total_; ++i) {
      std::memcpy(&shape_.colors[i], start(*color_) + i * stride(*color_), 4);
      shape_.colors[i] &= 0xffffffU;
    }
  }

  Lines lines_;
  Words names_, types_;
  std::vector<std::uint64_t> sizes_, counts_;
  std::optional<std::uint64_t> width_, height_, points_;
  std::string kind_;
  std::vector<Field> fields_;
  std::uint64_t point_bytes_ = 0, point_values_ = 0, total_ = 0;
  const Field* axes_[3] = {};
  const Field* color_ = nullptr;
  Shape shape_;
};

} // namespace

Shape readPcd(std::string_view bytes) {
  return PcdReader(bytes).read();
}

} // namespace pcl_sq::app

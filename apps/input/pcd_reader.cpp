// SPDX-License-Identifier: BSD-3-Clause
// PCD: text, binary and compressed, versions .5 to .7.
#include "command_line/app.h"
#include "files/pcd_codec.h"
#include "input/pcd_header.h"
#include "input/shape.h"
#include "report/text.h"

#include <cmath>
#include <cstring>
#include <memory>

namespace pcl_sq::app {

namespace {

class PcdReader {
public:
  explicit PcdReader(std::string_view bytes)
      : lines_(bytes),
        header_(readPcdHeader(lines_)), axes_{&header_.fields[header_.axes[0]],
                                              &header_.fields[header_.axes[1]],
                                              &header_.fields[header_.axes[2]]},
        color_(header_.color < 0 ? nullptr
                                 : &header_.fields[std::size_t(header_.color)]) {
    shape_.width = header_.width;
    shape_.height = header_.height;
    shape_.origin = header_.origin;
    shape_.orientation = header_.orientation;
  }

  Shape read() {
    if (header_.kind == "ascii")
      readLines();
    else if (header_.kind == "binary") {
      if (!isPadding(lines_.rest().substr(header_.total * header_.point_bytes)))
        throw Failure(morePoints());
      decode(lines_.rest().data(), false);
    } else {
      const std::unique_ptr<char[]> data = unpack();
      decode(data.get(), true);
    }
    return std::move(shape_);
  }

private:
  std::string morePoints() const {
    return "it holds more than the " + std::to_string(header_.total) +
           " points that its header promises; correct WIDTH, HEIGHT and POINTS, or "
           "write "
           "it again";
  }

  void readLines() {
    shape_.points.reserve(header_.total);
    std::string_view line;
    while (shape_.points.size() < header_.total) {
      if (!lines_.next(line))
        throw Failure("its header promises " + std::to_string(header_.total) +
                      " points, but it ends after " +
                      std::to_string(shape_.points.size()) + "; it is truncated");
      std::string_view word = takeWord(line);
      if (word.empty() || word[0] == '#' || word.substr(0, 2) == "//")
        continue;
      readPoint(word, line);
    }
    while (lines_.next(line)) {
      const std::string_view word = takeWord(line);
      if (!isPadding(word) && word[0] != '#' && word.substr(0, 2) != "//")
        failInLine(lines_.number(), morePoints());
    }
  }

  void readPoint(std::string_view word, std::string_view line) {
    Eigen::Vector3d point;
    double color = 0.0;
    for (std::uint64_t position = 0; position < header_.point_values; ++position) {
      if (word.empty())
        failInLine(lines_.number(),
                   std::to_string(position) + " numbers instead of " +
                       std::to_string(header_.point_values));
      for (std::size_t k = 0; k < 3; ++k)
        if (axes_[k]->position == position &&
            !parseNumber(word, point[Eigen::Index(k)]))
          failInLine(lines_.number(), whyNoNumber(word));
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
    if (!backed || unpacked % header_.point_bytes != 0 ||
        unpacked / header_.point_bytes != header_.total)
      throw Failure("its compressed data are not the " + std::to_string(header_.total) +
                    " points that the header promises; it is truncated or corrupt");
    std::unique_ptr<char[]> data(new char[unpacked + 1]);
    if (unpacked > 0 &&
        pcdCodec().unpack(body.data() + 8, packed, data.get(), unpacked) != unpacked)
      throw Failure("its compressed data are corrupt");
    return data;
  }

  void decode(const char* data, bool by_fields) {
    shape_.points.resize(header_.total);
    const auto start = [&](const PcdField& f) {
      return data + (by_fields ? header_.total * f.offset : f.offset);
    };
    const auto stride = [&](const PcdField& f) {
      return by_fields ? f.count * sizeOf(f.type) : header_.point_bytes;
    };
    if (header_.total == 0)
      return;
    for (std::size_t k = 0; k < 3; ++k)
      decodeColumn(start(*axes_[k]),
                   stride(*axes_[k]),
                   header_.total,
                   axes_[k]->type,
                   false,
                   shape_.points[0].data() + k,
                   3);
    if (!color_)
      return;
    shape_.colors.resize(header_.total);
    for (std::size_t i = 0; i < header_.total; ++i) {
      std::memcpy(&shape_.colors[i], start(*color_) + i * stride(*color_), 4);
      shape_.colors[i] &= 0xffffffU;
    }
  }

  Lines lines_;
  const PcdHeader header_;
  const PcdField* const axes_[3];
  const PcdField* const color_;
  Shape shape_;
};

} // namespace

Shape readPcd(std::string_view bytes) {
  return PcdReader(bytes).read();
}

} // namespace pcl_sq::app

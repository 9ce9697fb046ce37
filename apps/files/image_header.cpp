// SPDX-License-Identifier: BSD-3-Clause
#include "files/image_header.h"

#include <algorithm>
#include <cctype>
#include <charconv>

namespace pcl_sq::app {
namespace {

/** \brief Unsigned numbers at places of a text; 0 beyond its end. */
class Bytes {
public:
  explicit Bytes(const std::string& text) : text_(text) {}

  std::uint64_t big(std::size_t at, int count) const {
    std::uint64_t value = 0;
    for (int i = 0; i < count; ++i)
      value = value << 8U | byte(at + std::size_t(i));
    return value;
  }
  std::uint64_t little(std::size_t at, int count) const {
    std::uint64_t value = 0;
    for (int i = count - 1; i >= 0; --i)
      value = value << 8U | byte(at + std::size_t(i));
    return value;
  }
  std::size_t size() const { return text_.size(); }
  bool startsWith(const char* start, std::size_t length) const {
    return text_.compare(0, length, start, length) == 0;
  }

private:
  std::uint64_t byte(std::size_t at) const {
    return at < text_.size() ? static_cast<unsigned char>(text_[at]) : 0U;
  }
  const std::string& text_;
};

/** \brief Chunks of length, name, contents and checksum; the last one is IEND. */
bool readPng(const Bytes& bytes, ImageHeader& header) {
  header.width = bytes.big(16, 4);
  header.height = bytes.big(20, 4);
  std::size_t at = 8;
  while (at + 12 <= bytes.size()) {
    const std::uint64_t length = bytes.big(at, 4);
    const bool last = bytes.big(at + 4, 4) == 0x49454e44;
    if (length > bytes.size())
      return false;
    at += 12 + std::size_t(length);
    if (last)
      return at <= bytes.size();
  }
  return false;
}

/** \brief Segments of a mark and a length, up to the one that has the sizes. */
bool readJpeg(const Bytes& bytes, ImageHeader& header) {
  std::size_t at = 2;
  while (at + 9 <= bytes.size() && bytes.big(at, 1) == 0xff) {
    const std::uint64_t mark = bytes.big(at + 1, 1);
    if (mark == 0xff) { // filling
      ++at;
      continue;
    }
    if (mark >= 0xc0 && mark <= 0xcf && mark != 0xc4 && mark != 0xc8 && mark != 0xcc) {
      header.height = bytes.big(at + 5, 2);
      header.width = bytes.big(at + 7, 2);
      break;
    }
    at += 2 + std::size_t(bytes.big(at + 2, 2));
  }
  // the end's mark, perhaps followed by what cameras append
  for (std::size_t i = bytes.size(); i >= 2 && header.width > 0; --i)
    if (bytes.big(i - 2, 2) == 0xffd9)
      return true;
  return false;
}

bool readBmp(const Bytes& bytes, ImageHeader& header) {
  header.width = bytes.little(18, 4);
  const auto height = static_cast<std::int32_t>(bytes.little(22, 4));
  header.height = static_cast<std::uint64_t>(
      height < 0 ? -static_cast<std::int64_t>(height) : std::int64_t(height));
  if (bytes.little(30, 4) == 0 && header.width < 65536 && header.height < 65536)
    header.least_bytes =
        bytes.little(10, 4) + header.width * header.height * bytes.little(28, 2) / 8;
  return true;
}

/** \brief After a line with the mark, numbers as text between single blanks, without
 * comments: width, height, and a scale that is not 0. OpenCV leaves a temporary file
 * behind where it is otherwise. */
bool readPfm(const std::string& text, ImageHeader& header) {
  std::size_t at = 2;
  if (text.size() <= at || text[at] != '\n')
    return false;
  const auto number = [&](auto& value) {
    if (at >= text.size() || std::isspace(static_cast<unsigned char>(text[at])) == 0)
      return false;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data() + at + 1, last, value);
    at = std::size_t(end - text.data());
    return error == std::errc();
  };
  double scale = 0.0;
  if (!number(header.width) || !number(header.height) || !number(scale) ||
      scale == 0.0 || at >= text.size() ||
      std::isspace(static_cast<unsigned char>(text[at])) == 0)
    return false;
  if (header.width < 65536 && header.height < 65536)
    header.least_bytes =
        at + 1 + header.width * header.height * (text[1] == 'F' ? 3 : 1) * 4;
  return true;
}

/** \brief Numbers as text after the mark, with comments: P1 to P6. */
bool readPnm(const std::string& text, ImageHeader& header) {
  const char mark = text[1];
  std::size_t at = 2;
  const auto number = [&](std::uint64_t& value) {
    while (
        at < text.size() &&
        (std::isspace(static_cast<unsigned char>(text[at])) != 0 || text[at] == '#')) {
      if (text[at] == '#')
        at = std::min(text.find('\n', at), text.size());
      else
        ++at;
    }
    const auto [end, error] =
        std::from_chars(text.data() + at, text.data() + text.size(), value);
    at = std::size_t(end - text.data());
    return error == std::errc();
  };
  std::uint64_t largest = 255;
  if (!number(header.width) || !number(header.height))
    return false;
  if (mark != '1' && mark != '4' && !number(largest))
    return false;
  const std::uint64_t channels = mark == '6' ? 3 : 1;
  const std::uint64_t depth = largest > 255 ? 2 : 1;
  if (header.width >= 65536 || header.height >= 65536)
    return true; // refused for its size
  const std::uint64_t values = header.width * header.height * channels;
  if (mark == '4')
    header.least_bytes = (header.width + 7) / 8 * header.height;
  else if (mark == '1' || mark == '2' || mark == '3')
    header.least_bytes = values * (mark == '3' ? 3 : 1);
  else
    header.least_bytes = values * depth;
  return true;
}

/** \brief The first directory's width and height. */
bool readTiff(const Bytes& bytes, bool little, ImageHeader& header) {
  const auto number = [&](std::size_t at, int count) {
    return little ? bytes.little(at, count) : bytes.big(at, count);
  };
  const std::uint64_t directory = number(4, 4);
  if (directory + 2 > bytes.size())
    return false;
  const std::uint64_t count = number(std::size_t(directory), 2);
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto at = std::size_t(directory + 2 + 12 * i);
    if (at + 12 > bytes.size())
      return false;
    const std::uint64_t tag = number(at, 2);
    const std::uint64_t value = number(at + 8, number(at + 2, 2) == 3 ? 2 : 4);
    if (tag == 256)
      header.width = value;
    if (tag == 257)
      header.height = value;
  }
  return true;
}

} // namespace

bool readImageHeader(const std::string& bytes, ImageHeader& header, std::string* why) {
  const Bytes b(bytes);
  bool whole = false;
  header = {};
  // OpenCV takes it for DICOM whatever it begins with, and that decoder aborts on
  // damage
  if (bytes.compare(std::min<std::size_t>(bytes.size(), 128), 4, "DICM") == 0) {
    if (why)
      *why = "is a DICOM image, which is not read";
    return false;
  }
  if (b.startsWith("\x89PNG\r\n\x1a\n", 8))
    whole = readPng(b, header);
  else if (b.startsWith("\xff\xd8\xff", 3))
    whole = readJpeg(b, header);
  else if (b.startsWith("BM", 2))
    whole = readBmp(b, header);
  else if (b.startsWith("Pf", 2) || b.startsWith("PF", 2))
    whole = readPfm(bytes, header);
  else if (bytes.size() > 2 && bytes[0] == 'P' &&
           std::string("123456").find(bytes[1]) != std::string::npos)
    whole = readPnm(bytes, header);
  else if (b.startsWith("II*\0", 4) || b.startsWith("MM\0*", 4))
    whole = readTiff(b, bytes[0] == 'I', header);
  else {
    if (why)
      *why = bytes.empty() ? "is empty" : "is no PNG, JPEG, BMP, PNM, PFM or TIFF";
    return false;
  }
  whole = whole && bytes.size() >= header.least_bytes;
  if (!whole && why)
    *why = "ends too early or is damaged";
  return whole;
}

std::vector<std::array<std::uint8_t, 3>> paletteOf(const std::string& bytes) {
  constexpr std::uint64_t PALETTE = 0x504c5445; // "PLTE"
  std::vector<std::array<std::uint8_t, 3>> colors;
  const Bytes png(bytes);
  if (!png.startsWith("\x89PNG", 4) || png.big(25, 1) != 3) // kinds of colour
    return colors;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const std::uint64_t length = png.big(at, 4);
    if (length > png.size())
      break;
    if (png.big(at + 4, 4) == PALETTE)
      for (std::size_t i = 0; i + 2 < length; i += 3)
        colors.push_back({std::uint8_t(png.big(at + 8 + i, 1)),
                          std::uint8_t(png.big(at + 9 + i, 1)),
                          std::uint8_t(png.big(at + 10 + i, 1))});
    at += 12 + std::size_t(length);
  }
  return colors;
}

} // namespace pcl_sq::app

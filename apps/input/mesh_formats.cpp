// SPDX-License-Identifier: BSD-3-Clause
// OBJ and STL, and what all formats with faces share.
#include "command_line/app.h"
#include "input/lines.h"
#include "input/scalar.h"
#include "input/shape.h"
#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pcl_sq::app {

namespace {

constexpr std::size_t STL_HEAD = 84, STL_FACET = 50; ///< bytes

/** \brief Numbers of a line's rest, at most \a most.
 * \return how many there are before the end or a comment */
std::size_t
takeNumbers(std::string_view line, std::size_t number, double* out, std::size_t most) {
  for (std::size_t k = 0; k < most; ++k) {
    const std::string_view word = takeWord(line);
    if (word.empty() || word[0] == '#')
      return k;
    if (!parseNumber(word, out[k]))
      failInLine(number, whyNoNumber(word));
  }
  return most;
}

/** \brief Corners of an OBJ face: 1-based, from the end if negative, "/..." behind. */
std::vector<std::int64_t>
takeCorners(std::string_view line, std::size_t number, std::size_t points) {
  std::vector<std::int64_t> corners;
  for (auto word = takeWord(line); !word.empty() && word[0] != '#';
       word = takeWord(line)) {
    std::string_view index = word.substr(0, word.find('/'));
    const bool negative = index[0] == '-';
    std::uint64_t value = 0;
    if (!parseCount(index.substr(negative ? 1 : 0), value) || value == 0)
      failInLine(number, app::quoted(word) + " is no corner of a face");
    if (value > points)
      failInLine(number,
                 "the face has a vertex " + app::quoted(word) + ", which is not there");
    corners.push_back(static_cast<std::int64_t>(negative ? points - value : value - 1));
  }
  return corners;
}

/** \brief A point of three floats. */
Eigen::Vector3d pointAt(const char* bytes) {
  Eigen::Vector3d point;
  decodeColumn(bytes, 4, 3, Scalar::F32, false, point.data(), 1);
  return point;
}

/** \brief A facet for the three points that were read last. */
void addFacet(Shape& shape) {
  const auto n = static_cast<std::uint32_t>(shape.points.size());
  shape.triangles.push_back({n - 3, n - 2, n - 1});
  ++shape.faces;
}

/** \brief Facets that a binary STL promises. */
std::uint64_t facetsOf(std::string_view bytes) {
  const double count = decode(bytes.data() + STL_HEAD - 4, Scalar::U32, false);
  return static_cast<std::uint64_t>(count);
}

Shape readBinaryStl(std::string_view bytes) {
  if (bytes.size() < STL_HEAD)
    throw Failure("it ends within its header; it is truncated");
  const std::uint64_t promised = facetsOf(bytes);
  const std::uint64_t held = (bytes.size() - STL_HEAD) / STL_FACET;
  if (promised > held)
    throw Failure("its header promises " + std::to_string(promised) +
                  " facets, but it ends after " + std::to_string(held) +
                  "; it is truncated or corrupt");
  if (promised < held)
    throw Failure("its header promises " + std::to_string(promised) +
                  " facets, but there are bytes for " + std::to_string(held) +
                  "; write it again");
  Shape shape;
  shape.points.reserve(3 * held);
  for (std::size_t at = STL_HEAD; at + STL_FACET <= bytes.size(); at += STL_FACET) {
    for (std::size_t corner = 1; corner <= 3; ++corner)
      shape.points.push_back(pointAt(bytes.data() + at + 12 * corner));
    addFacet(shape);
  }
  return shape;
}

} // namespace

bool addFace(const std::vector<std::int64_t>& corners, Shape& shape) {
  const auto count = static_cast<std::int64_t>(shape.points.size());
  for (const std::int64_t corner : corners)
    if (corner < 0 || corner >= count)
      return false;
  for (std::size_t k = 2; k < corners.size(); ++k)
    shape.triangles.push_back({static_cast<std::uint32_t>(corners[0]),
                               static_cast<std::uint32_t>(corners[k - 1]),
                               static_cast<std::uint32_t>(corners[k])});
  shape.faces += corners.size() > 2;
  return true;
}

void cutStrips(const std::vector<double>& strips,
               std::vector<std::vector<std::int64_t>>& faces) {
  constexpr double LARGEST = 4e9; // what is no index is refused as one
  const auto corner = [&](std::size_t k) {
    return strips[k] < LARGEST ? static_cast<std::int64_t>(strips[k]) : -1;
  };
  std::size_t begin = 0; // of a strip
  for (std::size_t k = 0; k < strips.size(); ++k)
    if (strips[k] < 0.0)
      begin = k + 1;
    else if (k >= begin + 2) { // each second triangle is seen from behind
      const std::size_t turned = (k - begin) % 2;
      faces.push_back({corner(k - 2 + turned), corner(k - 1 - turned), corner(k)});
    }
}

Shape readObj(std::string_view bytes) {
  Shape shape;
  Lines lines(bytes);
  std::string_view line;
  bool colored = true;
  while (lines.next(line)) {
    std::string joined; // a line that ends in a backslash goes on in the next one
    const std::size_t number = lines.number();
    while (!line.empty() && line.back() == '\\') {
      joined += std::string(line.substr(0, line.size() - 1)) + ' ';
      if (!lines.next(line))
        line = {};
    }
    if (!joined.empty())
      line = joined += line;
    const std::string_view key = takeWord(line);
    if (key == "v") {
      double v[7]; // x y z, x y z w, or x y z r g b
      const std::size_t count = takeNumbers(line, number, v, 7);
      if (count < 3)
        failInLine(number, "a vertex does not hold three numbers");
      shape.points.emplace_back(v[0], v[1], v[2]);
      colored = colored && count >= 6;
      std::uint32_t color = 0;
      for (std::size_t k = 3; k < 6 && colored; ++k) {
        colored = v[k] >= 0.0 && v[k] <= 1.0;
        color = color << 8U | static_cast<std::uint32_t>(colored ? 255.0 * v[k] : 0.0);
      }
      if (colored)
        shape.colors.push_back(color);
    } else if (key == "f" &&
               !addFace(takeCorners(line, number, shape.points.size()), shape))
      failInLine(number, "the face has a vertex that does not exist");
  }
  if (!colored)
    shape.colors.clear();
  return shape;
}

bool isBinaryStl(std::string_view bytes) {
  if (bytes.size() < STL_HEAD)
    return false;
  return bytes.size() == STL_HEAD + STL_FACET * facetsOf(bytes);
}

Shape readStl(std::string_view bytes) {
  // a text has no zeros, and its length says nothing
  if (isBinaryStl(bytes) || bytes.find('\0') != std::string_view::npos)
    return readBinaryStl(bytes);
  Shape shape;
  Lines lines(bytes);
  std::string_view line;
  std::size_t corners = 0;
  bool solid = false;
  while (lines.next(line)) {
    for (auto word = takeWord(line); !word.empty(); word = takeWord(line)) {
      const std::string key = lowered(word.substr(0, 8));
      if (key == "solid" || key == "endsolid") {
        solid = true;
        break; // a name follows
      }
      if (!solid)
        throw Failure("it is no STL file: neither its length is that of a binary one, "
                      "nor does it start with 'solid'");
      if (key == "facet")
        corners = 0;
      if (key != "vertex")
        continue;
      Eigen::Vector3d v;
      if (takeNumbers(line, lines.number(), v.data(), 3) < 3)
        failInLine(lines.number(), "a vertex does not hold three numbers");
      for (int k = 0; k < 3; ++k)
        takeWord(line);
      shape.points.push_back(v);
      if (++corners == 3)
        addFacet(shape);
      if (corners > 3)
        failInLine(lines.number(), "a facet has more than three vertices");
    }
  }
  return shape;
}

} // namespace pcl_sq::app

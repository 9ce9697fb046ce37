// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/files/mesh_bytes.h"

#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <sstream>

namespace pcl_sq {
namespace {

/** \brief Lowest byte first on every machine, as both binary formats have it. */
void appendNumber(std::string& bytes, std::uint32_t number) {
  for (int shift = 0; shift < 32; shift += 8)
    bytes += static_cast<char>(number >> shift & 0xffU);
}

void appendVector(std::string& bytes, const Eigen::Vector3d& v) {
  for (const double coordinate : {v.x(), v.y(), v.z()}) {
    const auto single = static_cast<float>(coordinate);
    std::uint32_t number = 0;
    static_assert(sizeof number == sizeof single,
                  "the formats hold IEEE single precision");
    std::memcpy(&number, &single, sizeof number);
    appendNumber(bytes, number);
  }
}

} // namespace

std::string plyBytes(const std::vector<TriangleMesh>& parts,
                     const std::vector<Color>& colors) {
  std::size_t vertices = 0, triangles = 0;
  for (const TriangleMesh& part : parts) {
    vertices += part.vertices.size();
    triangles += part.triangles.size();
  }
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\ncomment lengths in metres\n"
      "element vertex " +
      std::to_string(vertices) +
      "\nproperty float x\nproperty float y\nproperty float z\n";
  if (!colors.empty())
    bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  bytes += "element face " + std::to_string(triangles) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const Eigen::Vector3d& v : parts[i].vertices) {
      appendVector(bytes, v);
      if (!colors.empty())
        for (const std::uint8_t channel : {colors[i].r, colors[i].g, colors[i].b})
          bytes += static_cast<char>(channel);
    }
  std::uint32_t first = 0;
  for (const TriangleMesh& part : parts) {
    for (const auto& t : part.triangles) {
      bytes += '\3';
      for (const std::uint32_t index : t)
        appendNumber(bytes, first + index);
    }
    first += static_cast<std::uint32_t>(part.vertices.size());
  }
  return bytes;
}

std::string objBytes(const std::vector<TriangleMesh>& parts) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  text << "# lengths in metres\n";
  std::size_t first = 1;
  for (const TriangleMesh& part : parts) {
    for (const Eigen::Vector3d& v : part.vertices)
      text << "v " << v.x() << ' ' << v.y() << ' ' << v.z() << '\n';
    for (const auto& t : part.triangles)
      text << "f " << first + t[0] << ' ' << first + t[1] << ' ' << first + t[2]
           << '\n';
    first += part.vertices.size();
  }
  return text.str();
}

std::string stlBytes(const std::vector<TriangleMesh>& parts) {
  constexpr std::size_t HEADER = 80, TRIANGLE = 50;
  std::size_t count = 0;
  for (const TriangleMesh& part : parts)
    count += part.triangles.size();
  std::string bytes = "binary STL, lengths in metres";
  bytes.reserve(HEADER + sizeof(std::uint32_t) + count * TRIANGLE);
  bytes.resize(HEADER, ' ');
  appendNumber(bytes, static_cast<std::uint32_t>(count));
  for (const TriangleMesh& part : parts)
    for (const auto& t : part.triangles) {
      const Eigen::Vector3d &a = part.vertices[t[0]], &b = part.vertices[t[1]],
                            &c = part.vertices[t[2]];
      appendVector(bytes, (b - a).cross(c - a).normalized());
      appendVector(bytes, a);
      appendVector(bytes, b);
      appendVector(bytes, c);
      bytes.append(2, '\0'); // no attributes
    }
  return bytes;
}

} // namespace pcl_sq

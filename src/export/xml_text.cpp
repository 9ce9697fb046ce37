// SPDX-License-Identifier: BSD-3-Clause
#include "export/xml_text.h"

#include <cstring>
#include <locale>
#include <sstream>

namespace pcl_sq::detail {

namespace {

void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

void appendFloats(std::string& bytes, const Eigen::Vector3d& v) {
  const Eigen::Vector3f f = v.cast<float>();
  append(bytes, f.data(), sizeof(float) * 3);
}

} // namespace

std::string numbersText(std::initializer_list<double> numbers) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);
  const char* between = "";
  for (const double number : numbers) {
    text << between << number + 0.0; // no "-0"
    between = " ";
  }
  return text.str();
}

Eigen::Vector3d rollPitchYaw(const Eigen::Matrix3d& r) {
  const double pitch = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  if (std::abs(r(2, 0)) > 1.0 - 1e-12) // straight up or down: roll says it all
    return {std::atan2(-r(1, 2), r(1, 1)), pitch, 0.0};
  return {std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))};
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(c) < 32 ? '_' : c;
  return out;
}

std::string stlBytes(const TriangleMesh& mesh) {
  std::string bytes = "pcl_sq";
  bytes.resize(80, ' ');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  append(bytes, &count, sizeof count);
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    const Eigen::Vector3d& b = mesh.vertices[t[1]];
    const Eigen::Vector3d& c = mesh.vertices[t[2]];
    appendFloats(bytes, (b - a).cross(c - a).normalized());
    for (const Eigen::Vector3d* corner : {&a, &b, &c})
      appendFloats(bytes, *corner);
    bytes.append(2, '\0');
  }
  return bytes;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "header_check.h"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace pcl_sq::app {

namespace {

constexpr int MAX_HEADER_LINES = 1000;
constexpr double MAX_LZF_RATIO = 300.0; ///< LZF packs at most 264 bytes into 3

double fileSize(const std::string& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  return error ? 0.0 : double(size);
}

const char* const TRUNCATED =
    "the header promises more points than the file holds; it is truncated or corrupt";

} // namespace

std::string checkPcdHeader(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string line;
  double width = -1.0, height = 1.0, points = -1.0, point_bytes = 0.0, values = 0.0;
  std::vector<double> sizes, counts;
  for (int i = 0; i < MAX_HEADER_LINES && std::getline(stream, line); ++i) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    double value;
    if (key == "SIZE")
      while (words >> value)
        sizes.push_back(value);
    else if (key == "COUNT")
      while (words >> value)
        counts.push_back(value);
    else if (key == "WIDTH")
      words >> width;
    else if (key == "HEIGHT")
      words >> height;
    else if (key == "POINTS")
      words >> points;
    else if (key == "DATA") {
      std::string kind;
      words >> kind;
      for (std::size_t k = 0; k < sizes.size(); ++k) {
        const double count = k < counts.size() ? counts[k] : 1.0;
        if (!(count >= 1.0 && count < 1e6 && sizes[k] >= 1.0 && sizes[k] <= 8.0))
          return "the header's SIZE or COUNT makes no sense";
        point_bytes += sizes[k] * count;
        values += count;
      }
      if (point_bytes <= 0.0 || width < 0.0)
        return "the header lacks FIELDS, SIZE or WIDTH";
      if (points >= 0.0 && points != width * height)
        return "the header's WIDTH x HEIGHT differs from its POINTS";
      const double data = fileSize(path) - double(stream.tellg());
      const double total = width * height;
      if (kind == "ascii") // a digit and a separator for each value
        return total * 2.0 * values > data + 1.0 ? TRUNCATED : "";
      if (kind == "binary")
        return total * point_bytes > data ? TRUNCATED : "";
      if (kind == "binary_compressed") {
        std::uint32_t packed = 0, unpacked = 0;
        stream.read(reinterpret_cast<char*>(&packed), sizeof packed);
        stream.read(reinterpret_cast<char*>(&unpacked), sizeof unpacked);
        if (!stream || packed > data - 8.0 || unpacked != total * point_bytes ||
            unpacked > MAX_LZF_RATIO * packed)
          return TRUNCATED;
        return "";
      }
      return "the header's DATA is none of ascii, binary and binary_compressed";
    }
  }
  return "it has no PCD header";
}

std::string checkPlyHeader(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string line;
  std::getline(stream, line);
  if (line.rfind("ply", 0) != 0)
    return "it has no PLY header";
  bool ascii = false;
  double count = 0.0, bytes = 0.0, total = 0.0;
  const auto bytesOf = [](const std::string& type) {
    if (type == "char" || type == "uchar" || type == "int8" || type == "uint8")
      return 1.0;
    if (type == "short" || type == "ushort" || type == "int16" || type == "uint16")
      return 2.0;
    return type == "double" || type == "float64" ? 8.0 : 4.0;
  };
  bool has_vertices = false;
  for (int i = 0; i < MAX_HEADER_LINES && std::getline(stream, line); ++i) {
    std::istringstream words(line);
    std::string key, type;
    words >> key >> type;
    if (key == "format")
      ascii = type == "ascii";
    else if (key == "element") {
      total += count * bytes;
      has_vertices = has_vertices || type == "vertex";
      count = -1.0;
      bytes = 0.0;
      words >> count;
      if (!(count >= 0.0))
        return "the header's element count makes no sense";
    } else if (key == "property") {
      std::string length_type = "uchar";
      if (type == "list")
        words >> length_type;
      bytes += ascii ? 2.0 : bytesOf(type == "list" ? length_type : type);
    } else if (key == "end_header") {
      total += count * bytes;
      if (!has_vertices)
        return "it has no vertices";
      const double data = fileSize(path) - double(stream.tellg());
      return total > data + 1.0 ? TRUNCATED : "";
    }
  }
  return "its PLY header has no end";
}

} // namespace pcl_sq::app

// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_reader.h"

#include "app.h"
#include "files.h"

#include <cstring>
#include <map>
#include <sstream>
#include <tuple>

namespace pcl_sq::app {
namespace {

using Polygon = std::vector<long>;

class Reader {
public:
  explicit Reader(std::string path) : path_(std::move(path)) {}

  TriangleMesh read() {
    const std::string data = readInput(path_);
    const std::string extension = extensionOf(path_);
    if (extension == ".obj")
      readObj(data);
    else if (extension == ".stl")
      isBinaryStl(data) ? readBinaryStl(data) : readTextStl(data);
    else if (extension == ".ply")
      readPly(data);
    else
      fail("is neither .obj, .stl nor .ply");
    if (mesh_.triangles.empty())
      fail("holds no triangle");
    for (const Eigen::Vector3d& v : mesh_.vertices)
      if (!v.allFinite())
        fail("holds a coordinate that is not finite");
    return std::move(mesh_);
  }

private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Failure("'" + path_ + "' " + what + "; give another mesh file.");
  }

  void addPolygon(const Polygon& polygon) {
    const auto count = static_cast<long>(mesh_.vertices.size());
    for (const long i : polygon)
      if (i < 0 || i >= count)
        fail("has a face with a vertex that does not exist");
    for (std::size_t k = 2; k < polygon.size(); ++k)
      mesh_.triangles.push_back({static_cast<std::uint32_t>(polygon[0]),
                                 static_cast<std::uint32_t>(polygon[k - 1]),
                                 static_cast<std::uint32_t>(polygon[k])});
  }

  /** \brief Index of a vertex; equal ones are one (STL repeats them). */
  long weld(const Eigen::Vector3d& v) {
    const auto key = std::make_tuple(v.x(), v.y(), v.z());
    const auto [it, fresh] =
        welded_.emplace(key, static_cast<long>(mesh_.vertices.size()));
    if (fresh)
      mesh_.vertices.push_back(v);
    return it->second;
  }

  void readObj(const std::string& data) {
    std::istringstream in(data);
    for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word == "v") {
        Eigen::Vector3d v;
        if (!(words >> v.x() >> v.y() >> v.z()))
          fail("has a vertex without three numbers");
        mesh_.vertices.push_back(v);
      } else if (word == "f") {
        Polygon polygon;
        for (std::string corner; words >> corner;) {
          const long i = std::strtol(corner.c_str(), nullptr, 10);
          polygon.push_back(i < 0 ? static_cast<long>(mesh_.vertices.size()) + i
                                  : i - 1);
        }
        addPolygon(polygon);
      }
    }
  }

  static bool isBinaryStl(const std::string& data) {
    if (data.size() < 84)
      return false;
    std::uint32_t count = 0;
    std::memcpy(&count, data.data() + 80, 4);
    return data.size() == 84 + 50 * static_cast<std::size_t>(count);
  }

  void readBinaryStl(const std::string& data) {
    for (std::size_t at = 84; at + 50 <= data.size(); at += 50) {
      float f[12];
      std::memcpy(f, data.data() + at, sizeof(f));
      addPolygon({weld(Eigen::Vector3d(f[3], f[4], f[5])),
                  weld(Eigen::Vector3d(f[6], f[7], f[8])),
                  weld(Eigen::Vector3d(f[9], f[10], f[11]))});
    }
  }

  void readTextStl(const std::string& data) {
    std::istringstream in(data);
    Polygon polygon;
    for (std::string word; in >> word;) {
      if (word != "vertex")
        continue;
      Eigen::Vector3d v;
      if (!(in >> v.x() >> v.y() >> v.z()))
        fail("has a vertex without three numbers");
      polygon.push_back(weld(v));
      if (polygon.size() == 3) {
        addPolygon(polygon);
        polygon.clear();
      }
    }
  }

  struct Property {
    std::string name, type, count_type; ///< count_type only of lists
  };
  struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
  };

  static std::size_t sizeOf(const std::string& type) {
    if (type == "char" || type == "uchar" || type == "int8" || type == "uint8")
      return 1;
    if (type == "short" || type == "ushort" || type == "int16" || type == "uint16")
      return 2;
    return type == "double" || type == "float64" ? 8 : 4;
  }

  template <typename T>
  static double as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
  }

  double number(std::istream& in, const std::string& type, bool binary) const {
    double value = 0.0;
    if (!binary) {
      if (!(in >> value))
        fail("ends too early");
      return value;
    }
    char bytes[8] = {};
    if (!in.read(bytes, static_cast<std::streamsize>(sizeOf(type))))
      fail("ends too early");
    if (type == "float" || type == "float32")
      return as<float>(bytes);
    if (type == "double" || type == "float64")
      return as<double>(bytes);
    if (type == "char" || type == "int8")
      return as<std::int8_t>(bytes);
    if (type == "uchar" || type == "uint8")
      return as<std::uint8_t>(bytes);
    if (type == "short" || type == "int16")
      return as<std::int16_t>(bytes);
    if (type == "ushort" || type == "uint16")
      return as<std::uint16_t>(bytes);
    if (type == "uint" || type == "uint32")
      return as<std::uint32_t>(bytes);
    return as<std::int32_t>(bytes);
  }

  std::vector<Element> readPlyHeader(std::istream& in, bool* binary) const {
    std::vector<Element> elements;
    std::string line;
    if (!std::getline(in, line) || line.rfind("ply", 0) != 0)
      fail("is not a PLY file");
    while (std::getline(in, line) && line.rfind("end_header", 0) != 0) {
      std::istringstream words(line);
      std::string key, word;
      words >> key >> word;
      if (key == "format") {
        *binary = word == "binary_little_endian";
        if (!*binary && word != "ascii")
          fail("is a big-endian PLY, which is not supported");
      } else if (key == "element") {
        elements.push_back({word, 0, {}});
        words >> elements.back().count;
      } else if (key == "property" && !elements.empty()) {
        Property p;
        p.type = word;
        if (word == "list")
          words >> p.count_type >> p.type;
        words >> p.name;
        elements.back().properties.push_back(p);
      }
    }
    return elements;
  }

  void readPly(const std::string& data) {
    std::istringstream in(data);
    bool binary = false;
    for (const Element& element : readPlyHeader(in, &binary))
      for (std::size_t i = 0; i < element.count; ++i) {
        Eigen::Vector3d v = Eigen::Vector3d::Zero();
        for (const Property& p : element.properties) {
          if (p.count_type.empty()) {
            const double value = number(in, p.type, binary);
            if (p.name == "x" || p.name == "y" || p.name == "z")
              v[p.name[0] - 'x'] = value;
            continue;
          }
          const double count = number(in, p.count_type, binary);
          if (count < 0 || count > 1e6)
            fail("has a list of impossible length");
          Polygon polygon;
          for (int k = 0; k < static_cast<int>(count); ++k)
            polygon.push_back(static_cast<long>(number(in, p.type, binary)));
          if (element.name == "face" &&
              (p.name == "vertex_indices" || p.name == "vertex_index"))
            addPolygon(polygon);
        }
        if (element.name == "vertex")
          mesh_.vertices.push_back(v);
      }
  }

  std::string path_;
  TriangleMesh mesh_;
  std::map<std::tuple<double, double, double>, long> welded_;
};

} // namespace

TriangleMesh readMesh(const std::string& path) {
  return Reader(path).read();
}

void writePly(const std::string& path, const TriangleMesh& mesh) {
  std::ostringstream out;
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.vertices.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
      << mesh.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& v : mesh.vertices)
    out.write(reinterpret_cast<const char*>(v.data()), 3 * sizeof(double));
  for (const auto& t : mesh.triangles) {
    const char three = 3;
    out.write(&three, 1);
    out.write(reinterpret_cast<const char*>(t.data()), 3 * sizeof(std::uint32_t));
  }
  writeOutput(path, out.str());
}

} // namespace pcl_sq::app

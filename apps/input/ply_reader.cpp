// SPDX-License-Identifier: BSD-3-Clause
// PLY: text and both orders of bytes, elements in any order, lists anywhere.
#include "command_line/app.h"
#include "input/ply_body.h"
#include "input/shape.h"
#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

namespace pcl_sq::app {

namespace {

class PlyReader {
public:
  explicit PlyReader(std::string_view bytes)
      : lines_(bytes), header_(readPlyHeader(lines_)),
        body_(header_, lines_.rest(), lines_.number()) {}

  Shape read() {
    for (const PlyElement& element : header_.elements) {
      refuseLies(element);
      if (element.properties.empty())
        continue;
      if (element.name == "vertex")
        readVertices(element);
      else if (element.name == "face")
        readFaces(element);
      else if (element.name == "tristrips")
        walk(
            element,
            [](std::size_t, double) {},
            [&](std::size_t, const std::vector<double>& list) {
              cutStrips(list, faces_);
            });
      else if (element.name == "range_grid")
        walk(
            element,
            [](std::size_t, double) {},
            [&](std::size_t, const std::vector<double>& list) {
              grid_.push_back(list.empty() ? -1.0 : list[0]);
            });
      else if (element.name == "camera")
        readCamera(element);
      else
        walk(
            element,
            [](std::size_t, double) {},
            [](std::size_t, const std::vector<double>&) {});
    }
    if (!has_vertices_)
      throw Failure("it has no vertices");
    if (body_.ascii() && !body_.nextWord().empty())
      throw Failure(body_.place() + ": there are more numbers than the header names");
    if (!body_.ascii() && !isPadding(body_.rest()))
      throw Failure("there are " + std::to_string(body_.rest().size()) +
                    " bytes more than its header names; correct the numbers of its "
                    "elements, or write it again");
    // faces may stand in front of the vertices
    for (std::size_t i = 0; i < faces_.size(); ++i)
      if (!addFace(faces_[i], shape_))
        throw Failure("its face " + std::to_string(i + 1) +
                      " has a vertex that does not exist");
    layOutGrid();
    return std::move(shape_);
  }

private:
  [[noreturn]] static void truncated(const PlyElement& element, std::uint64_t held) {
    throw Failure("its header promises " + std::to_string(element.count) + " of " +
                  app::quoted(element.name) + ", but it ends after " +
                  std::to_string(held) + "; it is truncated or corrupt");
  }

  /** \brief An element's number against what the file can hold. */
  void refuseLies(const PlyElement& element) const {
    if (element.properties.empty())
      return; // nothing follows for them
    const std::uint64_t most =
        body_.capacity(element.bytes(), element.properties.size());
    if (element.count > most)
      throw Failure("its header promises " + std::to_string(element.count) + " of " +
                    app::quoted(element.name) + ", but it holds " +
                    std::to_string(most) + " at most; it is truncated or corrupt");
  }

  /** \brief Hands on the numbers and lists of an element. */
  template <typename OnNumber, typename OnList>
  void walk(const PlyElement& element, OnNumber on_number, OnList on_list) {
    std::vector<double> list;
    for (std::uint64_t i = 0; i < element.count; ++i)
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const PlyProperty& p = element.properties[k];
        double value = 0.0;
        if (!body_.next(p.count_type.value_or(p.type), value))
          truncated(element, i);
        if (!p.count_type) {
          on_number(k, value);
          continue;
        }
        const auto most = static_cast<double>(body_.capacity(sizeOf(p.type), 1));
        if (!(value >= 0.0) || value != std::floor(value))
          throw Failure("its list " + app::quoted(p.name) + " of " +
                        app::quoted(element.name) + " " + std::to_string(i + 1) +
                        " has an impossible length");
        if (value > most)
          truncated(element, i);
        list.resize(static_cast<std::size_t>(value));
        for (double& entry : list)
          if (!body_.next(p.type, entry))
            truncated(element, i);
        on_list(k, list);
      }
  }

  /** \brief Place of a property among those of an element; -1 without it. */
  static int find(const PlyElement& element, std::initializer_list<const char*> names) {
    for (const char* name : names)
      for (std::size_t k = 0; k < element.properties.size(); ++k)
        if (element.properties[k].name == name && !element.properties[k].count_type)
          return static_cast<int>(k);
    return -1;
  }

  void readVertices(const PlyElement& element) {
    if (has_vertices_)
      throw Failure("it has two elements 'vertex'; one is wanted");
    has_vertices_ = true;
    const int places[6] = {find(element, {"x", "X"}),
                           find(element, {"y", "Y"}),
                           find(element, {"z", "Z"}),
                           find(element, {"red", "r", "diffuse_red"}),
                           find(element, {"green", "g", "diffuse_green"}),
                           find(element, {"blue", "b", "diffuse_blue"})};
    for (int k = 0; k < 3; ++k)
      if (places[k] < 0)
        throw Failure(std::string("its vertices have no property '") +
                      static_cast<char>('x' + k) + "'");
    const bool colored = places[3] >= 0 && places[4] >= 0 && places[5] >= 0;
    shape_.points.resize(element.count);
    if (colored)
      shape_.colors.assign(element.count, 0);
    if (!body_.ascii() && !element.hasLists())
      decodeVertices(element, places, colored);
    else
      walkVertices(element, places, colored);
  }

  void walkVertices(const PlyElement& element, const int (&places)[6], bool colored) {
    std::vector<int> role(element.properties.size(), -1);
    for (int k = 0; k < (colored ? 6 : 3); ++k)
      role[static_cast<std::size_t>(places[k])] = k;
    std::size_t i = 0;
    walk(
        element,
        [&](std::size_t k, double value) {
          if (role[k] >= 0 && role[k] < 3)
            shape_.points[i][role[k]] = value;
          else if (role[k] >= 3)
            addChannel(i, role[k] - 3, value, element.properties[k].type);
          i += k + 1 == role.size();
        },
        [&](std::size_t k, const std::vector<double>&) { i += k + 1 == role.size(); });
  }

  void decodeVertices(const PlyElement& element, const int (&places)[6], bool colored) {
    const std::size_t stride = element.bytes(), count = element.count;
    for (int k = 0; k < (colored ? 6 : 3) && count > 0; ++k) {
      std::size_t offset = 0;
      const auto place = static_cast<std::size_t>(places[k]);
      for (std::size_t j = 0; j < place; ++j)
        offset += sizeOf(element.properties[j].type);
      const Scalar type = element.properties[place].type;
      const char* first = body_.rest().data() + offset;
      if (k < 3)
        decodeColumn(
            first, stride, count, type, body_.swap(), shape_.points[0].data() + k, 3);
      else
        for (std::size_t i = 0; i < count; ++i)
          addChannel(i, k - 3, decode(first + i * stride, type, body_.swap()), type);
    }
    body_.skip(stride * count);
  }

  void addChannel(std::size_t i, int channel, double value, Scalar type) {
    if (type == Scalar::F32 || type == Scalar::F64)
      value *= 255.0;
    else if (type == Scalar::U16)
      value /= 257.0;
    const double level = value >= 0.0 ? std::min(value, 255.0) : 0.0;
    shape_.colors[i] |= static_cast<std::uint32_t>(std::lround(level))
                        << (16 - 8 * channel);
  }

  void readFaces(const PlyElement& element) {
    walk(
        element,
        [](std::size_t, double) {},
        [&](std::size_t k, const std::vector<double>& list) {
          const std::string& name = element.properties[k].name;
          if ((name != "vertex_indices" && name != "vertex_index") || list.size() < 3)
            return;
          std::vector<std::int64_t> corners;
          for (const double corner : list) // what is no index is refused as one
            corners.push_back(std::abs(corner) < 4e9 ? std::int64_t(corner) : -1);
          faces_.push_back(std::move(corners));
        });
  }

  /** \brief The sensor's pose, as PCL and scanners write it. */
  void readCamera(const PlyElement& element) {
    std::map<std::string, double> values;
    walk(
        element,
        [&](std::size_t k, double v) { values[element.properties[k].name] = v; },
        [](std::size_t, const std::vector<double>&) {});
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const std::string axis(1, static_cast<char>('x' + k));
      place[k] = values["view_p" + axis];
      for (int j = 0; j < 3; ++j)
        if (const auto it = values.find(axis + "_axis" + static_cast<char>('x' + j));
            it != values.end())
          turn(k, j) = it->second;
    }
    if (!place.allFinite() || !(turn * turn.transpose()).isIdentity(1e-3) ||
        turn.determinant() < 0.0)
      throw Failure("its element 'camera' holds no pose");
    shape_.origin = place;
    shape_.orientation = Eigen::Quaterniond(turn);
    camera_width_ = values["viewportx"];
    camera_height_ = values["viewporty"];
  }

  /** \brief Vertices into the image of points that a range grid or a camera tells. */
  void layOutGrid() {
    const std::size_t count = shape_.points.size();
    if (grid_.empty()) {
      if (camera_height_ > 1.0 && camera_width_ < 65536.0 && camera_height_ < 65536.0 &&
          camera_width_ * camera_height_ == static_cast<double>(count)) {
        shape_.width = static_cast<std::uint32_t>(camera_width_);
        shape_.height = static_cast<std::uint32_t>(camera_height_);
      }
      return;
    }
    if (header_.grid_columns == 0 || header_.grid_columns > grid_.size() ||
        grid_.size() / header_.grid_columns != header_.grid_rows ||
        grid_.size() % header_.grid_columns != 0)
      throw Failure("its range grid has " + std::to_string(grid_.size()) +
                    " entries, which are not num_cols x num_rows");
    std::vector<Eigen::Vector3d> points(grid_.size(),
                                        Eigen::Vector3d::Constant(std::nan("")));
    std::vector<std::uint32_t> colors(shape_.colors.empty() ? 0 : grid_.size(), 0);
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      if (grid_[i] == -1.0)
        continue;
      if (!(grid_[i] >= 0.0 && grid_[i] < static_cast<double>(count)))
        throw Failure("its range grid names a vertex that does not exist");
      const auto at = static_cast<std::size_t>(grid_[i]);
      points[i] = shape_.points[at];
      if (!colors.empty())
        colors[i] = shape_.colors[at];
    }
    if (!shape_.triangles.empty())
      return; // a surface needs its vertices as they are
    shape_.points = std::move(points);
    shape_.colors = std::move(colors);
    shape_.width = static_cast<std::uint32_t>(header_.grid_columns);
    shape_.height = static_cast<std::uint32_t>(header_.grid_rows);
  }

  Lines lines_;
  PlyHeader header_;
  PlyBody body_;
  bool has_vertices_ = false;
  std::vector<std::vector<std::int64_t>> faces_;
  std::vector<double> grid_;
  double camera_width_ = 0.0, camera_height_ = 0.0;
  Shape shape_;
};

} // namespace

Shape readPly(std::string_view bytes) {
  return PlyReader(bytes).read();
}

} // namespace pcl_sq::app

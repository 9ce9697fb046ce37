// SPDX-License-Identifier: BSD-3-Clause
// Binary glTF 2.0 (Khronos): a header, a chunk of JSON, a chunk of numbers.
#include "export/part_surface.h"
#include "io/json_text.h"

#include "pcl_sq/palette.h"
#include "pcl_sq/robot_export.h"
#include "pcl_sq/sides.h"

namespace pcl_sq {

using detail::Json;
using detail::vectorToJson;

namespace {

enum GlNumbers { FLOAT = 5126, UNSIGNED_INT = 5125, VERTICES = 34962, INDICES = 34963 };

/** \brief The buffer of numbers with the JSON that describes it. */
struct Buffer {
  std::string bytes;
  Json views = Json::array(), accessors = Json::array();

  template <typename T>
  std::size_t add(const std::vector<T>& numbers, int target, Json accessor) {
    views.push_back({{"buffer", 0},
                     {"byteOffset", bytes.size()},
                     {"byteLength", numbers.size() * sizeof(T)},
                     {"target", target}});
    bytes.append(reinterpret_cast<const char*>(numbers.data()),
                 numbers.size() * sizeof(T));
    accessor["bufferView"] = views.size() - 1;
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
  }

  std::size_t addVectors(const std::vector<Eigen::Vector3d>& vectors, bool bounds) {
    std::vector<float> numbers;
    Eigen::Vector3f low = Eigen::Vector3f::Constant(INFINITY), high = -low;
    for (const Eigen::Vector3d& v : vectors) {
      const Eigen::Vector3f f = v.cast<float>();
      low = low.cwiseMin(f);
      high = high.cwiseMax(f);
      numbers.insert(numbers.end(), f.data(), f.data() + 3);
    }
    Json accessor = {
        {"componentType", FLOAT}, {"count", vectors.size()}, {"type", "VEC3"}};
    if (bounds) {
      accessor["min"] = vectorToJson(low.cast<double>());
      accessor["max"] = vectorToJson(high.cast<double>());
    }
    return add(numbers, VERTICES, accessor);
  }
};

Json material(const detail::PartLabel& label, bool hollow) {
  const Color& color = label.color;
  // glTF's colours are linear
  const auto linear = [](std::uint8_t c) { return std::pow(double(c) / 255.0, 2.2); };
  return {{"name", label.name},
          {"doubleSided", hollow},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {linear(color.r), linear(color.g), linear(color.b), 1}},
            {"metallicFactor", 0},
            {"roughnessFactor", 0.6}}}};
}

void appendChunk(std::string& glb, std::string bytes, const char* kind, char filler) {
  bytes.resize((bytes.size() + 3) / 4 * 4, filler);
  const auto length = static_cast<std::uint32_t>(bytes.size());
  glb.append(reinterpret_cast<const char*>(&length), 4);
  glb.append(kind, 4);
  glb += bytes;
}

std::vector<TextFile> glbOf(const ModelFile& file,
                            const std::vector<detail::PartLabel>& labels,
                            const RobotExportOptions& options) {
  if (file.model.empty() || !options.isValid())
    return {};
  Buffer buffer;
  Json nodes = Json::array({Json()}), meshes = Json::array(), materials = Json::array();
  Json children = Json::array();
  for (std::size_t i = 0; i < file.model.size(); ++i) {
    const Superquadric& part = file.model.parts[i];
    // about the part's centre: floats keep their digits wherever the cloud lies
    Superquadric own = part;
    own.center.setZero();
    const detail::ShownSurface surface = detail::shownSurface(own);
    const std::size_t places = buffer.addVectors(surface.mesh.vertices, true);
    const std::size_t normals = buffer.addVectors(surface.normals, false);
    std::vector<std::uint32_t> corners;
    for (const auto& t : surface.mesh.triangles)
      corners.insert(corners.end(), t.begin(), t.end());
    const std::size_t indices = buffer.add(corners,
                                           INDICES,
                                           {{"componentType", UNSIGNED_INT},
                                            {"count", corners.size()},
                                            {"type", "SCALAR"}});
    materials.push_back(material(labels[i], part.isHollow()));
    const std::string& name = labels[i].name;
    meshes.push_back({{"name", name},
                      {"primitives",
                       {{{"attributes", {{"POSITION", places}, {"NORMAL", normals}}},
                         {"indices", indices},
                         {"material", i}}}}});
    nodes.push_back({{"name", name},
                     {"mesh", i},
                     {"translation", vectorToJson(part.center)},
                     {"extras",
                      {{"semi_axes", vectorToJson(part.semi_axes)},
                       {"epsilon", {part.epsilon1, part.epsilon2}},
                       {"sides", vectorToJson(sidesOf(part))}}}});
    children.push_back(i + 1);
  }
  const Eigen::Vector3d up =
      file.table ? Eigen::Vector3d((*file.table)[0], (*file.table)[1], (*file.table)[2])
                 : Eigen::Vector3d(-Eigen::Vector3d::UnitY());
  const Eigen::Quaterniond turn = detail::toYUp(up);
  nodes[0] = {{"name", options.name},
              {"rotation", {turn.x(), turn.y(), turn.z(), turn.w()}},
              {"children", children}};
  const Json json = {
      {"asset", {{"version", "2.0"}, {"generator", "pcl_sq " PCL_SQ_VERSION}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", nodes},
      {"meshes", meshes},
      {"materials", materials},
      {"accessors", buffer.accessors},
      {"bufferViews", buffer.views},
      {"buffers", {{{"byteLength", buffer.bytes.size()}}}}};
  std::string chunks;
  appendChunk(chunks, json.dump(), "JSON", ' ');
  appendChunk(chunks, buffer.bytes, std::string("BIN\0", 4).c_str(), '\0');
  const std::uint32_t head[] = {2, static_cast<std::uint32_t>(chunks.size() + 12)};
  std::string glb = "glTF";
  glb.append(reinterpret_cast<const char*>(head), sizeof head);
  return {{options.name + ".glb", glb + chunks}};
}

} // namespace

std::vector<TextFile> glbFiles(const ModelFile& file,
                               const RobotExportOptions& options) {
  return glbOf(file, detail::labelsOf(file.model), options);
}

std::vector<TextFile> glbFiles(const SceneFile& scene,
                               const RobotExportOptions& options) {
  return glbOf(detail::asOneModel(scene), detail::labelsOf(scene), options);
}

} // namespace pcl_sq

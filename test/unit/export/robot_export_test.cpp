// SPDX-License-Identifier: BSD-3-Clause
// The exported files, read back as far as the standard tells what must hold.
#include "export/collision_shapes.h"
#include "export/xml_text.h"

#include "pcl_sq/mass_properties.h"
#include "pcl_sq/robot_export.h"
#include "text.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <map>
#include <sstream>

using namespace pcl_sq;
using detail::CollisionShape;
using pcl_sq::test::count;

namespace {

Superquadric body(const Eigen::Vector3d& axes, double e1, double e2) {
  Superquadric s;
  s.semi_axes = axes;
  s.epsilon1 = e1;
  s.epsilon2 = e2;
  s.center = {0.2, -0.1, 0.7};
  s.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  return s;
}

ModelFile fileOf(const std::vector<Superquadric>& parts) {
  ModelFile file;
  file.model.parts = parts;
  file.frame = "camera";
  file.table = {0.0, -1.0, 0.0, 0.1};
  return file;
}

Superquadric cup() {
  Superquadric s = body({0.04, 0.04, 0.05}, 0.1, 1.0);
  s.rim = 0.9;
  s.wall = 0.004;
  return s;
}

/** \brief Whether each edge of a mesh has two triangles, and its volume. */
bool closed(const TriangleMesh& mesh, double* volume) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  *volume = 0.0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k)
      edges[std::minmax(t[k], t[(k + 1) % 3])] += t[k] < t[(k + 1) % 3] ? 1 : -1;
    *volume += mesh.vertices[t[0]].cross(mesh.vertices[t[1]]).dot(mesh.vertices[t[2]]);
  }
  *volume /= 6.0;
  for (const auto& edge : edges)
    if (edge.second != 0)
      return false;
  return true;
}

} // namespace

TEST(CollisionShapes, WhatNearlyIsAPrimitiveBecomesOne) {
  const auto kind = [](const Superquadric& s) {
    return detail::collisionShapes(s, 0.05).front().kind;
  };
  EXPECT_EQ(kind(body({0.05, 0.08, 0.1}, 0.05, 0.05)), CollisionShape::BOX);
  EXPECT_EQ(kind(body({0.04, 0.04, 0.1}, 0.05, 1.0)), CollisionShape::CYLINDER);
  EXPECT_EQ(kind(body({0.05, 0.05, 0.05}, 1.0, 1.0)), CollisionShape::SPHERE);
  EXPECT_EQ(kind(body({0.05, 0.08, 0.1}, 1.0, 1.0)), CollisionShape::MESH);
  EXPECT_EQ(kind(body({0.05, 0.05, 0.1}, 1.9, 1.9)), CollisionShape::MESH);
}

TEST(CollisionShapes, APrimitiveHasTheVolumeOfItsPart) {
  const Superquadric s = body({0.03, 0.05, 0.08}, 0.05, 0.05);
  const CollisionShape box = detail::collisionShapes(s, 0.05).front();
  EXPECT_NEAR(8.0 * box.half_sizes.prod(), s.volume(), 0.03 * s.volume());
  EXPECT_LT((box.center - s.center).norm(), 1e-12);
  for (int k = 0; k < 3; ++k) // its sides lie along the part's axes
    EXPECT_NEAR((s.rotation.transpose() * box.rotation).col(k).cwiseAbs().maxCoeff(),
                1.0,
                1e-9);
}

TEST(CollisionShapes, AConvexMeshIsClosedAndHasItsPartsVolume) {
  const Superquadric s = body({0.05, 0.08, 0.1}, 1.2, 0.7);
  const CollisionShape shape = detail::collisionShapes(s, 0.02).front();
  ASSERT_EQ(shape.kind, CollisionShape::MESH);
  double volume = 0.0;
  EXPECT_TRUE(closed(shape.mesh, &volume));
  EXPECT_NEAR(volume, s.volume(), 0.06 * s.volume());
}

TEST(CollisionShapes, AHollowPartStaysOpen) {
  const Superquadric s = cup();
  double sum = 0.0, volume = 0.0;
  for (const CollisionShape& shape : detail::collisionShapes(s, 0.05)) {
    ASSERT_EQ(shape.kind, CollisionShape::MESH);
    EXPECT_TRUE(closed(shape.mesh, &volume));
    EXPECT_GT(volume, 0.0);
    sum += volume;
    // no piece reaches into the middle of the hollow
    for (const Eigen::Vector3d& v : shape.mesh.vertices) {
      const Eigen::Vector3d local = s.toLocal(shape.center + v);
      EXPECT_TRUE(local.z() < -0.9 * 0.05 + 0.004 ||
                  local.head<2>().norm() > 0.9 * 0.036)
          << local.transpose();
    }
  }
  EXPECT_NEAR(sum, s.materialVolume(), 0.25 * s.materialVolume());
}

TEST(RobotExport, AnglesTurnAsTheRotationDoes) {
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d r =
        Eigen::Quaterniond(Eigen::Vector4d::Random().normalized()).toRotationMatrix();
    const Eigen::Vector3d a = detail::rollPitchYaw(r);
    const Eigen::Matrix3d again = (Eigen::AngleAxisd(a.z(), Eigen::Vector3d::UnitZ()) *
                                   Eigen::AngleAxisd(a.y(), Eigen::Vector3d::UnitY()) *
                                   Eigen::AngleAxisd(a.x(), Eigen::Vector3d::UnitX()))
                                      .toRotationMatrix();
    EXPECT_LT((again - r).norm(), 1e-9);
  }
  for (const double sign : {1.0, -1.0}) { // straight up and down
    const Eigen::Matrix3d r =
        (Eigen::AngleAxisd(sign * M_PI_2, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()))
            .toRotationMatrix();
    const Eigen::Vector3d a = detail::rollPitchYaw(r);
    EXPECT_NEAR(a.y(), sign * M_PI_2, 1e-6);
    EXPECT_NEAR(a.x(), 0.4, 1e-6);
  }
}

TEST(RobotExport, UrdfAndSdfNameMeshesThatAreThere) {
  const ModelFile file = fileOf(
      {cup(), body({0.01, 0.02, 0.03}, 0.05, 0.05), body({0.01, 0.02, 0.03}, 1, 1)});
  RobotExportOptions options;
  options.name = "mug";
  options.mesh_prefix = "package://p/";
  for (const char* ending : {".urdf", ".sdf"}) {
    const std::vector<TextFile> files = robotFiles(ending, file, options);
    ASSERT_GT(files.size(), 2u);
    EXPECT_EQ(files[0].path, std::string("mug") + ending);
    for (std::size_t i = 1; i < files.size(); ++i) {
      EXPECT_EQ(count(files[0].contents, "package://p/" + files[i].path), 1u);
      std::uint32_t triangles = 0;
      std::memcpy(&triangles, files[i].contents.data() + 80, 4);
      EXPECT_EQ(files[i].contents.size(), 84 + 50 * std::size_t(triangles));
    }
    EXPECT_EQ(count(files[0].contents, "nan"), 0u);
  }
}

TEST(RobotExport, TheMassIsTheDensityTimesTheVolume) {
  const ModelFile file = fileOf({body({0.05, 0.08, 0.1}, 0.3, 0.6)});
  RobotExportOptions options;
  options.density = 1000.0;
  const std::string text = urdfFiles(file, options)[0].contents;
  const std::size_t at = text.find("mass value=\"") + 12;
  EXPECT_NEAR(std::stod(text.substr(at)), 1000.0 * file.model.parts[0].volume(), 1e-6);
}

TEST(RobotExport, AMoveItSceneHasItsCountsRight) {
  const ModelFile file = fileOf({cup(), body({0.01, 0.02, 0.03}, 0.05, 0.05)});
  std::istringstream text(moveitFiles(file)[0].contents);
  std::string line, word;
  std::getline(text, line);
  EXPECT_EQ(line, "object");
  int objects = 0, shapes_read = 0;
  while (std::getline(text, line) && line != ".") {
    ASSERT_EQ(line.substr(0, 2), "* ");
    ++objects;
    double number = 0.0;
    for (int i = 0; i < 7; ++i)
      ASSERT_TRUE(text >> number);
    int shapes = 0;
    ASSERT_TRUE(text >> shapes);
    for (int i = 0; i < shapes; ++i, ++shapes_read) {
      ASSERT_TRUE(text >> word);
      int numbers = word == "box"        ? 3
                    : word == "cylinder" ? 2
                    : word == "sphere"   ? 1
                                         : 0;
      if (word == "mesh") {
        int vertices = 0, triangles = 0;
        ASSERT_TRUE(text >> vertices >> triangles);
        numbers = 3 * (vertices + triangles);
      }
      ASSERT_GT(numbers, 0) << word;
      for (int k = 0; k < numbers + 7 + 4; ++k) // pose, colour
        ASSERT_TRUE(text >> number);
    }
    int subframes = -1;
    ASSERT_TRUE(text >> subframes);
    EXPECT_EQ(subframes, 0);
    std::getline(text, line);
  }
  EXPECT_EQ(objects, 2); // and the table
  EXPECT_GT(shapes_read, 3);
  EXPECT_EQ(line, ".");
}

/** \brief The description in a binary glTF, whose lengths are those it says. */
nlohmann::json jsonOf(const std::string& glb) {
  const auto word = [&](std::size_t at) {
    std::uint32_t n = 0;
    std::memcpy(&n, glb.data() + at, 4);
    return std::size_t(n);
  };
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(word(8), glb.size());
  nlohmann::json json = nlohmann::json::parse(glb.substr(20, word(12)));
  const std::size_t bin = 20 + word(12);
  EXPECT_EQ(glb.substr(bin + 4, 3), "BIN");
  EXPECT_EQ(bin + 8 + word(bin), glb.size());
  for (const auto& view : json["bufferViews"])
    EXPECT_LE(std::size_t(view["byteOffset"]) + std::size_t(view["byteLength"]),
              word(bin));
  return json;
}

TEST(RobotExport, GlbHasANodeForEachPart) {
  const ModelFile file = fileOf({cup(), body({0.01, 0.02, 0.03}, 0.05, 0.05)});
  const nlohmann::json json = jsonOf(glbFiles(file)[0].contents);
  ASSERT_EQ(json["nodes"].size(), 3u);
  EXPECT_EQ(json["nodes"][1]["name"], "part 1");
  // the root turns up, against the table's -y, to glTF's +y
  const auto& q = json["nodes"][0]["rotation"];
  const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
  EXPECT_LT((turn * Eigen::Vector3d(0, -1, 0) - Eigen::Vector3d::UnitY()).norm(), 1e-9);
}

TEST(RobotExport, NothingComesOfAnEmptyModelOrBadOptions) {
  RobotExportOptions options;
  for (const char* ending : {".urdf", ".sdf", ".scene", ".glb", ".doc"})
    EXPECT_TRUE(robotFiles(ending, ModelFile(), options).empty());
  options.name = "no/name";
  EXPECT_TRUE(urdfFiles(fileOf({cup()}), options).empty());
}

/** \brief A cup and a body of two parts on one table. */
SceneFile twoThings() {
  SceneFile scene;
  scene.frame = "camera";
  scene.table = {0.0, -1.0, 0.0, 0.1};
  scene.objects.resize(2);
  scene.objects[0].file.model.parts = {cup()};
  scene.objects[1].file.model.parts = {body({0.03, 0.03, 0.05}, 0.1, 1.0),
                                       body({0.01, 0.02, 0.03}, 0.05, 0.05)};
  return scene;
}

TEST(RobotExport, AMoveItSceneHasAnObjectForEachThingAndTheTable) {
  RobotExportOptions options;
  options.name = "kitchen";
  const std::string text = moveitFiles(twoThings(), options)[0].contents;
  EXPECT_EQ(count(text, "\n* "), 3u);
  for (const char* name : {"kitchen_1", "kitchen_2", "kitchen_table"})
    EXPECT_EQ(count(text, "* " + std::string(name) + "\n"), 1u) << name;
}

TEST(RobotExport, GlbOfASceneNamesThingsAndGivesEachItsColour) {
  const nlohmann::json json = jsonOf(glbFiles(twoThings())[0].contents);
  std::vector<std::string> names;
  std::vector<nlohmann::json> colours;
  for (const auto& node : json["nodes"])
    if (node.contains("mesh")) {
      names.push_back(node["name"]);
      const auto& primitive = json["meshes"][int(node["mesh"])]["primitives"][0];
      colours.push_back(json["materials"][int(primitive["material"])]
                            ["pbrMetallicRoughness"]["baseColorFactor"]);
    }
  ASSERT_EQ(
      names,
      (std::vector<std::string>{"thing 1", "thing 2, part 1", "thing 2, part 2"}));
  EXPECT_EQ(colours[1], colours[2]);
  EXPECT_NE(colours[0], colours[1]);
}

TEST(RobotExport, NothingComesOfASceneWithoutThingsOrAnotherEnding) {
  EXPECT_TRUE(robotFiles(".scene", SceneFile()).empty());
  EXPECT_TRUE(robotFiles(".glb", SceneFile()).empty());
  EXPECT_TRUE(robotFiles(".urdf", twoThings()).empty()); // one file is one robot
}

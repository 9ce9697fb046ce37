// SPDX-License-Identifier: BSD-3-Clause
// What a simulator needs of an export: bodies apart, contacts with the surface's
// normals.
#include "pcl_sq/graspit_export.h"

#include "union/shortest_turn.h"

#include "mesh_errors.h"

#include <gtest/gtest.h>

#include <sstream>

using namespace pcl_sq;
using pcl_sq::test::isWatertight;

namespace {

Superquadric part(const Eigen::Vector3d& semi_axes, double e1, double e2) {
  Superquadric s;
  s.semi_axes = semi_axes;
  s.epsilon1 = e1;
  s.epsilon2 = e2;
  return s;
}

MultiSuperquadric bottle() {
  MultiSuperquadric model;
  model.parts = {part({0.033, 0.033, 0.1}, 0.2, 1.0),
                 part({0.013, 0.013, 0.04}, 0.2, 1.0)};
  model.parts[1].center.z() = 0.13;
  return model;
}

std::string contentsOf(const std::vector<TextFile>& files, const std::string& path) {
  for (const TextFile& file : files)
    if (file.path == path)
      return file.contents;
  ADD_FAILURE() << "no file " << path;
  return {};
}

/** \brief A mesh of an OFF file, in metres about the centre of the model's frame. */
TriangleMesh meshOf(const std::string& text, const Eigen::Vector3d& center) {
  std::istringstream stream(text);
  std::string word;
  std::size_t vertices = 0, triangles = 0, rest = 0;
  stream >> word >> vertices >> triangles >> rest;
  TriangleMesh mesh;
  mesh.vertices.resize(vertices);
  for (Eigen::Vector3d& v : mesh.vertices) {
    stream >> v[0] >> v[1] >> v[2];
    v = 1e-3 * v + center;
  }
  mesh.triangles.resize(triangles);
  for (auto& t : mesh.triangles)
    stream >> rest >> t[0] >> t[1] >> t[2];
  EXPECT_TRUE(bool(stream));
  return mesh;
}

TriangleMesh exported(const MultiSuperquadric& model) {
  return meshOf(contentsOf(graspitFiles(model), "models/objects/object.off"),
                massProperties(model).center);
}

} // namespace

TEST(GraspitWorld, ContactsOnTheMeshHaveTheNormalsOfTheSurface) {
  MultiSuperquadric can, box, mug = bottle();
  can.parts = {part({0.033, 0.033, 0.06}, 0.1, 1.0)};
  box.parts = {part({0.02, 0.03, 0.05}, 0.1, 0.1)};
  mug.parts = {part({0.04, 0.04, 0.05}, 0.1, 1.0),
               part({0.005, 0.005, 0.03}, 0.3, 1.0)};
  mug.parts[1].center.x() = 0.043;
  for (const MultiSuperquadric& model : {can, box, bottle(), mug}) {
    const TriangleMesh mesh = exported(model);
    EXPECT_TRUE(isWatertight(mesh));
    EXPECT_LT(mesh.triangles.size(), 6000u);
    const test::MeshErrors errors = test::errorsOf(model, mesh, 1e-4, 1000);
    EXPECT_LT(errors.askew, 0.01);
    EXPECT_LT(errors.outward, 1e-4);
    EXPECT_LT(errors.inward, 1e-4);
    for (const Eigen::Vector3d& v : mesh.vertices)
      EXPECT_NEAR(model.gauge(v), 1.0, 1e-4); // text has nine digits
  }
}

TEST(GraspitWorld, TheTableIsJustBelowTheLowestVertex) {
  GraspitOptions options;
  options.has_table = true;
  options.table_normal = Eigen::Vector3d(0.2, -0.9, -0.4).normalized();
  MultiSuperquadric model = bottle();
  for (Superquadric& s : model.parts) { // upright on the table
    const Eigen::Matrix3d turn =
        detail::shortestTurn(Eigen::Vector3d::UnitZ(), options.table_normal);
    s.center = turn * s.center;
    s.rotation = turn * s.rotation;
  }
  for (const double into : {0.0, 0.002, -0.002}) { // where a fit may put the table
    options.table_offset = 0.1 - into;
    const auto files = graspitFiles(model, options);
    const TriangleMesh mesh = meshOf(contentsOf(files, "models/objects/object.off"),
                                     massProperties(model).center);
    double lowest = 1e9;
    for (const Eigen::Vector3d& v : mesh.vertices)
      lowest = std::min(lowest, options.table_normal.dot(v));
    const std::string world = contentsOf(files, "worlds/object.xml");
    const std::size_t obstacle = world.find("<obstacle>");
    const std::size_t open = world.find('[', obstacle);
    std::istringstream numbers(world.substr(open + 1));
    Eigen::Vector3d top;
    numbers >> top[0] >> top[1] >> top[2];
    EXPECT_NEAR(lowest - options.table_normal.dot(1e-3 * top), 3e-4, 1e-6) << into;
  }
}

TEST(GraspitWorld, AWorldOfThePartsHasEachInItsPlace) {
  GraspitOptions options;
  options.name = "flask";
  options.part_bodies = true;
  const MultiSuperquadric model = bottle();
  const auto files = graspitFiles(model, options);
  const std::string world = contentsOf(files, "worlds/flask_parts.xml");
  EXPECT_EQ(world.find("flask.xml"), std::string::npos);
  for (std::size_t k = 0; k < model.size(); ++k) {
    const std::string name = "models/objects/flask_part" + std::to_string(k);
    const std::size_t at = world.find("<filename>" + name + ".xml</filename>");
    ASSERT_NE(at, std::string::npos);
    std::istringstream numbers(world.substr(world.find('[', at) + 1));
    Eigen::Vector3d center;
    numbers >> center[0] >> center[1] >> center[2];
    EXPECT_LT((1e-3 * center - model.parts[k].center).norm(), 1e-9);
    EXPECT_TRUE(isWatertight(meshOf(contentsOf(files, name + ".off"), center)));
  }
}

TEST(GraspitWorld, GraspsStartTheRetreatBackFromTheirPalm) {
  GraspitOptions options;
  options.grasps.resize(1);
  options.grasps[0].position = {0.1, 0.2, 0.3};
  options.retreat = 0.0;
  const auto at = [&] {
    std::istringstream line(
        contentsOf(graspitFiles(bottle(), options), "object_grasps.txt").substr(1));
    Eigen::Vector3d palm;
    line >> palm[0] >> palm[1] >> palm[2];
    return palm;
  };
  const Eigen::Vector3d final_palm = at();
  options.retreat = 0.08;
  EXPECT_LT((at() - (final_palm - 80.0 * options.grasps[0].approach())).norm(), 1e-6);
  options.retreat = -1.0;
  EXPECT_TRUE(graspitFiles(bottle(), options).empty());
}

// SPDX-License-Identifier: BSD-3-Clause
// Reads the files back as GraspIt! 4 does: findXmlElement for the tags, line by line
// for OFF, "(w x y z)[x y z]" for transforms.
#include "pcl_sq/graspit_export.h"

#include "random_superquadric.h"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <gtest/gtest.h>

#include <map>
#include <sstream>

using namespace pcl_sq;
using boost::property_tree::ptree;
using pcl_sq::test::Random;

namespace {

MultiSuperquadric placedBottle() {
  MultiSuperquadric bottle;
  bottle.parts.resize(2);
  bottle.parts[0].semi_axes = {0.033, 0.033, 0.1};
  bottle.parts[0].epsilon1 = 0.2;
  bottle.parts[0].center = {0.4, -0.1, 0.9};
  bottle.parts[1] = bottle.parts[0];
  bottle.parts[1].semi_axes = {0.013, 0.013, 0.04};
  bottle.parts[1].center.z() += 0.13;
  return bottle;
}

std::map<std::string, std::string> byPath(const std::vector<TextFile>& files) {
  std::map<std::string, std::string> all;
  for (const TextFile& file : files)
    EXPECT_TRUE(all.emplace(file.path, file.contents).second) << file.path;
  return all;
}

ptree xml(const std::string& text) {
  std::istringstream stream(text);
  ptree tree;
  boost::property_tree::read_xml(stream, tree);
  return tree;
}

std::vector<double> numbers(std::string text) {
  for (char& c : text)
    if (std::string("()[],").find(c) != std::string::npos)
      c = ' ';
  std::istringstream stream(text);
  std::vector<double> all;
  for (double x; stream >> x;)
    all.push_back(x);
  return all;
}

/** \brief OFF as GraspIt!'s loadGeometryOFF takes it: no empty line anywhere. */
TriangleMesh readOff(const std::string& text) {
  std::istringstream stream(text);
  std::string line;
  TriangleMesh mesh;
  std::getline(stream, line);
  EXPECT_EQ(line, "OFF");
  std::getline(stream, line);
  const std::vector<double> counts = numbers(line);
  EXPECT_EQ(counts.size(), 3u);
  for (int i = 0; i < int(counts[0]); ++i) {
    std::getline(stream, line);
    const std::vector<double> v = numbers(line);
    EXPECT_EQ(v.size(), 3u);
    mesh.vertices.emplace_back(v[0], v[1], v[2]);
  }
  for (int i = 0; i < int(counts[1]); ++i) {
    std::getline(stream, line);
    const std::vector<double> f = numbers(line);
    EXPECT_EQ(f.size(), 4u);
    EXPECT_EQ(f[0], 3.0);
    mesh.triangles.push_back(
        {std::uint32_t(f[1]), std::uint32_t(f[2]), std::uint32_t(f[3])});
    for (const auto index : mesh.triangles.back())
      EXPECT_LT(index, mesh.vertices.size());
  }
  EXPECT_FALSE(std::getline(stream, line)); // nothing left
  return mesh;
}

double volume(const TriangleMesh& mesh) {
  double v = 0.0;
  for (const auto& t : mesh.triangles)
    v += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6.0;
  return v;
}

} // namespace

TEST(GraspitExport, TheBodyHasMassInGramsAndInertiaOfUnitMassInSquareMillimetres) {
  GraspitOptions options;
  options.density = 1000.0;
  const auto files = byPath(graspitFiles(placedBottle(), options));
  const ptree body = xml(files.at("models/objects/object.xml"));
  const MassProperties mass = massProperties(placedBottle());
  EXPECT_NEAR(body.get<double>("root.mass"), mass.volume * 1e6, 1e-3); // litre = 1 kg
  EXPECT_EQ(numbers(body.get<std::string>("root.cog")), std::vector<double>(3, 0.0));
  EXPECT_EQ(body.get<std::string>("root.material"), "plastic");
  EXPECT_EQ(body.get<std::string>("root.geometryFile.<xmlattr>.type"), "off");
  EXPECT_EQ(body.get<std::string>("root.geometryFile"), "object.off");
  const std::vector<double> inertia =
      numbers(body.get<std::string>("root.inertia_matrix"));
  ASSERT_EQ(inertia.size(), 9u);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(inertia[std::size_t(3 * r + c)],
                  1e6 * mass.inertia(r, c) / mass.volume,
                  1e-3);
}

TEST(GraspitExport, TheMeshIsTheUnionAboutItsCentreOfGravityInMillimetres) {
  const auto files = byPath(graspitFiles(placedBottle()));
  const TriangleMesh mesh = readOff(files.at("models/objects/object.off"));
  const MassProperties mass = massProperties(placedBottle());
  EXPECT_NEAR(volume(mesh), 1e9 * mass.volume, 0.01 * 1e9 * mass.volume);
  for (const Eigen::Vector3d& v : mesh.vertices)
    EXPECT_NEAR(placedBottle().gauge(1e-3 * v + mass.center), 1.0, 1e-4);
}

TEST(GraspitExport, TheWorldPlacesTheBodyWhereTheModelIs) {
  GraspitOptions options;
  options.name = "bottle-1";
  options.has_table = true;
  options.table_offset = -0.8;
  const auto files = byPath(graspitFiles(placedBottle(), options));
  const ptree world = xml(files.at("worlds/bottle-1.xml"));
  const std::string body = world.get<std::string>("world.graspableBody.filename");
  EXPECT_EQ(files.count(body), 1u) << body;
  const std::vector<double> pose =
      numbers(world.get<std::string>("world.graspableBody.transform.fullTransform"));
  ASSERT_EQ(pose.size(), 7u);
  EXPECT_EQ(pose[0], 1.0); // w first
  const Eigen::Vector3d center = massProperties(placedBottle()).center;
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(pose[std::size_t(4 + k)], 1e3 * center[k], 1e-4);
  const std::string table = world.get<std::string>("world.obstacle.filename");
  EXPECT_EQ(files.count(table), 1u) << table;
  const TriangleMesh plate = readOff(files.at("models/obstacles/bottle-1_table.off"));
  EXPECT_NEAR(volume(plate), 1000.0 * 1000.0 * 20.0, 1e-3); // closed and outwards
  const std::vector<double> at =
      numbers(world.get<std::string>("world.obstacle.transform.fullTransform"));
  double top = -1e9;
  const Eigen::Quaterniond q(at[0], at[1], at[2], at[3]);
  for (const Eigen::Vector3d& v : plate.vertices)
    top = std::max(top, (q * v).z() + at[6]);
  EXPECT_NEAR(top, 799.7, 0.1); // just below the bottle, to the mesh's tolerance
  EXPECT_EQ(numbers(world.get<std::string>("world.camera.orientation")).size(), 4u);
}

TEST(GraspitExport, TheCameraLooksAtTheObjectWithTheTableBelow) {
  GraspitOptions options;
  options.has_table = true;
  options.table_normal = Eigen::Vector3d(0.0, -1.0, -0.5).normalized();
  const auto files = byPath(graspitFiles(placedBottle(), options));
  const ptree world = xml(files.at("worlds/object.xml"));
  const std::vector<double> p =
      numbers(world.get<std::string>("world.camera.position"));
  const std::vector<double> o =
      numbers(world.get<std::string>("world.camera.orientation"));
  const double focal = world.get<double>("world.camera.focalDistance");
  const Eigen::Quaterniond q(o[3], o[0], o[1], o[2]); // x y z w
  const Eigen::Vector3d seen =
      Eigen::Vector3d(p[0], p[1], p[2]) - focal * (q * Eigen::Vector3d::UnitZ());
  EXPECT_LT((1e-3 * seen - massProperties(placedBottle()).center).norm(), 1e-6);
  EXPECT_NEAR((q * Eigen::Vector3d::UnitY()).dot(options.table_normal), 1.0, 1e-6);
}

TEST(GraspitExport, TransformsGoThereAndBack) {
  Random random(411);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d r = random.rotation();
    const Eigen::Vector3d t = random.direction();
    const std::string text = graspitTransform(r, t);
    EXPECT_EQ(text.front(), '(');
    EXPECT_EQ(text.back(), ']');
    const std::vector<double> n = numbers(text);
    ASSERT_EQ(n.size(), 7u);
    const Eigen::Quaterniond q(n[0], n[1], n[2], n[3]);
    EXPECT_LT((q.toRotationMatrix() - r).norm(), 1e-7);
    EXPECT_LT((Eigen::Vector3d(n[4], n[5], n[6]) - 1e3 * t).norm(), 1e-5);
  }
}

TEST(GraspitExport, PrimitivesAreTheShapesAPersonWouldChoose) {
  MultiSuperquadric model;
  model.parts.resize(4);
  model.parts[0].semi_axes = {0.02, 0.03, 0.05};
  model.parts[0].epsilon1 = model.parts[0].epsilon2 = 0.1;
  model.parts[1].semi_axes = {0.03, 0.03, 0.08};
  model.parts[1].epsilon1 = 0.1;
  model.parts[2].semi_axes.setConstant(0.04);
  model.parts[3].semi_axes = {0.08, 0.03, 0.03}; // a cylinder lying on x
  model.parts[3].epsilon1 = 1.0;
  model.parts[3].epsilon2 = 0.1;
  const auto files = byPath(graspitFiles(model));
  const std::string scene = files.at("models/objects/primitives/object.iv");
  EXPECT_EQ(scene.rfind("#Inventor V2.1 ascii\n", 0), 0u);
  EXPECT_NE(scene.find("Cube { width 40 height 60 depth 100 }"), std::string::npos);
  EXPECT_NE(scene.find("Cylinder { radius 30 height 160 }"), std::string::npos);
  EXPECT_NE(scene.find("Sphere { radius 40 }"), std::string::npos);
  EXPECT_EQ(std::count(scene.begin(), scene.end(), '{'),
            std::count(scene.begin(), scene.end(), '}'));
}

TEST(GraspitExport, PartBodiesAndGraspCandidatesAreOptional) {
  GraspitOptions options;
  const std::size_t plain = graspitFiles(placedBottle(), options).size();
  options.part_bodies = true;
  options.grasps.resize(3);
  options.grasps[0].position = {0.1, 0.2, 0.3};
  const auto files = byPath(graspitFiles(placedBottle(), options));
  EXPECT_EQ(files.size(), plain + 2 * 2 + 2);
  EXPECT_GT(volume(readOff(files.at("models/objects/object_part1.off"))), 0.0);
  std::istringstream lines(files.at("object_grasps.txt"));
  std::string line;
  int count = 0;
  while (std::getline(lines, line)) {
    EXPECT_EQ(numbers(line).size(), 10u); // palm, approach, thumb, spread
    ++count;
  }
  EXPECT_EQ(count, 3);
}

TEST(GraspitExport, BadInputGivesNoFiles) {
  EXPECT_TRUE(graspitFiles({}).empty());
  GraspitOptions options;
  options.name = "../etc";
  EXPECT_TRUE(graspitFiles(placedBottle(), options).empty());
  options = {};
  options.density = 0.0;
  std::string why;
  EXPECT_FALSE(options.isValid(&why));
  EXPECT_NE(why.find("density"), std::string::npos);
  MultiSuperquadric broken = placedBottle();
  broken.parts[0].epsilon1 = 7.0;
  EXPECT_TRUE(graspitFiles(broken).empty());
}

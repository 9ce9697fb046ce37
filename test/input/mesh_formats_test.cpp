// SPDX-License-Identifier: BSD-3-Clause
#include "file_bytes.h"
#include "scene/mesh_reader.h"

#include <gtest/gtest.h>

#include <cstdio>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

const std::string TETRAHEDRON =
    "# a comment\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 1 3 2\nf 1/1 2/2 4/3\nf -4//1 -1//1 -2//1\nf 2 3 4\n";

/** \brief The same as STL, a corner's coordinates repeated in each facet. */
std::string stl(bool binary) {
  const app::Shape shape = app::readShape(TETRAHEDRON, ".obj");
  std::string text = "solid a thing\n", bytes(80, ' ');
  bytes += bytesOf(static_cast<std::uint32_t>(shape.triangles.size()));
  for (const auto& triangle : shape.triangles) {
    text += "facet normal 0 0 0\n outer loop\n";
    bytes += std::string(12, '\0');
    for (const std::uint32_t corner : triangle) {
      const Eigen::Vector3f v = shape.points[corner].cast<float>();
      text += "  vertex " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " +
              std::to_string(v.z()) + "\n";
      bytes += bytesOf(v.x()) + bytesOf(v.y()) + bytesOf(v.z());
    }
    text += " endloop\nendfacet\n";
    bytes += "ab";
  }
  return binary ? bytes : text + "endsolid a thing\n";
}

double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles)
    sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  return sum / 6.0;
}

} // namespace

TEST(MeshFormats, TheSameMeshFromEachOfThemWithEqualVerticesWelded) {
  std::string solid = stl(true);
  solid.replace(0, 5, "solid"); // as some programs begin binary ones
  for (const std::string& bytes : {TETRAHEDRON, stl(false), stl(true), solid}) {
    const TriangleMesh mesh = app::makeMesh(app::readShape(bytes, ""));
    EXPECT_EQ(mesh.vertices.size(), 4u);
    EXPECT_EQ(mesh.triangles.size(), 4u);
    EXPECT_NEAR(volume(mesh), 1.0 / 6.0, 1e-6);
  }
}

TEST(MeshFormats, ObjLinesMayGoOnAndVerticesMayHaveColours) {
  const app::Shape shape = app::readShape(
      "v 1 2 3 1 0 0.2\nv 1 2 \\\n 4 0 0 0\nv 0 0 0 0 1 0\nf 1 \\\r\n 2 3\n", ".obj");
  ASSERT_EQ(shape.points.size(), 3u);
  EXPECT_EQ(shape.points[1], Eigen::Vector3d(1, 2, 4));
  EXPECT_EQ(shape.triangles.size(), 1u);
  ASSERT_EQ(shape.colors.size(), 3u);
  EXPECT_EQ(shape.colors[0], 0xff0033u);
}

TEST(MeshFormats, NamesTheLineThatIsWrong) {
  const auto refused = [](const std::string& from, const std::string& to) {
    return refusal(replaced(TETRAHEDRON, from, to), ".obj");
  };
  EXPECT_TRUE(tells(refused("f 2 3 4", "f 2 3 5"), {"line 9", "'5'"}));
  EXPECT_TRUE(tells(refused("f 2 3 4", "f 2 3 -9"), {"line 9", "'-9'"}));
  EXPECT_TRUE(tells(refused("f 2 3 4", "f 2 3 x"), {"line 9", "'x'"}));
  EXPECT_TRUE(tells(refused("f 2 3 4", "f 2 3 0"), {"line 9", "'0'"}));
  EXPECT_TRUE(tells(refused("v 1 0 0", "v 1 0"), {"line 3", "three numbers"}));
  EXPECT_TRUE(tells(refused("v 1 0 0", "v 1 0 0b"), {"line 3", "'0b'"}));
  EXPECT_TRUE(tells(refusal("solid\nfacet\nouter loop\nvertex 1 2\n", ".stl"),
                    {"line 4", "three numbers"}));
  EXPECT_TRUE(tells(refusal("1 2 3\n", ".stl"), {"no STL"}));
}

TEST(MeshFormats, LengthsThatAreNoneAreRefused) {
  for (const std::string length : {"1e200", "nan", "-1e10", "inf"})
    EXPECT_THROW((void)app::makeMesh(app::readShape(
                     replaced(TETRAHEDRON, "v 1 0 0", "v " + length + " 0 0"), ".obj")),
                 app::Failure)
        << length;
}

TEST(MeshFormats, ATruncatedBinaryStlIsCalledTruncated) {
  const std::string whole = stl(true);
  for (const std::size_t missing : {1u, 50u, 120u, 190u})
    for (const char* head : {"", "solid"}) {
      std::string bytes = head + whole.substr(std::string(head).size());
      bytes.resize(bytes.size() - missing);
      const std::string why = refusal(bytes, ".stl");
      EXPECT_TRUE(tells(why, {"is truncated"})) << missing << head << ": " << why;
    }
  EXPECT_TRUE(tells(refusal(whole.substr(0, whole.size() - 60), ".stl"),
                    {"promises 4 facets", "ends after 2"}));
  // what some programs write behind the last facet
  EXPECT_EQ(app::readShape(whole + "\r\n", ".stl").faces, 4u);
  EXPECT_TRUE(tells(refusal(whole + whole.substr(84, 50), ".stl"),
                    {"promises 4 facets", "bytes for 5"}));
}

TEST(MeshFormats, StripsOfTrianglesArePlySurfaces) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
      "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
      "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n5 5 5\n";
  const app::Shape shape = app::readShape(ply + "9 0 1 2 3 4 -1 3 4 5\n", ".ply");
  ASSERT_EQ(shape.faces, 4u);
  for (std::size_t i = 0; i < 3; ++i) { // all seen from one side
    const auto& t = shape.triangles[i];
    const Eigen::Vector3d a = shape.points[t[0]];
    EXPECT_GT((shape.points[t[1]] - a).cross(shape.points[t[2]] - a).z(), 0.0) << i;
  }
  EXPECT_EQ(shape.triangles[3], (std::array<std::uint32_t, 3>{3, 4, 5}));
  EXPECT_TRUE(
      tells(refusal(ply + "3 0 1 6\n", ".ply"), {"vertex that does not exist"}));
}

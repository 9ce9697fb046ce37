// SPDX-License-Identifier: BSD-3-Clause
#include "file_bytes.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

std::string header(const std::string& format, const std::string& elements) {
  return "ply\nformat " + format + " 1.0\ncomment a comment\n" + elements +
         "end_header\n";
}

std::string vertexElement(const std::string& type, int count = 1) {
  std::string text = "element vertex " + std::to_string(count) + "\n";
  for (const char* axis : {"x", "y", "z"})
    text += "property " + type + " " + axis + "\n";
  return text;
}

template <typename T>
std::string typedPly(const std::string& type, bool big) {
  return header(big ? "binary_big_endian" : "binary_little_endian",
                vertexElement(type)) +
         bytesOf(T(7), big) + bytesOf(T(100), big) + bytesOf(T(31), big);
}

void expectPoints(const app::Shape& shape, std::size_t count = 1) {
  ASSERT_EQ(shape.points.size(), count);
  EXPECT_EQ(shape.points[0], Eigen::Vector3d(7, 100, 31));
}

} // namespace

TEST(PlyReader, ReadsEveryTypeOfNumbersInBothOrders) {
  for (const bool big : {false, true})
    for (const std::string& bytes : {typedPly<float>("float", big),
                                     typedPly<float>("float32", big),
                                     typedPly<double>("double", big),
                                     typedPly<double>("float64", big),
                                     typedPly<std::int8_t>("char", big),
                                     typedPly<std::uint8_t>("uint8", big),
                                     typedPly<std::int16_t>("short", big),
                                     typedPly<std::uint16_t>("uint16", big),
                                     typedPly<std::int32_t>("int", big),
                                     typedPly<std::uint32_t>("uint", big)}) {
      SCOPED_TRACE(bytes);
      expectPoints(app::readShape(bytes, ".ply"));
      expectPoints(app::readShape(bytes, ""));
    }
}

TEST(PlyReader, MoreThanTheHeaderNamesIsRefused) {
  for (const bool big : {false, true}) {
    const std::string bytes = typedPly<float>("float", big);
    expectPoints(app::readShape(bytes + "\n", ".ply"));
    EXPECT_TRUE(tells(refusal(bytes + bytesOf(7.0f, big) + bytesOf(8.0f, big), ".ply"),
                      {"8 bytes more than its header names"}));
  }
}

TEST(PlyReader, ReadsVerticesThatStandOnSeveralLines) {
  const std::string colored = vertexElement("float32", 2) +
                              "property uchar red\nproperty uchar green\n"
                              "property uchar blue\n";
  const std::string text =
      header("ascii", colored) + "7 100 31 \n16 32 48 \n1 2\n3\n1 2 3\n";
  for (const std::string& bytes : {text, replaced(text, "\n", "\r\n")}) {
    const app::Shape shape = app::readShape(bytes, ".ply");
    expectPoints(shape, 2);
    EXPECT_EQ(shape.points[1], Eigen::Vector3d(1, 2, 3));
    ASSERT_EQ(shape.colors.size(), 2u);
    EXPECT_EQ(shape.colors[0], 0x102030u);
  }
}

TEST(PlyReader, ReadsCapitalNamesAndSkipsWhatItDoesNotKnow) {
  const std::string list = "property list uchar int views\n";
  const std::string other = "element material 2\nproperty int id\nproperty list uchar "
                            "float weights\n";
  const std::string text = header("ascii", other + vertexElement("float", 2) + list);
  expectPoints(
      app::readShape(text + "1 2 .5 .5\n2 0\n7 100 31 1 4\n1 2 3 2 4 5\n", ".ply"), 2);
  expectPoints(app::readShape(
      replaced(header("ascii", vertexElement("float")), "float ", "float ") +
          "7 100 31",
      ".ply"));
  std::string capital = header("ascii", vertexElement("float"));
  for (const char* axis : {"x", "y", "z"})
    capital = replaced(capital,
                       std::string("float ") + axis + "\n",
                       std::string("float ") + char(axis[0] - 32) + "\n");
  expectPoints(app::readShape(capital + "7 100 31\n", ".ply"));
  // the same in binary
  std::string bytes =
      header("binary_little_endian", other + vertexElement("float", 2) + list);
  bytes += bytesOf(1) + "\2" + bytesOf(.5f) + bytesOf(.5f) + bytesOf(2);
  bytes += '\0';
  bytes += bytesOf(7.f) + bytesOf(100.f) + bytesOf(31.f) + "\1" + bytesOf(4);
  bytes += bytesOf(1.f) + bytesOf(2.f) + bytesOf(3.f) + "\2" + bytesOf(4) + bytesOf(5);
  expectPoints(app::readShape(bytes, ".ply"), 2);
}

TEST(PlyReader, ReadsFacesBeforeOrBehindTheVertices) {
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  for (const bool first : {false, true}) {
    const std::string vertex = vertexElement("float", 4);
    const std::string points = "7 100 31\n0 0 0\n1 0 0\n0 1 0\n",
                      corners = "4 0 1 2 3\n";
    const app::Shape shape =
        app::readShape(header("ascii", first ? face + vertex : vertex + face) +
                           (first ? corners + points : points + corners),
                       ".ply");
    expectPoints(shape, 4);
    EXPECT_EQ(shape.faces, 1u);
    ASSERT_EQ(shape.triangles.size(), 2u);
    EXPECT_EQ(shape.triangles[1], (std::array<std::uint32_t, 3>{0, 2, 3}));
  }
}

TEST(PlyReader, LaysVerticesOutInTheRangeGrid) {
  const std::string text =
      replaced(header("ascii",
                      vertexElement("float", 2) +
                          "element range_grid 4\nproperty list uchar int "
                          "vertex_indices\n"),
               "comment a comment",
               "obj_info num_cols 2\nobj_info num_rows 2") +
      "7 100 31\n1 2 3\n1 0\n0\n0\n1 1\n";
  const app::Shape shape = app::readShape(text, ".ply");
  expectPoints(shape, 4);
  EXPECT_EQ(shape.width, 2u);
  EXPECT_EQ(shape.height, 2u);
  EXPECT_TRUE(std::isnan(shape.points[1].x()));
  EXPECT_EQ(shape.points[3], Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(refusal(replaced(text, "1 1\n", "1 2\n"), ".ply").empty());
  EXPECT_FALSE(refusal(replaced(text, "num_cols 2", "num_cols 3"), ".ply").empty());
}

TEST(PlyReader, NamesTheLineOrThePropertyThatIsWrong) {
  const std::string text =
      header("ascii", vertexElement("float", 2)) + "1 2 3\n4 5 6\n";
  const auto refused = [&](const std::string& from, const std::string& to) {
    const std::string why = refusal(replaced(text, from, to), ".ply");
    EXPECT_FALSE(why.empty()) << from << " -> " << to;
    return why;
  };
  EXPECT_TRUE(tells(refused("5", "5abc"), {"line 10", "'5abc'"}));
  EXPECT_TRUE(tells(refused("4 5 6", "4 5555"), {"2 of 'vertex'", "after 1"}));
  EXPECT_TRUE(tells(refused("4 5 6", "4 5 6 7"), {"line 10", "more numbers"}));
  EXPECT_TRUE(tells(refused("float y", "float v"), {"no property 'y'"}));
  EXPECT_TRUE(tells(refused("float y", "floot y"), {"line 6", "'floot'"}));
  EXPECT_TRUE(tells(refused("vertex 2", "vertex two"), {"line 4", "'two'"}));
  EXPECT_TRUE(tells(refused("ascii", "morse"), {"line 2", "'morse'"}));
  EXPECT_TRUE(tells(refused("comment", "komment"), {"line 3", "'komment'"}));
  EXPECT_TRUE(tells(refused("end_header", "end"), {"'end'"}));
  EXPECT_TRUE(tells(refused("vertex 2", "points 2"), {"no vertices"}));
}

TEST(PlyReader, NeverBelievesAHeaderThatTheFileDoesNotBack) {
  for (const std::string format : {"ascii", "binary_little_endian"}) {
    for (const std::string count : {"40000000000", "18446744073709551615"}) {
      const std::string vertex = vertexElement("float", 4);
      const std::string body = "111122223333111122223333111122223333 1 2 3 4 5 6 7 8 9";
      EXPECT_FALSE(
          refusal(header(format, replaced(vertex, "vertex 4", "vertex " + count)) +
                      body,
                  ".ply")
              .empty());
      // nothing follows for an element without properties: it is no work
      const std::string empty =
          header(format, "element foo " + count + "\n" + replaced(vertex, "4", "1"));
      EXPECT_EQ(
          refusal(empty + (format == "ascii" ? "1 2 3" : body.substr(0, 12)), ".ply"),
          "");
      EXPECT_FALSE(refusal(header(format,
                                  vertex + "element foo " + count +
                                      "\nproperty list uchar int a\n") +
                               body,
                           ".ply")
                       .empty());
    }
    EXPECT_FALSE(
        refusal(
            header(format, vertexElement("float") + "property list double int a\n") +
                (format == "ascii" ? std::string("1 2 3 1e18 1")
                                   : "111122223333" + bytesOf(1e18)),
            ".ply")
            .empty());
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "file_bytes.h"

#include <gtest/gtest.h>

#include <pcl/io/lzf.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

const std::string HEADER = "# .PCD v0.7 - Point Cloud Data file format\n"
                           "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
                           "COUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
                           "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 2\n";
const std::string TEXT = HEADER + "DATA ascii\n1 2 3\n-4 5.5 6e-1\n";

void expectTwoPoints(const app::Shape& shape) {
  ASSERT_EQ(shape.points.size(), 2u);
  EXPECT_EQ(shape.points[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR((shape.points[1] - Eigen::Vector3d(-4, 5.5, 0.6)).norm(), 0.0, 1e-6);
}

/** \brief A binary point of a type, its numbers not aligned. */
template <typename T>
std::string typedPcd(const std::string& type) {
  const std::string size = std::to_string(sizeof(T));
  return "FIELDS pad x y z\nSIZE 1 " + size + " " + size + " " + size + "\nTYPE U " +
         type + " " + type + " " + type + "\nCOUNT 3 1 1 1\nWIDTH 1\nHEIGHT 1\nDATA " +
         "binary\nabc" + bytesOf(T(7)) + bytesOf(T(100)) + bytesOf(T(31));
}

} // namespace

TEST(PcdReader, ReadsEveryTypeOfNumbers) {
  for (const std::string& bytes : {typedPcd<float>("F"),
                                   typedPcd<double>("F"),
                                   typedPcd<std::int8_t>("I"),
                                   typedPcd<std::uint8_t>("U"),
                                   typedPcd<std::int16_t>("I"),
                                   typedPcd<std::uint16_t>("U"),
                                   typedPcd<std::int32_t>("I"),
                                   typedPcd<std::uint32_t>("U"),
                                   typedPcd<std::int64_t>("I"),
                                   typedPcd<std::uint64_t>("U")}) {
    const app::Shape shape = app::readShape(bytes, ".pcd");
    ASSERT_EQ(shape.points.size(), 1u);
    EXPECT_EQ(shape.points[0], Eigen::Vector3d(7, 100, 31)) << bytes;
  }
}

TEST(PcdReader, MorePointsThanTheHeaderPromisesAreRefused) {
  EXPECT_TRUE(tells(refusal(TEXT + "\n7 8 9\n", ".pcd"),
                    {"line 15", "more than the 2 points", "correct WIDTH"}));
  expectTwoPoints(app::readShape(TEXT + "\n \n# the end\n", ".pcd"));
  const std::string binary = HEADER + "DATA binary\n" + bytesOf(1.0f) + bytesOf(2.0f) +
                             bytesOf(3.0f) + bytesOf(-4.0f) + bytesOf(5.5f) +
                             bytesOf(0.6f);
  expectTwoPoints(app::readShape(binary + "\r\n ", ".pcd"));
  expectTwoPoints(app::readShape(binary + std::string(20, '\0'), ".pcd"));
  EXPECT_TRUE(
      tells(refusal(binary + bytesOf(7.0f) + bytesOf(8.0f) + bytesOf(9.0f), ".pcd"),
            {"more than the 2 points"}));
}

TEST(PcdReader, ReadsTextWhateverStandsAroundIt) {
  expectTwoPoints(app::readShape(TEXT, ".pcd"));
  expectTwoPoints(app::readShape("\xef\xbb\xbf" + TEXT, ".pcd"));
  expectTwoPoints(app::readShape("// made by foo\n" + TEXT, ".pcd"));
  expectTwoPoints(app::readShape("LABEL foo\n" + TEXT, ".pcd"));
  expectTwoPoints(app::readShape(replaced(TEXT, "HEIGHT", "# a comment\nHEIGHT"), ""));
  expectTwoPoints(app::readShape(replaced(TEXT, "-4", "# a comment\n\n -4"), ".pcd"));
  expectTwoPoints(app::readShape(replaced(TEXT, "\n", "\r\n"), ".pcd"));
  expectTwoPoints(app::readShape(replaced(TEXT, "\n", "\r"), ".pcd"));
  expectTwoPoints(app::readShape(replaced(TEXT, "x y z", "X Y Z"), ".pcd"));
  // the extension does not matter
  expectTwoPoints(app::readShape(TEXT, ".txt"));
}

TEST(PcdReader, ReadsOldVersionsWithoutAllLines) {
  expectTwoPoints(app::readShape("# .PCD v.5\nVERSION .5\nFIELDS x y z\nSIZE 4 4 4\n"
                                 "TYPE F F F\nPOINTS 2\nDATA ascii\n1 2 3\n-4 5.5 .6\n",
                                 ".pcd"));
  expectTwoPoints(app::readShape(
      "COLUMNS x y z\nPOINTS 2\nDATA ascii\n1 2 3\n-4 5.5 .6\n", ".pcd"));
}

TEST(PcdReader, ReadsBinaryAndCompressedBodies) {
  const std::string body = bytesOf(1.0f) + bytesOf(2.0f) + bytesOf(3.0f) +
                           bytesOf(-4.0f) + bytesOf(5.5f) + bytesOf(0.6f);
  expectTwoPoints(app::readShape(HEADER + "DATA binary\n" + body, ".pcd"));
  // all x, all y, all z; copied enough times that it can be packed
  const unsigned copies = 50;
  std::string columns;
  for (unsigned axis = 0; axis < 3; ++axis)
    for (unsigned i = 0; i < copies; ++i)
      columns += body.substr(4 * axis, 4) + body.substr(12 + 4 * axis, 4);
  std::string packed(2 * columns.size(), '\0');
  const unsigned size = pcl::lzfCompress(columns.data(),
                                         static_cast<unsigned>(columns.size()),
                                         packed.data(),
                                         static_cast<unsigned>(packed.size()));
  ASSERT_GT(size, 0u);
  const std::string bytes =
      replaced(replaced(HEADER, "WIDTH 2", "WIDTH 100"), "POINTS 2", "POINTS 100") +
      "DATA binary_compressed\n" + bytesOf(size) +
      bytesOf(static_cast<unsigned>(columns.size())) + packed.substr(0, size);
  app::Shape shape = app::readShape(bytes, ".pcd");
  ASSERT_EQ(shape.points.size(), 2u * copies);
  shape.points.resize(2);
  expectTwoPoints(shape);
}

TEST(PcdReader, ReadsColoursAsFloatsAndAsIntegers) {
  const std::string header = "FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH 1\n";
  std::uint32_t rgb = 0x102030;
  float single;
  std::memcpy(&single, &rgb, 4);
  const std::string point = bytesOf(1.0f) + bytesOf(2.0f) + bytesOf(3.0f);
  for (const std::string& bytes :
       {header + "DATA binary\n" + point + bytesOf(single),
        header + "DATA ascii\n1 2 3 1.480914638e-39\n",
        header + "DATA ascii\n1 2 3 1056816\n",
        replaced(header, "F F F F", "F F F U") + "DATA ascii\n1 2 3 4279246896\n"}) {
    const app::Shape shape = app::readShape(bytes, ".pcd");
    ASSERT_EQ(shape.colors.size(), 1u);
    EXPECT_EQ(shape.colors[0], rgb) << bytes;
  }
}

TEST(PcdReader, KeepsImageAndViewpoint) {
  const std::string text =
      replaced(replaced(replaced(TEXT, "WIDTH 2", "WIDTH 1"), "HEIGHT 1", "HEIGHT 2"),
               "VIEWPOINT 0 0 0 1 0 0 0",
               "VIEWPOINT 1 2 3 0 0 2 0");
  const app::Shape shape = app::readShape(text, ".pcd");
  EXPECT_EQ(shape.width, 1u);
  EXPECT_EQ(shape.height, 2u);
  EXPECT_EQ(shape.origin, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(std::abs(shape.orientation.y()), 1.0, 1e-12);
}

TEST(PcdReader, NamesTheLineOrTheFieldThatIsWrong) {
  const auto refused = [](const std::string& from, const std::string& to) {
    const std::string why = refusal(replaced(TEXT, from, to), ".pcd");
    EXPECT_FALSE(why.empty()) << from << " -> " << to;
    return why;
  };
  EXPECT_TRUE(tells(refused("5.5", "5,5"), {"line 13", "decimal commas"}));
  EXPECT_TRUE(
      tells(refused("5.5 6e-1", "5.500000"), {"line 13", "2 numbers instead of 3"}));
  EXPECT_TRUE(tells(refused("-4 5.5 6e-1\n", ""), {"2 points", "holds 1"}));
  EXPECT_TRUE(tells(refused("WIDTH 2", "WIDTH two"), {"line 7", "'two'"}));
  EXPECT_TRUE(tells(refused("x y z", "x y intensity"), {"no field 'z'"}));
  EXPECT_TRUE(tells(refused("SIZE 4 4 4", "SIZE 4 4 2"), {"'z'", "SIZE 2"}));
  EXPECT_TRUE(tells(refused("SIZE 4 4 4", "SIZE 4 4"), {"3 FIELDS", "2 of SIZE"}));
  EXPECT_TRUE(tells(refused("COUNT 1 1 1", "COUNT 1 1 3"), {"'z'", "3 numbers"}));
  EXPECT_TRUE(tells(refused("POINTS 2", "POINTS 3"), {"POINTS"}));
  EXPECT_TRUE(tells(refused("0 0 0 1 0 0 0", "0 0 0 0 0 0 0"), {"VIEWPOINT"}));
  EXPECT_TRUE(tells(refused("DATA ascii", "DATA morse"), {"line 11", "'morse'"}));
  EXPECT_TRUE(tells(refused("DATA", "DATUM"), {"DATA"}));
  EXPECT_TRUE(tells(refused("FIELDS", "FELDER"), {"FIELDS"}));
}

TEST(PcdReader, NeverBelievesAHeaderThatTheFileDoesNotBack) {
  for (const std::string kind : {"ascii", "binary", "binary_compressed"}) {
    std::string text = replaced(TEXT, "ascii", kind);
    text = replaced(replaced(text, "POINTS 2\n", ""), "HEIGHT 1", "HEIGHT 4294967295");
    EXPECT_FALSE(refusal(text, ".pcd").empty());
    EXPECT_FALSE(refusal(replaced(text, "COUNT 1 1 1", "COUNT 1 1 9e9"), "").empty());
  }
  // two billion bytes out of eight
  EXPECT_FALSE(refusal(replaced(replaced(HEADER, "WIDTH 2", "WIDTH 160000000"),
                                "POINTS 2",
                                "POINTS 160000000") +
                           "DATA binary_compressed\n" + bytesOf(8U) +
                           bytesOf(1920000000U) + "12345678",
                       ".pcd")
                   .empty());
}

TEST(PcdReader, MessagesHoldNoBytesThatATerminalWouldObey) {
  const std::string why =
      refusal(replaced(TEXT, "5.5", "\x1b[31m\xff" + std::string(500, 'a')), ".pcd");
  EXPECT_FALSE(why.empty());
  EXPECT_LT(why.size(), 200u);
  for (const char c : why)
    EXPECT_TRUE(c >= ' ' && c <= '~') << why;
}

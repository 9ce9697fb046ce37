// SPDX-License-Identifier: BSD-3-Clause
#include "file_bytes.h"
#include "input/lines.h"
#include "text.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief The points 1 2 3 and -4 5.5 0.6. */
void expectTwoPoints(const std::string& text) {
  SCOPED_TRACE(text);
  const app::Shape shape = app::readShape(text, ".txt");
  ASSERT_EQ(shape.points.size(), 2u);
  EXPECT_EQ(shape.points[0], Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(shape.points[1], Eigen::Vector3d(-4, 5.5, 0.6));
}

} // namespace

TEST(TextReader, TakesEverySeparatorAndEndOfLine) {
  for (const std::string separator : {" ", "\t", ",", ";", ", ", " ; ", "   "})
    for (const std::string end : {"\n", "\r\n", "\r", "\n\n", " \n", ";\n"})
      expectTwoPoints("1" + separator + "2" + separator + "3" + end + "-4" + separator +
                      "5.5" + separator + "+0.6" + end);
  expectTwoPoints("1 2 3\n-4 5.5 0.6"); // no end
  expectTwoPoints("\xef\xbb\xbf"
                  "1 2 3\n-4 5.5 0.6\n");
}

TEST(TextReader, UsesTheNamesOfColumns) {
  for (const std::string header : {"//X Y Z\n",
                                   "# x y z\n",
                                   "X Y Z\n",
                                   "% a comment\n",
                                   "//X;Y;Z\n2\n",
                                   "2\n",
                                   "x,y,z\n",
                                   "\"x\";\"y\";\"z\"\n",
                                   "X [m], Y [m], Z [m]\n",
                                   "Points:0,Points:1,Points:2\n",
                                   "pos_x pos_y pos_z\n",
                                   "# made with love\n",
                                   "# x and y and z\n"})
    expectTwoPoints(header + "1 2 3\n-4 5.5 0.6\n");
  expectTwoPoints("z,id,X,Y\n3,17,1,2\n0.6,18,-4,5.5\n");
  expectTwoPoints(",x,y,z\n0,1,2,3\n1,-4,5.5,0.6\n");
  expectTwoPoints("# nx ny nz x y z\n0 0 1 1 2 3\n0 0 1 -4 5.5 0.6\n");
  EXPECT_TRUE(
      tells(refusal("id,label,weight\n1,2,3\n", ".csv"), {"line 1", "x, y and z"}));
  EXPECT_TRUE(tells(refusal("x,y,z,w\n1,2,3\n", ".csv"), {"line 2", "3 values", "4"}));
}

TEST(TextReader, FindsColoursOfZeroTo255) {
  const auto colors = [](const std::string& text) {
    return app::readShape(text, ".txt").colors;
  };
  EXPECT_EQ(colors("1 2 3 16 32 48\n1 2 3 0 0 255\n"),
            (std::vector<std::uint32_t>{0x102030, 0xff}));
  EXPECT_EQ(colors("2\n1 2 3 -1204 16 32 48\n1 2 3 7 0 0 255\n"),
            (std::vector<std::uint32_t>{0x102030, 0xff}));
  EXPECT_EQ(colors("//X;Y;Z;Rf;Gf;Bf\n1;2;3;0;1;0.2\n"),
            (std::vector<std::uint32_t>{0x00ff33}));
  EXPECT_TRUE(colors("1 2 3 0 0 1\n1 2 3 0.6 0.8 0\n").empty()); // normals
  EXPECT_TRUE(colors("1 2 3 17\n").empty());
}

TEST(TextReader, KnowsEverySpellingOfNoNumber) {
  for (const std::string word : {"nan",
                                 "NaN",
                                 "-nan",
                                 "nan(ind)",
                                 "-nan(ind)",
                                 "1.#QNAN",
                                 "-1.#IND",
                                 "null",
                                 "NULL",
                                 "NA",
                                 "-1.#IND00",
                                 "inf",
                                 "-inf",
                                 "1e999",
                                 "Infinity"}) {
    const app::Shape shape = app::readShape("1 2 3\n" + word + " 0 0\n", ".xyz");
    ASSERT_EQ(shape.points.size(), 2u) << word;
    EXPECT_FALSE(std::isfinite(shape.points[1].x())) << word;
  }
  const app::Shape shape = app::readShape("1;2;3\n;;\n;;3\n", ".csv");
  ASSERT_EQ(shape.points.size(), 3u);
  EXPECT_TRUE(std::isnan(shape.points[1].z()));
}

TEST(TextReader, RefusesDecimalCommasByName) {
  for (const std::string text : {"-0,008425 -0,075821 0,649892\n",
                                 "1,5\t2,5\t3,5\n",
                                 "1,5;2,5;3,5\n",
                                 "1,5; 2,5; 3,5;\n",
                                 "x;y;z\n1,5;2,5;3,5\n",
                                 "x,y,z\n1,5,2,5,3,5\n",
                                 "0,5,0,25,0,65\n0,51,0,075,0,61\n",
                                 "1.234,5;2.345,6;1,0\n",
                                 "1 0 2\n1,5 2 3\n"})
    EXPECT_TRUE(tells(refusal(text, ".xyz"), {"line ", "decimal commas"})) << text;
  EXPECT_TRUE(tells(refusal("1 2 3\n1 2 3\n1,0 2,0 3,0\n", ""), {"line 3"}));
}

TEST(TextReader, DecimalCommasAreNamedInEveryFormatOfText) {
  const std::string pcd = "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 1\nDATA ascii\n";
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                          "property float y\nproperty float z\nend_header\n";
  for (const auto& [head, extension] :
       {std::pair<std::string, std::string>{pcd, ".pcd"},
        {ply, ".ply"},
        {"v ", ".obj"}}) {
    EXPECT_TRUE(tells(refusal(head + "-0,5 1,25e-3 0,7\n", extension),
                      {"line ", "decimal commas; write points"}));
    EXPECT_TRUE(
        tells(refusal(head + "1,2,3 4 5\n", extension), {"'1,2,3' is no number"}));
  }
}

TEST(TextReader, TheUnitThatAHeaderNamesIsTheFiles) {
  const auto unitOf = [](const std::string& head) {
    const app::Shape shape = app::readShape(head + "1.5 2.5 3.5\n4 5 6\n", ".csv");
    EXPECT_EQ(shape.points.size(), 2u) << head;
    EXPECT_EQ(shape.points[0], Eigen::Vector3d(1.5, 2.5, 3.5)) << head;
    return shape.unit;
  };
  for (const char* head : {"x [mm],y [mm],z [mm]\n",
                           "X(mm);Y(mm);Z(mm)\n",
                           "x_mm,y_mm,z_mm\n",
                           "pos_x_mm pos_y_mm pos_z_mm\n",
                           "# X [mm] Y [mm] Z [mm]\n",
                           "// X [millimeters]\tY [millimeters]\tZ [millimeters]\n",
                           "x in mm;y in mm;z in mm\n",
                           "x/mm;y/mm;z/mm\n",
                           "x,y,z\nmm,mm,mm\n",
                           "# Units: mm\n",
                           "# x y z [mm]\n"})
    EXPECT_EQ(unitOf(head), "mm") << head;
  EXPECT_EQ(unitOf("X [cm],Y [cm],Z [cm]\n"), "cm");
  EXPECT_EQ(unitOf("X (in);Y (in);Z (in)\n"), "in");
  EXPECT_EQ(unitOf("x_m y_m z_m\n"), "m");
  for (const char* head :
       {"x,y,z\n", "# a can of 66 mm\n", "x (map),y (map),z (map)\n", ""})
    EXPECT_EQ(unitOf(head), "") << head;
  EXPECT_TRUE(tells(refusal("x [ft],y [ft],z [ft]\n1 2 3\n", ".csv"),
                    {"line 1", "the unit ft", "convert"}));
  EXPECT_TRUE(
      tells(refusal("x_mm,y_mm,z_m\n1 2 3\n", ".csv"), {"two units, mm and m"}));
  EXPECT_TRUE(tells(refusal("# unit: m\nx_mm,y_mm,z_mm\n1 2 3\n", ".csv"),
                    {"line 2", "two units, m and mm"}));
}

TEST(TextReader, AColumnThatCountsTheLinesIsNoCoordinate) {
  const auto numbered = [](int first, const char* separator, const std::string& more) {
    std::string text;
    for (int i = 0; i < 20; ++i)
      text += std::to_string(i + first) + separator + std::to_string(0.5 * i) +
              separator + "2" + separator + "3" + more + "\n";
    return text;
  };
  for (const int first : {0, 1})
    for (const char* separator : {" ", ","}) {
      const app::Shape shape = app::readShape(numbered(first, separator, ""), ".txt");
      ASSERT_EQ(shape.points.size(), 20u);
      EXPECT_EQ(shape.points[4], Eigen::Vector3d(2, 2, 3));
      ASSERT_EQ(shape.notes.size(), 1u);
      EXPECT_TRUE(tells(shape.notes[0], {"first column counts the lines"}));
    }
  EXPECT_EQ(app::readShape(numbered(0, " ", " 255 0 1"), ".txt").colors.at(3),
            0xff0001u);
  // R names all columns but that one
  const app::Shape named = app::readShape("y z x\n" + numbered(1, " ", ""), ".txt");
  EXPECT_EQ(named.points[4], Eigen::Vector3d(3, 2, 2));
  // three columns, or other steps: x, y, z as ever
  const std::string other = replaced(numbered(0, " ", ""), "\n7 ", "\n7.5 ");
  for (const std::string& text : {other, numbered(2, " ", "")})
    EXPECT_TRUE(app::readShape(text, ".txt").notes.empty());
  EXPECT_EQ(app::readShape(other, ".txt").points[4], Eigen::Vector3d(4, 2, 2));
}

TEST(TextReader, NamesTheLineThatIsWrong) {
  EXPECT_TRUE(tells(refusal("1 2 3\n1 2 3abc\n", ".xyz"), {"line 2", "'3abc'"}));
  EXPECT_TRUE(tells(refusal("1 2 3\n\n4 5\n", ".xyz"), {"line 3", "three numbers"}));
  EXPECT_TRUE(tells(refusal("1 2 3\nfour five six\n", ".xyz"), {"line 2", "'four'"}));
  EXPECT_TRUE(tells(refusal("1 2 0x1f\n", ".xyz"), {"line 1", "'0x1f'"}));
  EXPECT_TRUE(tells(refusal("5\n1 2 3\n", ".pts"), {"5 points", "holds 1"}));
  EXPECT_TRUE(tells(refusal("2\n2\n0 0 0\n", ".ptx"), {"line 2", "PTX"}));
  EXPECT_TRUE(tells(refusal(std::string("\0\1\2\3", 4), ".xyz"), {"neither"}));
  EXPECT_TRUE(tells(refusal("\xff\xfe"
                            "1\0",
                            ".txt"),
                    {"UTF-16"}));
  EXPECT_TRUE(tells(refusal("LASF\1\2", ".las"), {"LAS"}));
  EXPECT_TRUE(tells(refusal("# vtk DataFile Version 3.0\n", ".vtk"), {"VTK", "PLY"}));
  EXPECT_TRUE(tells(refusal("<?xml version=\"1.0\"?>\n", ".vtp"), {"XML", "PLY"}));
  EXPECT_TRUE(tells(refusal("{\"asset\": {}}", ".gltf"), {"JSON", "PLY"}));
  EXPECT_TRUE(tells(refusal("\n{\"schema\": \"pcl_sq/model\"}", ".json"),
                    {"result of pcl_sq", "give the cloud"}));
  EXPECT_TRUE(tells(refusal("\x93NUMPY\1", ".npy"), {"NumPy", "pcl_sq.estimate"}));
  EXPECT_TRUE(tells(refusal("\x89MCAP0\r\n", ".mcap"), {"ROS 2 bag"}));
  EXPECT_TRUE(tells(refusal("", ".txt"), {"empty"}));
}

TEST(TextReader, TheLocaleDoesNotMatter) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "C"})
    if (std::setlocale(LC_ALL, locale))
      expectTwoPoints("1 2 3\n-4 5.5 0.6\n");
  std::setlocale(LC_ALL, before.c_str());
}

TEST(Lines, EndAsUnixWindowsAndOldMacsDo) {
  app::Lines lines("a\nb\r\nc\rd\n\n e");
  std::string_view line;
  std::vector<std::string> all;
  while (lines.next(line))
    all.emplace_back(line);
  EXPECT_EQ(all, (std::vector<std::string>{"a", "b", "c", "d", "", " e"}));
  EXPECT_EQ(lines.number(), 6u);
}

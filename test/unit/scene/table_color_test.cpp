// SPDX-License-Identifier: BSD-3-Clause
// The table's colour: what has it is no thing's foot.
#include "scene/table_color.h"

#include "view_scene.h"

#include <gtest/gtest.h>

#include <limits>

using namespace pcl_sq;
using namespace pcl_sq::detail;

namespace {

constexpr int WIDTH = 160, HEIGHT = 120;

/** \brief A table seen from straight above, in the middle of it pixels of a thing, and
 * half of the thing's foot at the table's height.
 * \param[in] blue how much of it the table's colour has at most, by chance
 * \return pixels of the thing after its foot was added */
int grown(int blue) {
  pcl_sq::test::Random random(5);
  Eigen::Matrix3Xf points(3, WIDTH * HEIGHT);
  ColorMatrix colors(3, WIDTH * HEIGHT);
  LabelImage labels(WIDTH, HEIGHT);
  CellMask above(WIDTH, HEIGHT);
  for (int y = 0; y < HEIGHT; ++y)
    for (int x = 0; x < WIDTH; ++x) {
      const int c = y * WIDTH + x;
      const bool thing = std::abs(x - 80) < 10 && std::abs(y - 60) < 10;
      const bool foot = std::abs(x - 80) < 10 && y >= 70 && y < 74;
      // depth that the sensor has spread over the table beside the thing
      const bool halo = !thing && std::abs(x - 80) < 13 && std::abs(y - 60) < 10;
      points.col(c) = Eigen::Vector3f(
          0.002F * float(x - 80), 0.002F * float(y - 60), thing || halo ? 0.95F : 1.0F);
      const int chance =
          int(double(blue) * (0.5 + 0.5 * std::sin(3.0 * random.normal())));
      if (thing || foot)
        colors.col(c) << 200, 30, 40;
      else
        colors.col(c) << 165, 245, std::uint8_t(chance);
      above.cells[std::size_t(c)] = thing || halo;
      labels.values[std::size_t(c)] = thing || halo;
    }
  PinholeCamera camera;
  camera.fx = camera.fy = 500.0;
  camera.cx = 79.5;
  camera.cy = 59.5;
  TableModel table;
  table.normal = -Eigen::Vector3d::UnitZ();
  table.offset = 1.0;
  table.sigma = 0.001;
  const CloudPoints seen(points);
  const SceneView view{seen, WIDTH, HEIGHT, colors, camera, table};
  const TableColor color(view, above);
  color.growFeet(labels);
  return int(std::count(labels.values.begin(), labels.values.end(), 1));
}

struct Pixel {
  float depth; ///< NaN: missing
  int red, green, blue;
  bool above; ///< the table, which is seen from 1 m
};

/** \brief Share of the pixels above the table that its halo leaves.
 * \param[in] paint the pixel in a column and a row */
template <typename Paint>
double withoutHalo(const Paint& paint) {
  Eigen::Matrix3Xf points(3, WIDTH * HEIGHT);
  ColorMatrix colors(3, WIDTH * HEIGHT);
  CellMask above(WIDTH, HEIGHT);
  for (int y = 0; y < HEIGHT; ++y)
    for (int x = 0; x < WIDTH; ++x) {
      const int c = y * WIDTH + x;
      const Pixel p = paint(x, y);
      points.col(c) =
          Eigen::Vector3f(0.002F * float(x - 80), 0.002F * float(y - 60), p.depth);
      colors.col(c) << std::uint8_t(p.red), std::uint8_t(p.green), std::uint8_t(p.blue);
      above.cells[std::size_t(c)] = p.above;
    }
  PinholeCamera camera;
  camera.fx = camera.fy = 500.0;
  TableModel table;
  table.normal = -Eigen::Vector3d::UnitZ();
  table.offset = 1.0;
  table.sigma = 0.001;
  const CloudPoints seen(points);
  const SceneView view{seen, WIDTH, HEIGHT, colors, camera, table};
  CellMask left = above;
  TableColor(view, above).removeHalo(left);
  return double(left.count()) / double(above.count());
}

} // namespace

TEST(TableColor, FeetAreTheThingsHoweverTheTablesColourScatters) {
  const int before = 25 * 19, foot = 19 * 4;
  for (const int blue : {0, 40, 80}) {
    EXPECT_GE(grown(blue), before + foot - 20) << blue;
    EXPECT_LE(grown(blue), before + foot + 30) << blue;
  }
}

TEST(TableColor, IsNotThatOfWhatThingsEnclose) {
  // a pan from above: its wall has nearly the table's colour, its floor lies on the
  // table
  const double left = withoutHalo([](int x, int y) {
    const double radius = std::hypot(x - 80, y - 60);
    const bool wall = radius < 50.0 && radius > 36.0;
    const bool above = wall && y != 60; // and is not seen in one line
    const float depth = wall ? 0.96F : 1.0F;
    return radius < 50.0 ? Pixel{depth, 150, 132, 150, above}
                         : Pixel{depth, 140, 140, 140, above};
  });
  EXPECT_GT(left, 0.9);
}

TEST(TableColor, PixelsThatASensorMissesWithinAThingAreNoBordersOfIt) {
  // a board of nearly the table's colour, every fifth pixel of which is missing
  const double left = withoutHalo([](int x, int y) {
    const bool board = std::abs(x - 80) < 50 && std::abs(y - 60) < 40;
    if (!board)
      return Pixel{1.0F, 140, 140, 140, false};
    const bool missing = x % 5 == 0 && y % 5 == 0;
    return Pixel{missing ? std::numeric_limits<float>::quiet_NaN() : 0.9F,
                 142,
                 140,
                 140,
                 !missing};
  });
  // the corners are farther from the middle than a halo is wide
  EXPECT_GT(left, 0.96);
}

// SPDX-License-Identifier: BSD-3-Clause
// The table is the plane that things stand on; the thing on it is whole.
#include "pcl_sq/tabletop_segmentation.h"

#include "table_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

struct Found {
  bool ok = false;
  TableModel table;
  std::vector<int> object;
  std::string why;
};

Found find(const Eigen::Matrix3Xf& points,
           int width,
           int height,
           const TabletopOptions& options = {}) {
  Found found;
  found.ok = findTabletopObject(
      points, width, height, {}, options, found.table, found.object, &found.why);
  return found;
}

Found findInRoom(const TableScene& scene, const TabletopOptions& options = {}) {
  return find(scene.inRoom(), scene.width, scene.height, options);
}

Found findInListOf(const TableScene& scene, const TabletopOptions& options = {}) {
  const Eigen::Matrix3Xf list = TableScene::listOf(scene.inRoom());
  return find(list, int(list.cols()), 1, options);
}

/** \brief The table is z = 0 and the object within a box about the can at the origin.
 */
void expectCan(const Found& found, const Eigen::Matrix3Xf& points) {
  ASSERT_TRUE(found.ok) << found.why;
  EXPECT_GT(found.table.normal.z(), 0.999);
  EXPECT_NEAR(found.table.height({0, 0, 0}), 0.0, 0.002);
  for (const int c : found.object) {
    ASSERT_LT(points.col(c).head<2>().norm(), 0.045f);
    EXPECT_LT(points(2, c), 0.13f);
  }
}

} // namespace

TEST(TableFinder, AWallLargerThanTheTableIsNoTable) {
  TableScene scene(220.0, {0.0, -0.8, 0.4}, {0.0, 0.0, 0.05});
  scene.half_table = {0.2, 0.15};
  scene.wall = 0.4;
  scene.can();
  expectCan(findInRoom(scene), scene.inRoom());
  const Found list = findInListOf(scene);
  expectCan(list, TableScene::listOf(scene.inRoom()));
}

TEST(TableFinder, ATableOnAFloorIsTheTable) {
  TableScene scene(220.0, {0.0, -0.9, 0.7}, {0.0, 0.0, 0.0});
  scene.half_table = {0.3, 0.2}; // all of it in view
  scene.floor = 0.5;
  scene.can();
  expectCan(findInRoom(scene), scene.inRoom());
}

TEST(TableFinder, ThinThingsStandOutByTheNoise) {
  TableScene scene;
  scene.stand({0, 0}, {0.012, 0.09, 0.004}, 0.1, 0.1, 0.6);
  const Found found = findInRoom(scene);
  ASSERT_TRUE(found.ok) << found.why;
  const Eigen::Matrix3Xf points = scene.inRoom();
  float longest = 0.0f;
  for (const int c : found.object)
    longest = std::max(longest, points.col(c).head<2>().norm());
  EXPECT_NEAR(longest, 0.09f, 0.012f);
}

TEST(TableFinder, AThingThatTheImageBorderCutsIsFoundWhereThereIsNoOther) {
  TableScene scene(300.0, {0.15, -0.55, 0.42}, {0.15, 0.0, 0.05});
  scene.can(); // at the left border
  const Eigen::Matrix3Xf points = scene.inRoom();
  expectCan(findInRoom(scene), points);
  scene.can({0.2, 0.0}); // a whole one wins
  const Found found = findInRoom(scene);
  ASSERT_TRUE(found.ok);
  EXPECT_GT(scene.inRoom()(0, found.object[0]), 0.1f);
}

TEST(TableFinder, UpTellsWhichPlaneIsTheTable) {
  TableScene scene;
  scene.can();
  TabletopOptions options;
  options.up = Eigen::Vector3d(0, 0, 2.0);
  expectCan(findInRoom(scene, options), scene.inRoom());
  expectCan(findInListOf(scene, options), TableScene::listOf(scene.inRoom()));
  options.up = Eigen::Vector3d(0, 0, -1); // nothing hangs from it
  EXPECT_FALSE(findInListOf(scene, options).ok);
}

TEST(TableFinder, AKnownTableIsTaken) {
  TableScene scene;
  scene.half_table = {0.06, 0.06}; // too small to be found
  scene.wall = 0.5;
  scene.can();
  TabletopOptions options;
  options.table = TableModel();
  const Found found = findInRoom(scene, options);
  expectCan(found, scene.inRoom());
}

TEST(TableFinder, AListInARobotsFrameNeedsNoViewpoint) {
  // the origin lies below the table, where no camera is
  TableScene scene;
  scene.can();
  Eigen::Matrix3Xf list = TableScene::listOf(scene.inRoom());
  list.colwise() += Eigen::Vector3f(0.8f, 0.0f, 0.75f);
  Found found = find(list, int(list.cols()), 1);
  ASSERT_TRUE(found.ok) << found.why;
  EXPECT_GT(found.table.normal.z(), 0.999);
  EXPECT_NEAR(found.table.offset, -0.75, 0.002);
}

TEST(TableFinder, InterleavedListsAreSampledEvenly) {
  // every second point is of the wall: a stride would see nothing else
  TableScene scene(220.0, {0.0, -0.8, 0.4}, {0.0, 0.0, 0.05});
  scene.half_table = {0.2, 0.15};
  scene.wall = 0.4;
  scene.can();
  const Eigen::Matrix3Xf points = scene.inRoom();
  std::vector<int> wall, rest;
  for (int c = 0; c < points.cols(); ++c)
    if (points.col(c).allFinite())
      (points(1, c) > 0.3f ? wall : rest).push_back(c);
  std::vector<int> order;
  for (std::size_t i = 0; i < std::max(wall.size(), rest.size()); ++i) {
    order.push_back(wall[i % wall.size()]);
    order.push_back(rest[i % rest.size()]);
  }
  Eigen::Matrix3Xf list(3, Eigen::Index(order.size()));
  for (std::size_t i = 0; i < order.size(); ++i)
    list.col(Eigen::Index(i)) = points.col(order[i]);
  expectCan(find(list, int(list.cols()), 1), list);
}

TEST(TableFinder, TheSameThingInAnyFrame) {
  TableScene scene;
  scene.can();
  const Found here = find(scene.inCamera(), scene.width, scene.height);
  ASSERT_TRUE(here.ok);
  const Found room = findInRoom(scene);
  ASSERT_TRUE(room.ok);
  // rounding may move single pixels across a threshold
  std::vector<int> both;
  std::set_intersection(here.object.begin(),
                        here.object.end(),
                        room.object.begin(),
                        room.object.end(),
                        std::back_inserter(both));
  EXPECT_GT(both.size(), 0.99 * double(here.object.size()));
  EXPECT_GT(both.size(), 0.99 * double(room.object.size()));
}

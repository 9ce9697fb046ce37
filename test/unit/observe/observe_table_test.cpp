// SPDX-License-Identifier: BSD-3-Clause
// The table under a thing, in images of which it fills but a part.
#include "pcl_sq/object_view.h"

#include "view_scene.h"

#include <gtest/gtest.h>

#include <functional>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief Replaces the table by another plane where its points are asked to go. */
void replaceTable(ViewScene& scene,
                  const TableModel& other,
                  double noise,
                  const std::function<bool(const Eigen::Vector3d&)>& goes) {
  Random random(5);
  for (int c = 0; c < scene.width * scene.height; ++c) {
    const Eigen::Vector3d p = scene.points.col(c).cast<double>();
    if (scene.mask.cells[std::size_t(c)] || !goes(p))
      continue;
    const Eigen::Vector3d ray = p.normalized();
    const double t = -other.offset / other.normal.dot(ray) + random.normal(noise);
    scene.points.col(c) = (t * ray).cast<float>();
  }
}

std::optional<TableModel> tableOf(const ViewScene& scene) {
  ViewOptions view;
  view.mask = scene.mask;
  ObservedObject observed;
  std::string why;
  EXPECT_TRUE(
      observeObject(scene.points, scene.width, scene.height, {}, view, observed, &why))
      << why;
  return observed.table;
}

} // namespace

TEST(ObserveTable, AThingAtATablesEdgeStandsOnIt) {
  ViewScene scene = canScene(0.001);
  TableModel floor = scene.table;
  floor.offset += 0.7;
  // the edge is two centimetres beside the can, whose middle is at x = 0
  replaceTable(
      scene, floor, 0.001, [](const Eigen::Vector3d& p) { return p.x() > 0.06; });
  const std::optional<TableModel> table = tableOf(scene);
  ASSERT_TRUE(table);
  EXPECT_GT(table->normal.dot(scene.table.normal), std::cos(0.01));
  EXPECT_NEAR(table->offset, scene.table.offset, 0.002);
}

TEST(ObserveTable, AThingBesideTheTableDoesNotStandOnIt) {
  ViewScene scene = canScene(0.001);
  TableModel floor = scene.table;
  floor.offset += 0.7;
  replaceTable(
      scene, floor, 0.001, [](const Eigen::Vector3d& p) { return p.x() < 0.08; });
  EXPECT_FALSE(tableOf(scene));
}

TEST(ObserveTable, AStepBesideTheThingDoesNotTiltItsTable) {
  ViewScene scene = canScene(0.001);
  TableModel step = scene.table;
  step.offset -= 0.006; // within the distance of a plane's points
  replaceTable(
      scene, step, 0.001, [](const Eigen::Vector3d& p) { return p.x() < -0.09; });
  const std::optional<TableModel> table = tableOf(scene);
  ASSERT_TRUE(table);
  EXPECT_GT(table->normal.dot(scene.table.normal), std::cos(0.01));
  EXPECT_NEAR(table->offset, scene.table.offset, 0.0015);
}

TEST(ObserveTable, APlaneThatLeansSidewaysIsAWall) {
  ViewScene scene = canScene(0.001);
  TableModel wall;
  // through the can's foot, and facing the camera more than the ceiling
  wall.normal = Eigen::Vector3d(0.8, -0.35, -0.49).normalized();
  wall.offset = -wall.normal.z();
  replaceTable(scene, wall, 0.001, [](const Eigen::Vector3d&) { return true; });
  EXPECT_FALSE(tableOf(scene));
}

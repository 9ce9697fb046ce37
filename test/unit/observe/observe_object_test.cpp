// SPDX-License-Identifier: BSD-3-Clause
// What is read out of an image of an object: outline, camera, table, notes.
#include "pcl_sq/object_view.h"

#include "view_scene.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

bool observe(const ViewScene& scene,
             const ViewOptions& view,
             ObservedObject& observed,
             std::string* why = nullptr) {
  return observeObject(
      scene.points, scene.width, scene.height, {}, view, observed, why);
}

} // namespace

TEST(ObserveObject, FindsIntrinsicsTableAndOutlineByItself) {
  const ViewScene scene = canScene();
  ViewOptions view;
  view.mask = scene.mask;
  ObservedObject observed;
  std::string why;
  ASSERT_TRUE(observe(scene, view, observed, &why)) << why;
  EXPECT_EQ(observed.outline, OutlineSource::MASK);
  EXPECT_NEAR(observed.camera.fx, scene.camera.fx, 0.1);
  EXPECT_NEAR(observed.camera.cy, scene.camera.cy, 0.1);
  ASSERT_TRUE(observed.table);
  EXPECT_GT(observed.table->normal.dot(scene.table.normal), 0.9999);
  EXPECT_NEAR(observed.table->offset, scene.table.offset, 0.001);
}

TEST(ObserveObject, AViewpointBesideTheImagesOwnIsTold) {
  const ViewScene scene = canScene();
  ViewOptions view;
  view.mask = scene.mask;
  ObservedObject observed;
  view.viewpoint = scene.camera.center;
  ASSERT_TRUE(observe(scene, view, observed));
  EXPECT_EQ(observed.notes, std::vector<std::string>{});
  view.viewpoint = scene.camera.center + Eigen::Vector3d(1.0, 1.0, 1.0);
  ASSERT_TRUE(observe(scene, view, observed));
  ASSERT_EQ(observed.notes.size(), 1u);
  EXPECT_NE(observed.notes[0].find("not the viewpoint that was given"),
            std::string::npos);
  EXPECT_NEAR((observed.camera.center - scene.camera.center).norm(), 0.0, 1e-3);
}

TEST(ObserveObject, ObjectOnATableNeedsNoMask) {
  const ViewScene scene = canScene();
  ObservedObject observed;
  std::string why;
  ASSERT_TRUE(observe(scene, {}, observed, &why)) << why;
  EXPECT_EQ(observed.outline, OutlineSource::DEPTH);
  int wrong = 0;
  for (std::size_t i = 0; i < scene.mask.cells.size(); ++i)
    wrong += observed.pixels.cells[i] && !scene.mask.cells[i];
  EXPECT_LT(wrong, scene.mask.count() / 20);
  EXPECT_GT(observed.pixels.count(), scene.mask.count() * 3 / 4);
}

TEST(ObserveObject, APixelBesideCostsItsSizeTimesTheSineOfTheSlant) {
  ViewScene scene;
  scene.addUpright({0.06, 0.06, 0.06}, 1.0, 1.0, 0.06);
  scene.render(0.0);
  ViewOptions view;
  view.mask = scene.mask;
  ObservedObject observed;
  ASSERT_TRUE(observe(scene, view, observed));
  ASSERT_EQ(observed.sideways.size(), observed.points.cols());
  const Superquadric& ball = scene.object.parts[0];
  int compared = 0;
  for (Eigen::Index i = 0; i < observed.points.cols(); ++i) {
    const Eigen::Vector3d p = observed.points.col(i);
    const Eigen::Vector3d ray = (p - observed.camera.center).normalized();
    const double cosine = -(p - ball.center).normalized().dot(ray);
    if (cosine < 0.6) // nearer to the outline half of the window is empty
      continue;
    const double pixel = observed.camera.depthOf(p) / observed.camera.fx;
    EXPECT_NEAR(
        observed.sideways[i], pixel * std::sqrt(1 - cosine * cosine), 0.15 * pixel);
    ++compared;
  }
  EXPECT_GT(compared, 300);
}

TEST(ObserveObject, MaskOfAnotherSizeIsRefused) {
  const ViewScene scene = canScene();
  ViewOptions view;
  view.mask = CellMask(80, 60);
  view.mask.set(40, 30);
  ObservedObject observed;
  std::string why;
  EXPECT_FALSE(observe(scene, view, observed, &why));
  EXPECT_NE(why.find("80 x 60"), std::string::npos) << why;
}

TEST(ObserveObject, NoiseOfAnotherNumberOfPointsIsRefused) {
  const ViewScene scene = canScene();
  ViewOptions view;
  view.noise = Eigen::VectorXf::Constant(scene.points.cols() - 1, 1e-3F);
  ObservedObject observed;
  std::string why;
  EXPECT_FALSE(observe(scene, view, observed, &why));
  EXPECT_NE(why.find("one number for each point"), std::string::npos) << why;
  view.noise = Eigen::VectorXf::Constant(scene.points.cols(), 1e-3F);
  EXPECT_TRUE(observe(scene, view, observed, &why)) << why;
}

TEST(ObserveObject, EmptyMaskAndMaskBesideTheObjectAreRefused) {
  ViewScene scene = canScene();
  ViewOptions view;
  view.mask = CellMask(scene.width, scene.height);
  ObservedObject observed;
  std::string why;
  EXPECT_FALSE(observe(scene, view, observed, &why));
  EXPECT_NE(why.find("mask is empty"), std::string::npos) << why;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      view.mask.set(x, y);
      scene.points.col(y * scene.width + x).setConstant(std::nanf(""));
    }
  EXPECT_FALSE(observe(scene, view, observed, &why));
  EXPECT_NE(why.find("under the mask"), std::string::npos) << why;
}

TEST(ObserveObject, TableOnTheWrongSideIsLeftOutWithANote) {
  const ViewScene scene = canScene();
  ViewOptions view;
  view.mask = scene.mask;
  view.table = scene.table;
  view.table->offset -= 0.4; // in front of the object
  ObservedObject observed;
  ASSERT_TRUE(observe(scene, view, observed));
  EXPECT_FALSE(observed.table);
  ASSERT_FALSE(observed.notes.empty());
  EXPECT_NE(observed.notes.back().find("below the table"), std::string::npos);
  view.table->offset = scene.table.offset + 0.5; // far behind it
  ASSERT_TRUE(observe(scene, view, observed));
  EXPECT_FALSE(observed.table);
  EXPECT_NE(observed.notes.back().find("does not stand"), std::string::npos);
}

TEST(ObserveObject, ArcBehindAnOccluderIsNotTheObjectsOwn) {
  ViewScene scene = canScene(0.0);
  ViewOptions view;
  view.mask = scene.mask;
  view.camera = scene.camera;
  const int middle = 80;
  for (int y = 0; y < scene.height; ++y) // something near hides the right half
    for (int x = middle; x < scene.width; ++x) {
      view.mask.set(x, y, false);
      scene.points.col(y * scene.width + x) =
          (0.5 * scene.camera.ray({double(x), double(y)})).cast<float>();
    }
  ObservedObject observed;
  ASSERT_TRUE(observe(scene, view, observed));
  for (const ContourPoint& p : observed.contour) {
    if (p.pixel.x() >= middle - 1) {
      EXPECT_FALSE(p.own) << p.pixel.transpose();
    }
    if (p.pixel.x() < middle - 8) { // nearer, caution may leave it out
      EXPECT_TRUE(p.own) << p.pixel.transpose();
    }
  }
  for (const SilhouetteLine& line : silhouetteLines(observed.contour, 48))
    EXPECT_LT(line.direction.x(), 0.3);
}

TEST(ObserveObject, ARegionMeansTheThingWhoseBoxItIs) {
  const ViewScene alone = canScene();
  for (const double depth : {-0.2, 0.15}) { // before the can and behind it
    ViewScene scene = alone;
    Superquadric neighbour = scene.object.parts[0];
    neighbour.center += Eigen::Vector3d(0.06, 0.0, 0.0);
    const Eigen::Vector3d away(0.0, 0.0, depth);
    neighbour.center += away - away.dot(scene.table.normal) * scene.table.normal;
    scene.object.parts.push_back(neighbour);
    scene.render(0.001);
    const CellRect box = boundingRect(alone.mask);
    std::vector<int> region;
    CellMask visible(scene.width, scene.height);
    for (int y = box.y - 4; y < box.y + box.height + 4; ++y)
      for (int x = box.x - 4; x < box.x + box.width + 4; ++x) {
        const int c = y * scene.width + x;
        region.push_back(c);
        const double change = scene.points(2, c) - alone.points(2, c);
        visible.set(x, y, alone.mask(x, y) && std::abs(change) < 0.01);
      }
    ASSERT_LT(visible.count(), int(region.size()) * 7 / 10);
    ViewOptions view;
    view.object_is_region = true;
    ObservedObject observed;
    std::string why;
    ASSERT_TRUE(observeObject(
        scene.points, scene.width, scene.height, region, view, observed, &why))
        << why;
    int wrong = 0, missed = 0;
    for (std::size_t i = 0; i < visible.cells.size(); ++i) {
      wrong += observed.pixels.cells[i] && !visible.cells[i];
      missed += !observed.pixels.cells[i] && visible.cells[i];
    }
    EXPECT_LT(wrong, visible.count() / 20) << depth;
    EXPECT_LT(missed, visible.count() / 5) << depth;
    ASSERT_FALSE(observed.notes.empty());
    EXPECT_NE(observed.notes[0].find("another thing"), std::string::npos);
  }
}

TEST(ObserveObject, SettingsOutOfRangeAreRefusedWithASentence) {
  ViewOptions view;
  EXPECT_TRUE(view.isValid());
  std::string why;
  view.mask_sigma = 0.0;
  EXPECT_FALSE(view.isValid(&why));
  EXPECT_FALSE(why.empty());
  view = {};
  view.mask_correlation = 0.5;
  EXPECT_FALSE(view.isValid(&why));
  view = {};
  view.table = TableModel{{Eigen::Vector3d(0, 0, 2), 0.0}};
  EXPECT_FALSE(view.isValid(&why));
  view = {};
  view.camera = PinholeCamera();
  EXPECT_FALSE(view.isValid(&why));
}

TEST(FindIntrinsics, RefusesAnImageThatIsNoPinholeImage) {
  Random random(9);
  Eigen::Matrix3Xf points(3, 400);
  for (int i = 0; i < 400; ++i)
    points.col(i) = Eigen::Vector3f(
        float(random.normal()), float(random.normal()), float(random.uniform(1, 2)));
  PinholeCamera camera;
  EXPECT_FALSE(findIntrinsics(points, 20, 20, camera));
}

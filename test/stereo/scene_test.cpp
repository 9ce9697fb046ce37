// SPDX-License-Identifier: BSD-3-Clause
// The renderer and the evaluation, against geometry that is known otherwise.
#include "folder.h"
#include "random_superquadric.h"
#include "scene/evaluation.h"
#include "scene/mesh_reader.h"
#include "scene/noise.h"
#include "scene/truth.h"
#include "stereo_scene.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <set>

using namespace pcl_sq;
using namespace pcl_sq::test;

TEST(MeshBvh, AgreesWithTheSuperquadricItWasMadeFrom) {
  Random random(5);
  Superquadric s = random.superquadric();
  s.epsilon1 = 0.7;
  s.epsilon2 = 1.2;
  const app::MeshBvh mesh(meshSuperquadric(s, 64));
  const double step = 0.02 * s.semi_axes.maxCoeff();
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d p = random.pointNear(s);
    const double d = s.euclideanDistance(p);
    EXPECT_NEAR(mesh.distance(p), std::abs(d), step);
    if (std::abs(d) > step) {
      EXPECT_EQ(mesh.contains(p), d < 0.0);
    }
  }
}

TEST(MeshBvh, RaysHitWhereBruteForceDoes) {
  const app::SceneObject cup = app::makeObject("cup");
  const app::MeshBvh mesh(cup.mesh);
  Random random(9);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d from = 0.3 * random.direction();
    const Eigen::Vector3d to = 0.04 * random.direction();
    const app::RayHit hit = mesh.intersect(from, to - from);
    EXPECT_EQ(hit.found(), mesh.occluded(from, to - from));
    if (hit.found()) {
      EXPECT_NEAR(mesh.distance(from + hit.t * (to - from)), 0.0, 1e-9);
    }
  }
  EXPECT_FALSE(app::MeshBvh(TriangleMesh()).intersect({0, 0, 0}, {0, 0, 1}).found());
}

class SceneObjects : public ::testing::TestWithParam<std::string> {};

TEST_P(SceneObjects, AreClosedAndStandOnTheTable) {
  const app::SceneObject object = app::makeObject(GetParam());
  // closed: every directed edge has its opposite
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : object.mesh.triangles)
    for (int k = 0; k < 3; ++k)
      EXPECT_TRUE(edges.insert({t[k], t[(k + 1) % 3]}).second);
  for (const auto& [a, b] : edges)
    ASSERT_TRUE(edges.count({b, a})) << GetParam();
  EXPECT_LT(object.box().center().norm(), 1e-6);
  const app::Scene scene = app::placeOnTable(object.box(), {0.1, 0.0, 1.0}, 0.4, 0.2);
  double lowest = 1.0;
  for (const Eigen::Vector3d& v : object.mesh.vertices)
    lowest = std::min(lowest,
                      scene.table_normal.dot(scene.rotation * v + scene.translation) +
                          scene.table_offset);
  EXPECT_NEAR(lowest, 0.0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All,
                         SceneObjects,
                         ::testing::ValuesIn(app::objectNames()),
                         [](const auto& test) { return test.param; });

TEST(SceneRenderer, TheBottleIsThatOfTableOne) {
  const Eigen::Vector3d size = app::makeObject("bottle").box().sizes();
  EXPECT_NEAR(size.x(), 0.053, 1e-9);
  EXPECT_NEAR(size.z(), 0.350, 1e-9);
}

TEST(SceneRenderer, DepthLiesOnTheObjectAndThePlanes) {
  const StereoScene s = renderScene("tomato");
  const Superquadric& local = s.object.superquadrics.parts.front();
  int on_object = 0;
  for (int v = 0; v < s.mask.rows; v += 3)
    for (int u = 0; u < s.mask.cols; u += 3) {
      const double z = s.intrinsics.depth(double(s.disparity.at<float>(v, u)));
      const Eigen::Vector3d p = s.intrinsics.backProject(u, v, z);
      if (s.mask.at<std::uint8_t>(v, u) != 0) {
        const Eigen::Vector3d q =
            s.scene.rotation.transpose() * (p - s.scene.translation);
        EXPECT_NEAR(local.euclideanDistance(q), 0.0, 5e-5);
        ++on_object;
      } else
        EXPECT_GT(s.scene.table_normal.dot(p) + s.scene.table_offset, -1e-4);
    }
  EXPECT_GT(on_object, 50);
}

TEST(SceneRenderer, SameBytesForAnyNumberOfThreadsAndOtherSeedsDiffer) {
  const app::SceneObject can = app::makeObject("can");
  app::Scene scene = app::placeOnTable(can.box(), {0, 0, 0.8}, 0.0, 0.2);
  const app::MeshBvh mesh(can.mesh);
  const app::SceneCamera camera = app::makeRig(96, 64, 100.0, 0.12).left;
  const auto one = app::render(scene, mesh, camera, 0, 1);
  EXPECT_EQ(one.bgr, app::render(scene, mesh, camera, 0, 3).bgr);
  EXPECT_NE(one.bgr, app::render(scene, mesh, camera, 1, 1).bgr);
  scene.seed = 2;
  EXPECT_NE(one.bgr, app::render(scene, mesh, camera, 0, 1).bgr);
}

TEST(SceneCamera, RaysAndProjectionAreInverse) {
  const app::StereoRig rig = app::distorted(app::makeRig(640, 480, 811.6, 0.12));
  for (const app::SceneCamera* camera : {&rig.left, &rig.right})
    for (int v = 0; v < 480; v += 60)
      for (int u = 0; u < 640; u += 60) {
        const Eigen::Vector3d p = camera->position + 1.3 * camera->ray(u, v);
        EXPECT_LT((camera->project(p) - Eigen::Vector2d(u, v)).norm(), 1e-6);
      }
}

TEST(Evaluation, AModelIsPerfectAgainstItself) {
  const app::SceneObject box = app::makeObject("box");
  app::ReferenceShape shape;
  shape.mesh = box.mesh;
  shape.symmetry = app::Symmetry::BOX;
  const app::ShapeFigures f =
      app::evaluateShape(MultiSuperquadric(box.superquadrics), shape, 20000);
  EXPECT_GT(f.iou, 0.995);
  EXPECT_LT(f.chamfer(), 5e-5);
  EXPECT_LT((f.model_size - f.true_size).norm(), 1e-4);
  EXPECT_LT(f.center_error.norm(), 1e-6);
  EXPECT_LT(f.axis_error_deg, 1e-4);
  EXPECT_NEAR(
      f.model_volume, box.superquadrics.parts[0].volume(), 0.02 * f.true_volume);
}

TEST(Evaluation, FiguresOfAKnownDifference) {
  const app::SceneObject can = app::makeObject("can");
  app::ReferenceShape shape;
  shape.mesh = can.mesh;
  shape.symmetry = can.symmetry;
  MultiSuperquadric model = can.superquadrics;
  model.parts[0].semi_axes[0] *= 1.1; // 6.6 mm wider, volume 1.1 times
  model.parts[0].center.z() += 0.002;
  const app::ShapeFigures f =
      app::evaluateShape(MultiSuperquadric(model), shape, 60000);
  EXPECT_NEAR(f.model_size.x() - f.true_size.x(), 0.0066, 1e-5);
  EXPECT_NEAR(f.center_error.z(), 0.002, 1e-6);
  EXPECT_NEAR(f.iou, (1 - 2 / 115.0) / (1.1 + 2 / 115.0), 0.01);
  EXPECT_LT(f.axis_error_deg, 1e-4); // a turn about the axis is no error
}

TEST(Evaluation, HollowThingsAreJudgedFilledUpAndByTheirWalls) {
  Superquadric bowl;
  bowl.semi_axes = {0.07, 0.07, 0.05};
  bowl.rim = 0.2;
  bowl.wall = 0.005;
  app::ReferenceShape shape;
  shape.mesh = meshSuperquadric(bowl);
  shape.symmetry = app::Symmetry::REVOLUTION;
  MultiSuperquadric model;
  model.parts = {bowl};
  const app::ShapeFigures same = app::evaluateShape(model, shape, 40000);
  EXPECT_GT(same.iou, 0.98);
  EXPECT_GT(same.iou_material, 0.93);
  model.parts[0].wall = 0.0; // the same outside, solid
  const app::ShapeFigures solid = app::evaluateShape(model, shape, 40000);
  EXPECT_GT(solid.iou, 0.98);
  EXPECT_NEAR(solid.iou_material, solid.true_volume / solid.model_volume, 0.01);
  EXPECT_LT(solid.iou_material, 0.4);
}

TEST(Evaluation, AxisErrorsAreModuloTheSymmetry) {
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  const auto turned = [](double degrees, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(degrees * M_PI / 180.0, axis).toRotationMatrix();
  };
  const Eigen::Matrix3d about_z = turned(30, Eigen::Vector3d::UnitZ());
  EXPECT_NEAR(app::axisError(about_z, one, app::Symmetry::REVOLUTION), 0.0, 1e-5);
  EXPECT_NEAR(app::axisError(about_z, one, app::Symmetry::BOX), 30.0, 1e-5);
  EXPECT_NEAR(app::axisError(about_z, one, app::Symmetry::SPHERE), 0.0, 1e-5);
  const Eigen::Matrix3d quarter = turned(95, Eigen::Vector3d::UnitX());
  EXPECT_NEAR(app::axisError(quarter, one, app::Symmetry::BOX), 5.0, 1e-5);
  EXPECT_NEAR(app::axisError(quarter, one, app::Symmetry::REVOLUTION), 5.0, 1e-5);
}

TEST(MeshReader, ReadsBackWhatWasWritten) {
  const Folder folder;
  const TriangleMesh cup = app::makeObject("cup").mesh;
  app::writePly(folder / "cup.ply", cup);
  const TriangleMesh back = app::readMesh(folder / "cup.ply");
  EXPECT_EQ(back.triangles, cup.triangles);
  for (std::size_t i = 0; i < cup.vertices.size(); ++i)
    ASSERT_EQ(back.vertices[i], cup.vertices[i]);
}

TEST(MeshReader, TellsOfTheEdgesOfHoles) {
  TriangleMesh mesh = app::makeObject("cup").mesh;
  EXPECT_EQ(app::openEdges(mesh), 0u);
  mesh.triangles.pop_back();
  EXPECT_EQ(app::openEdges(mesh), 3u);
}

TEST(MeshReader, RefusesWhatIsNoMesh) {
  const Folder folder;
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>{"a.obj", "v 0 0 0\nf 1 2 3\n"},
        {"b.obj", ""},
        {"c.stl", "solid x\nendsolid\n"},
        {"d.ply",
         "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nend_header\n"},
        {"e.txt", "hello"},
        {"f.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}})
    EXPECT_ANY_THROW((void)app::readMesh(folder.write(name, text))) << name;
}

TEST(SceneTruth, ReadsBackWhatWasWritten) {
  const Folder folder;
  app::SceneTruth t;
  t.scene = "can";
  t.seed = 7;
  t.width = 640;
  t.height = 480;
  t.focal_length = 811.6;
  t.size = {0.066, 0.067, 0.115};
  t.symmetry = app::Symmetry::REVOLUTION;
  t.mesh = "mesh.ply";
  t.parts = app::makeObject("can").superquadrics;
  t.roi = {1, 2, 3, 4};
  t.visible_pixels = 12;
  const app::SceneTruth u = app::readTruth(folder.write("truth.json", app::toJson(t)));
  EXPECT_EQ(u.scene, t.scene);
  EXPECT_EQ(u.size, t.size);
  EXPECT_EQ(u.symmetry, t.symmetry);
  EXPECT_TRUE(u.roi == t.roi);
  ASSERT_EQ(u.parts.size(), 1u);
  EXPECT_EQ(u.parts.parts[0].semi_axes, t.parts.parts[0].semi_axes);
  EXPECT_ANY_THROW((void)app::readTruth(folder.write("x.json", "{}")));
  EXPECT_ANY_THROW((void)app::readTruth(folder.write("y.json", "not json")));
}

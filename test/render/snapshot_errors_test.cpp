// SPDX-License-Identifier: BSD-3-Clause
// Files, names and bad input.
#include "pcl_sq/exception.h"
#include "pcl_sq/visualization/snapshot_renderer.h"

#include "folder.h"

#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cmath>
#include <fstream>

using namespace pcl_sq;

namespace {

SnapshotRenderer ballRenderer(int width = 64, int height = 48) {
  SnapshotOptions options;
  options.width = width;
  options.height = height;
  SnapshotRenderer renderer(options);
  MultiSuperquadric ball;
  ball.parts.resize(1);
  renderer.addModel(ball);
  return renderer;
}

} // namespace

TEST(SnapshotFile, HoldsThePictureAsPng) {
  const test::Folder folder;
  const SnapshotRenderer renderer = ballRenderer();
  renderer.save(folder / "out.PNG");
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((folder / "out.PNG").c_str());
  reader->Update();
  const SnapshotImage image = renderer.render();
  int size[3];
  reader->GetOutput()->GetDimensions(size);
  ASSERT_EQ(size[0], 64);
  ASSERT_EQ(size[1], 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const auto* pixel = static_cast<const unsigned char*>(
          reader->GetOutput()->GetScalarPointer(x, 47 - y, 0));
      EXPECT_EQ((Color{pixel[0], pixel[1], pixel[2]}), image.at(x, y));
    }
  EXPECT_EQ(folder.files(), 1u) << "a temporary file is left behind";
}

TEST(SnapshotFile, TurntablePicturesAreNumberedAndDiffer) {
  const test::Folder folder;
  SnapshotOptions options;
  options.width = options.height = 64;
  SnapshotRenderer renderer(options);
  MultiSuperquadric slab;
  slab.parts.resize(1);
  slab.parts[0].semi_axes = {0.3, 0.1, 0.05};
  renderer.addModel(slab);
  const auto names = renderer.saveTurntable(folder / "turn.png", 4);
  ASSERT_EQ(names.size(), 4u);
  EXPECT_EQ(names[0], folder / "turn_000.png");
  EXPECT_EQ(names[3], folder / "turn_003.png");
  EXPECT_EQ(folder.files(), 4u);
  const auto bytes = [](const std::string& name) {
    std::ifstream stream(name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_NE(bytes(names[0]), bytes(names[1]));
}

TEST(SnapshotFile, OnlyPngIsWritten) {
  const test::Folder folder;
  for (const char* name : {"out.jpg", "out", "out.png.bmp"}) {
    EXPECT_THROW(ballRenderer().save(folder / name), Exception) << name;
    EXPECT_THROW(ballRenderer().saveTurntable(folder / name, 2), Exception) << name;
  }
  EXPECT_EQ(folder.files(), 0u);
}

TEST(SnapshotFile, PlacesThatCannotBeWrittenAreErrors) {
  const test::Folder folder;
  EXPECT_THROW(ballRenderer().save(folder / "no/such/folder/out.png"), Exception);
  std::filesystem::create_directory(folder / "folder.png");
  EXPECT_THROW(ballRenderer().save(folder / "folder.png"), Exception);
  EXPECT_THROW(ballRenderer().save(""), Exception);
  EXPECT_EQ(folder.files(), 0u);
}

TEST(SnapshotFile, AFailureLeavesNothingHalfWritten) {
  const test::Folder folder;
  const std::string path = folder / "out.png";
  std::ofstream(path) << "precious";
  EXPECT_THROW(SnapshotRenderer().save(path), Exception); // empty scene
  std::string text;
  std::ifstream(path) >> text;
  EXPECT_EQ(text, "precious");
  EXPECT_EQ(folder.files(), 1u);
}

TEST(SnapshotOptions, EveryRangeIsHeldAtBothEnds) {
  std::string why;
  EXPECT_TRUE(SnapshotOptions().isValid(&why));
  const auto with = [](auto change) {
    SnapshotOptions options;
    change(options);
    std::string reason;
    const bool valid = options.isValid(&reason);
    EXPECT_EQ(valid, reason.empty());
    return valid;
  };
  EXPECT_FALSE(with([](SnapshotOptions& o) { o.width = o.height = 0; }));
  EXPECT_FALSE(with([](SnapshotOptions& o) { o.width = 15; }));
  EXPECT_TRUE(with([](SnapshotOptions& o) { o.width = 16; }));
  EXPECT_TRUE(with([](SnapshotOptions& o) { o.height = 4096; }));
  EXPECT_FALSE(with([](SnapshotOptions& o) { o.height = 4097; }));
  EXPECT_FALSE(with([](SnapshotOptions& o) { o.up.setZero(); }));
  EXPECT_FALSE(with([](SnapshotOptions& o) { o.up.x() = NAN; }));
  EXPECT_TRUE(with([](SnapshotOptions& o) { o.opacity = 0.0; }));
  EXPECT_TRUE(with([](SnapshotOptions& o) { o.opacity = 1.0; }));
  EXPECT_FALSE(with([](SnapshotOptions& o) { o.opacity = -0.01; }));
  EXPECT_FALSE(with([](SnapshotOptions& o) { o.opacity = 1.01; }));
  EXPECT_FALSE(with([](SnapshotOptions& o) { o.opacity = NAN; }));
  EXPECT_TRUE(with([](SnapshotOptions& o) { o.context = INFINITY; }));
  EXPECT_FALSE(with([](SnapshotOptions& o) { o.context = -1.0; }));
  EXPECT_FALSE(with([](SnapshotOptions& o) { o.point_size = 101.0; }));
}

TEST(SnapshotErrors, BadOptionsAndEmptyScenesAreRefusedBeforeRendering) {
  EXPECT_THROW(ballRenderer(0, 0).render(), Exception);
  EXPECT_THROW(ballRenderer(100000, 100000).render(), Exception);
  EXPECT_THROW(SnapshotRenderer().render(), Exception);
  EXPECT_THROW(ballRenderer().saveTurntable("unused.png", 0), Exception);
  SnapshotRenderer nothing_finite;
  nothing_finite.addCloud(Eigen::Matrix3Xd::Constant(3, 5, NAN));
  nothing_finite.addModel({});
  EXPECT_THROW(nothing_finite.render(), Exception);
}

TEST(SnapshotErrors, BadContentsAreRefusedWhenAdded) {
  SnapshotRenderer renderer;
  const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Zero(3, 5);
  EXPECT_THROW(renderer.addCloud(points, SnapshotRenderer::Colors(3, 4)), Exception);
  MultiSuperquadric flat;
  flat.parts.resize(1);
  flat.parts[0].semi_axes.z() = 0.0;
  EXPECT_THROW(renderer.addModel(flat), Exception);
  EXPECT_THROW(renderer.addLines(points, {}), Exception); // an odd number of ends
  EXPECT_THROW(renderer.addPoints(Eigen::Matrix3Xd::Constant(3, 2, NAN), {}),
               Exception);
  EXPECT_THROW(renderer.addBoxes({{{0, 0, 0}, {1, INFINITY, 1}}}, {}), Exception);
  TriangleMesh mesh;
  mesh.vertices.resize(2, Eigen::Vector3d::Zero());
  mesh.triangles.push_back({0, 1, 2});
  EXPECT_THROW(renderer.addMesh(mesh, {}), Exception);
  EXPECT_THROW(renderer.render(), Exception) << "something refused was kept";
}

TEST(SnapshotErrors, ASinglePointHasAPicture) {
  SnapshotOptions options;
  options.width = options.height = 32;
  SnapshotRenderer renderer(options);
  renderer.addCloud(Eigen::Vector3d(1, 2, 3));
  EXPECT_NE(renderer.render().at(16, 16), options.background);
}

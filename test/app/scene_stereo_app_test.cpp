// SPDX-License-Identifier: BSD-3-Clause
// pcl_sq_scene: all things of a view, and what may be wrong with it.
#include "program.h"
#include "table_scene.h"

#include "pcl_sq/scene_io.h"

#include <gtest/gtest.h>

#include <fstream>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

TableScene twoThings() {
  TableScene scene(600.0);
  scene.width = 320;
  scene.height = 240;
  scene.camera.cx = 159.5;
  scene.camera.cy = 119.5;
  scene.can({-0.08, 0.0}).stand({0.07, 0.0}, {0.03, 0.04, 0.04}, 0.1, 0.1, 0.3);
  return scene;
}

/** \brief The scene as an organized PCD file of text. */
std::string writeScene(const Folder& folder, const TableScene& scene) {
  const std::string path = folder / "scene.pcd";
  std::ofstream out(path);
  out << "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
      << scene.width << "\nHEIGHT " << scene.height
      << "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << scene.width * scene.height
      << "\nDATA ascii\n";
  const Eigen::Matrix3Xf points = scene.inCamera();
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    out << points(0, i) << " " << points(1, i) << " " << points(2, i) << "\n";
  return path;
}

/** \brief Labels as an image that needs no library: binary PGM. */
std::string
writeLabels(const Folder& folder, int width, int height, std::uint8_t of_left) {
  const std::string path = folder / "labels.pgm";
  std::ofstream out(path, std::ios::binary);
  out << "P5\n" << width << " " << height << "\n255\n";
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      out.put(x < width / 2 && y > height / 4 && y < height / 2 ? char(of_left)
                                                                : char(0));
  return path;
}

} // namespace

TEST(SceneProgram, WritesEveryThingAndItsPicture) {
  const Folder folder;
  const std::string cloud = writeScene(folder, twoThings());
  const ProgramRun run = runProgram("pcl_sq_scene",
                                    {cloud,
                                     "-o",
                                     folder / "scene.json",
                                     "--panel",
                                     folder / "scene.png",
                                     "--write-labels",
                                     folder / "labels.png"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.out.find("2 things on the table"), std::string::npos) << run.out;
  SceneFile file;
  std::string why;
  ASSERT_TRUE(loadScene(folder / "scene.json", file, &why)) << why;
  EXPECT_EQ(file.objects.size(), 2u);
  EXPECT_TRUE(file.table);
  EXPECT_EQ(slurp(folder / "scene.png").substr(1, 3), "PNG");
  // its own labels give the same things
  const ProgramRun again = runProgram(
      "pcl_sq_scene",
      {cloud, "--labels", folder / "labels.png", "-o", folder / "again.json", "-q"});
  ASSERT_EQ(again.code, 0) << again.err;
  SceneFile same;
  ASSERT_TRUE(loadScene(folder / "again.json", same, &why)) << why;
  ASSERT_EQ(same.objects.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_EQ(same.objects[k].pixels, file.objects[k].pixels);
}

TEST(SceneProgram, SaysWhatIsWrongInASentence) {
  const Folder folder;
  TableScene scene = twoThings();
  const std::string cloud = writeScene(folder, scene);
  const auto expect =
      [&](const std::vector<std::string>& arguments, int code, const char* about) {
        const ProgramRun run = runProgram("pcl_sq_scene", arguments);
        EXPECT_EQ(run.code, code) << run.err;
        EXPECT_EQ(run.sentences(), 1) << run.err;
        EXPECT_NE(run.err.find(about), std::string::npos) << run.err;
      };
  expect({}, 2, "nothing to look at");
  expect({cloud, "--labels", writeLabels(folder, 32, 24, 1)}, 1, "32 x 24");
  expect({cloud, "--labels", writeLabels(folder, scene.width, scene.height, 0)},
         1,
         "mark no thing");
  expect({cloud, "--calib", cloud}, 2, "pair of images");
  expect({cloud, cloud}, 2, "--calib");
  scene.things.clear();
  expect({writeScene(folder, scene)}, 1, "nothing stands on");
}

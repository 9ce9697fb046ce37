// SPDX-License-Identifier: BSD-3-Clause
// Models by file name.
#include "folder.h"
#include "pcl_sq/file_io.h"
#include "pcl_sq/scene_io.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

using namespace pcl_sq;

TEST(ModelFile, SavedModelsLoadAgain) {
  const test::Folder folder;
  test::Random random(3);
  ModelFile file, read;
  file.model.parts = {random.superquadric(), random.superquadric()};
  std::string why;
  ASSERT_TRUE(saveModel(folder / "model.json", file, &why)) << why;
  ASSERT_TRUE(loadModel(folder / "model.json", read, &why)) << why;
  EXPECT_EQ(toJson(read), toJson(file));
}

TEST(ModelFile, FailuresNameTheFileAndTheReason) {
  const test::Folder folder;
  ModelFile file;
  file.frame = "left";
  std::string why;
  EXPECT_FALSE(loadModel(folder / "missing.json", file, &why));
  EXPECT_NE(why.find("missing.json"), std::string::npos) << why;
  EXPECT_TRUE(file.frame.empty());
  EXPECT_FALSE(loadModel(folder.write("other.json", "{}"), file, &why));
  EXPECT_NE(why.find("other.json' is no model file"), std::string::npos) << why;
  EXPECT_FALSE(saveModel(folder / "no/model.json", file, &why));
  EXPECT_NE(why.find("does not exist; create it"), std::string::npos) << why;
}

TEST(ModelFile, KeepsTapers) {
  const test::Folder folder;
  test::Random random(4);
  ModelFile file, read;
  file.model.parts = {random.superquadric()};
  file.model.parts[0].kx = 0.1;
  file.model.parts[0].ky = 0.2;
  ASSERT_TRUE(saveModel(folder / "model.json", file));
  std::string why;
  EXPECT_TRUE(loadModel(folder / "model.json", read, &why)) << why;
  EXPECT_EQ(read.model.parts[0].kx, 0.1);
  EXPECT_EQ(read.model.parts[0].ky, 0.2);
}

TEST(ModelFile, WhatCouldNotBeReadBackIsNotWritten) {
  const test::Folder folder;
  test::Random random(4);
  ModelFile good;
  good.model.parts = {random.superquadric()};
  std::vector<std::pair<std::string, ModelFile>> wrong(6, {"", good});
  wrong[0].first = "semi_axes"; // JSON has no word for it
  wrong[0].second.model.parts[0].semi_axes[0] = std::nan("");
  wrong[1].first = "1e-20";
  wrong[1].second.model.parts[0].semi_axes.setConstant(1e-30);
  wrong[2].first = "length one";
  wrong[2].second.table = {0.0, 0.0, 5.0, 1.0};
  wrong[3].first = "extra_json";
  wrong[3].second.extra_json = "{nonsense";
  wrong[4].first = "extra_json";
  wrong[4].second.extra_json = "[1]";
  wrong[5].first = "options_json";
  wrong[5].second.options_json = "";
  for (const auto& [reason, file] : wrong) {
    std::string why;
    EXPECT_FALSE(saveModel(folder / "model.json", file, &why));
    EXPECT_NE(why.find(reason), std::string::npos) << why;
    SceneFile scene;
    scene.objects.resize(1);
    scene.objects[0].file = file;
    EXPECT_FALSE(saveScene(folder / "scene.json", scene, &why)) << reason;
  }
  EXPECT_EQ(folder.files(), 0U);
}

TEST(ModelFile, ANameWithAZeroByteIsNotTheShorterOne) {
  const test::Folder folder;
  std::string why, bytes;
  const std::string name = folder / "a" + std::string(1, '\0') + "b.json";
  EXPECT_FALSE(saveModel(name, ModelFile(), &why));
  EXPECT_NE(why.find("zero byte"), std::string::npos) << why;
  EXPECT_FALSE(readFile(name, bytes, &why));
  EXPECT_NE(why.find("zero byte"), std::string::npos) << why;
  EXPECT_EQ(folder.files(), 0U);
}

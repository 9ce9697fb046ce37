// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/scene_io.h"
#include "text.h"

#include "folder.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

SceneFile twoThings() {
  SceneFile file;
  file.objects.resize(2);
  for (std::size_t k = 0; k < 2; ++k) {
    SceneFileObject& object = file.objects[k];
    object.file.model.parts.resize(k + 1);
    object.file.model.parts[0].semi_axes = {0.03, 0.03, 0.06};
    object.roi = {10, 20, 30, 40};
    object.pixels = 900;
    object.visible = 0.75;
    object.confidence = 0.9;
    object.notes = {"a note"};
  }
  Superquadric& cup = file.objects[1].file.model.parts[0];
  cup.kx = cup.ky = 0.1;
  cup.rim = 0.9;
  cup.wall = 0.003;
  file.table = {0.0, 0.0, 1.0, -0.75};
  file.frame = "camera";
  file.notes = {"one thing is left out"};
  file.timings_ms = {{"segment", 12.5}};
  file.input_path = "scene.pcd";
  file.input_points = 307200;
  return file;
}

} // namespace

TEST(SceneIo, WhatIsWrittenIsReadBack) {
  const std::string text = toJson(twoThings());
  SceneFile read;
  std::string why;
  ASSERT_TRUE(fromJson(text, read, &why)) << why;
  EXPECT_EQ(toJson(read), text);
  EXPECT_EQ(read.objects[1].file.model.parts[0].wall, 0.003);
  EXPECT_EQ(read.objects[1].roi, (CellRect{10, 20, 30, 40}));
  EXPECT_EQ(read.notes, twoThings().notes);
  EXPECT_EQ(read.all().size(), 3u);
  EXPECT_EQ(read.all(1).size(), 1u);
}

TEST(SceneIo, EachObjectIsAModelFileByItself) {
  const std::string text = toJson(twoThings(), -1);
  const auto begin = text.find("\"objects\":[") + 11;
  int depth = 0;
  std::size_t end = begin;
  do {
    depth += text[end] == '{' ? 1 : text[end] == '}' ? -1 : 0;
    ++end;
  } while (depth > 0);
  ModelFile model;
  std::string why;
  ASSERT_TRUE(fromJson(text.substr(begin, end - begin), model, &why)) << why;
  EXPECT_EQ(model.model.size(), 1u);
}

TEST(SceneIo, ScenesAndModelsAreToldApart) {
  EXPECT_TRUE(isScene(toJson(twoThings())));
  EXPECT_FALSE(isScene(toJson(twoThings().objects[0].file)));
  EXPECT_FALSE(isScene("{"));
  ModelFile model;
  EXPECT_FALSE(fromJson(toJson(twoThings()), model));
}

TEST(SceneIo, RefusesWhatIsNoScene) {
  const std::string good = toJson(twoThings(), -1);
  const auto refused = [](const std::string& text) {
    SceneFile file;
    std::string why;
    EXPECT_FALSE(fromJson(text, file, &why));
    EXPECT_TRUE(file.objects.empty());
    return why;
  };
  EXPECT_NE(refused("[]"), "");
  EXPECT_NE(refused(good.substr(0, good.size() / 2)), "");
  refused(replaced(good, "\"version\":1,\"unit\"", "\"version\":2,\"unit\""));
  EXPECT_NE(refused(replaced(good, "\"semi_axes\":[0.03", "\"semi_axes\":[-0.03"))
                .find("object 1"),
            std::string::npos);
  refused(replaced(good, "\"roi\":[10,", "\"roi\":[-10,"));
  refused(replaced(good, "\"visible\":0.75", "\"visible\":1.75"));
  refused(replaced(good, "\"table\":[0.0,0.0,1.0,", "\"table\":[0.0,0.0,2.0,"));
  SceneFile file;
  std::string why;
  EXPECT_FALSE(loadScene("/nowhere/scene.json", file, &why));
  EXPECT_NE(why, "");
}

TEST(SceneIo, FilesAreWrittenWhole) {
  const Folder folder;
  std::string why;
  ASSERT_TRUE(saveScene(folder / "scene.json", twoThings(), &why)) << why;
  SceneFile read;
  ASSERT_TRUE(loadScene(folder / "scene.json", read, &why)) << why;
  EXPECT_EQ(read.objects.size(), 2u);
}

// SPDX-License-Identifier: BSD-3-Clause
// Models by file name.
#include "folder.h"
#include "pcl_sq/model_io.h"

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

// SPDX-License-Identifier: BSD-3-Clause
// Small files of strangers, changed a thousand times: read whole or refused.
#include "command_line/app.h"
#include "files/gripper_file.h"
#include "mutate.h"
#include "scene/pose_file.h"
#include "scene/truth.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

const char* const HAND = "name = \"hand\"\nmax_opening = 0.085\nfinger_length = 0.06\n"
                         "finger_width = 0.027\npad_length = 0.037\n";

std::string handRefusal(const std::string& text) {
  try {
    std::string missing;
    (void)app::gripperFromToml(text, "hand.toml", missing);
  } catch (const app::UsageError& e) {
    return e.what();
  }
  return "nothing was refused";
}

} // namespace

TEST(GripperFile, NamesTheKeyThatIsInMillimetresUnknownOrTwice) {
  EXPECT_NE(handRefusal("max_opening = 85\n").find("write max_opening = 0.085"),
            std::string::npos);
  EXPECT_NE(handRefusal("finger_lenght = 0.06\n").find("finger_length"),
            std::string::npos);
  EXPECT_NE(handRefusal("palm_width = 0\n").find("palm_width"), std::string::npos);
  EXPECT_NE(handRefusal("fingers = 1e300\n").find("fingers"), std::string::npos);
  EXPECT_NE(handRefusal("palm_width = abc\n").find("palm_width"), std::string::npos);
  EXPECT_EQ(handRefusal(HAND), "nothing was refused");
}

TEST(GripperFile, SaysWhichSizesAreLeftOut) {
  std::string missing;
  (void)app::gripperFromToml("max_opening = 0.14\n", "hand.toml", missing);
  EXPECT_NE(missing.find("finger_length"), std::string::npos);
  EXPECT_EQ(missing.find("max_opening"), std::string::npos);
}

TEST(GripperFile, ChangedFilesAreRefusedOrGiveAHandThatIsValid) {
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Mutator mutate(seed);
    try {
      std::string missing;
      EXPECT_TRUE(app::gripperFromToml(mutate(HAND), "hand.toml", missing).isValid())
          << seed;
    } catch (const app::UsageError& e) {
      EXPECT_GT(std::string(e.what()).size(), 20u) << seed;
    }
  }
}

TEST(TruthFile, ChangedFilesAreRefusedOrGiveNumbersThatAreFinite) {
  app::SceneTruth truth;
  truth.width = 640;
  truth.height = 480;
  truth.focal_length = 500;
  truth.baseline = 0.06;
  truth.parts.parts.push_back(Superquadric());
  truth.mesh = "can.obj";
  const std::string text = app::toJson(truth);
  ASSERT_NO_THROW((void)app::truthFromJson(text, "truth.json"));
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Mutator mutate(seed);
    try {
      const app::SceneTruth t = app::truthFromJson(mutate(text), "truth.json");
      EXPECT_TRUE(t.rotation.allFinite() && t.translation.allFinite()) << seed;
      EXPECT_TRUE(t.table.allFinite() && t.size.allFinite()) << seed;
      for (const Superquadric& s : t.parts.parts)
        EXPECT_TRUE(s.isValid()) << seed;
    } catch (const app::Failure& e) {
      EXPECT_GT(std::string(e.what()).size(), 20u) << seed;
    }
  }
}

TEST(PoseFile, ChangedPosesAreRefusedOrRigid) {
  const std::string text = "1 0 0 0.1  0 1 0 -0.2  0 0 1 0.7  0 0 0 1";
  for (std::uint64_t seed = 1; seed <= 1000; ++seed) {
    Mutator mutate(seed);
    Eigen::Matrix3d r;
    Eigen::Vector3d t;
    try {
      app::readPose(mutate(text), r, t);
      EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-3) << seed;
      EXPECT_TRUE(t.allFinite()) << seed;
    } catch (const app::Failure&) {
      // refused
    }
  }
}

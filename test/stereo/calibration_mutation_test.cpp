// SPDX-License-Identifier: BSD-3-Clause
#include "mutate.h"
#include "rig_formats.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

TEST(CalibrationMutation, ChangedFilesAreRefusedOrGiveACameraThatIsValid) {
  const Rig rig;
  int accepted = 0, refused = 0;
  for (const auto& [name, texts] : rig.formats())
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      std::vector<CalibrationText> changed = texts;
      Mutator mutate(seed);
      changed[seed % changed.size()].text = mutate(changed[seed % changed.size()].text);
      try {
        // without maps: they are OpenCV's work, and slow
        const auto c = StereoCalibration::fromText(changed, 1.0, 672, 376);
        std::string why;
        const StereoIntrinsics& k = c.getIntrinsics();
        EXPECT_TRUE(k.fx == 0.0 || k.isValid(&why))
            << name << " " << seed << ": " << why;
        ++accepted;
      } catch (const Exception& e) {
        EXPECT_GT(std::string(e.what()).size(), 40u) << name << " " << seed;
        ++refused;
      }
    }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refused, 100);
}

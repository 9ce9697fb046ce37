// SPDX-License-Identifier: BSD-3-Clause
#include "check_readers.h"
#include "mutations.h"
#include "small_clouds.h"

#include <gtest/gtest.h>

#include <cstdlib>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief Mutations of each file; a million by hand: PCL_SQ_MUTATIONS=80000. */
std::size_t mutations() {
  const char* text = std::getenv("PCL_SQ_MUTATIONS");
  return text ? std::strtoul(text, nullptr, 10) : 1000;
}

} // namespace

TEST(Mutations, TheSmallFilesThemselvesAreRead) {
  for (const auto& [bytes, extension] : smallClouds())
    EXPECT_EQ(refusal(bytes, extension), "") << bytes;
}

TEST(Mutations, OfAnyFileAreReadOrRefusedWithASentence) {
  std::size_t seed = 0, read = 0, refused = 0;
  for (const auto& [bytes, extension] : smallClouds()) {
    ++seed;
    for (std::size_t i = 0; i < mutations(); ++i) {
      std::mt19937 random(static_cast<unsigned>(1000003 * seed + i));
      const std::string changed = mutated(bytes, random);
      ASSERT_EQ(complaintOfCloud(changed, extension), "")
          << extension << " " << i << "\n"
          << changed;
      ASSERT_EQ(complaintOfMesh(changed, extension), "")
          << extension << " " << i << "\n"
          << changed;
      ++(refusal(changed, extension).empty() ? read : refused);
    }
  }
  EXPECT_GT(read, refused / 100);
  EXPECT_GT(refused, read / 100);
  RecordProperty("read", static_cast<int>(read));
  RecordProperty("refused", static_cast<int>(refused));
}

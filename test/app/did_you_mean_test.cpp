// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/did_you_mean.h"
#include "command_line/value_checks.h"

#include <gtest/gtest.h>

using namespace pcl_sq::app;

TEST(DidYouMean, DistanceCountsSingleEdits) {
  EXPECT_EQ(editDistance("", ""), 0u);
  EXPECT_EQ(editDistance("abc", "abc"), 0u);
  EXPECT_EQ(editDistance("", "abc"), 3u);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(editDistance("tabel", "table"), 1u) << "neighbours exchanged";
}

TEST(DidYouMean, DistanceIsSymmetric) {
  for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{
           {"roi", "rio"}, {"matcher", "math"}, {"preset", "perset"}, {"a", "ba"}})
    EXPECT_EQ(editDistance(a, b), editDistance(b, a));
}

TEST(DidYouMean, FindsTheNameThatWasMeant) {
  const std::vector<std::string> names = {"--remove-plane",
                                          "--roi",
                                          "--parts",
                                          "--max-parts",
                                          "--preset",
                                          "-o",
                                          "--output"};
  EXPECT_EQ(closestName("--remove-plan", names), "--remove-plane");
  EXPECT_EQ(closestName("--removeplane", names), "--remove-plane");
  EXPECT_EQ(closestName("--remove_plane", names), "--remove-plane");
  EXPECT_EQ(closestName("--rem", names), "--remove-plane");
  EXPECT_EQ(closestName("--RIO", names), "--roi");
  EXPECT_EQ(closestName("-output", names), "--output");
  EXPECT_EQ(closestName("--part", names), "--parts");
  EXPECT_EQ(closestName("--gripper", names), "");
  EXPECT_EQ(closestName("-z", names), "");
  EXPECT_EQ(closestName(std::string(100000, 'a'), names), "");
  EXPECT_EQ(didYouMean("--presett", names), "; did you mean '--preset'?");
}

TEST(ValueChecks, NumbersAreAllOfTheWord) {
  double number = 0.0;
  for (const char* word : {"1", "-1", "+1", ".5", "5.", "1e-3", "007"})
    EXPECT_TRUE(parseNumber(word, number)) << word;
  for (const char* word : {"",
                           "x",
                           "3abc",
                           "1 2",
                           "nan",
                           "inf",
                           "-inf",
                           "1e400",
                           "0x10",
                           "+-1",
                           "--1",
                           "1,5"})
    EXPECT_FALSE(parseNumber(word, number)) << word;
}

TEST(ValueChecks, WholeNumbersAreDecimal) {
  CLI::Validator check = wholeNumber(0, 16);
  std::string word = "010";
  EXPECT_EQ(check(word), "");
  EXPECT_EQ(word, "10");
  for (const char* wrong :
       {"1.5", "true", "-1", "17", "0x8", "", "99999999999999999999"}) {
    std::string value = wrong;
    EXPECT_EQ(check(value).rfind("wants a whole number from 0 to 16, not '", 0), 0u)
        << value;
  }
}

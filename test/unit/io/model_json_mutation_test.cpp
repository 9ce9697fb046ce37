// SPDX-License-Identifier: BSD-3-Clause
#include "mutate.h"
#include "pcl_sq/mass_properties.h"
#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

std::string sample() {
  ModelFile file;
  file.model.parts = {Superquadric(), Superquadric()};
  file.model.parts[1].center = {0.5, 0.2, 0.7};
  file.statistics = {{46, 1e-6, 3e-4, "MAX_ITERATIONS"}, {}};
  file.model.parts[0].kx = 0.1;
  return toJson(file);
}

std::string refusal(const std::string& text) {
  ModelFile file;
  std::string why;
  return fromJson(text, file, &why) ? "nothing was refused" : why;
}

std::string withAxis(const std::string& number) {
  std::string text = sample();
  const std::size_t at = text.find("1.0", text.find("semi_axes"));
  return text.replace(at, 3, number);
}

} // namespace

TEST(ModelJson, ChangedFilesAreRefusedOrGiveFiguresThatAreFinite) {
  const std::string text = sample();
  int accepted = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    Mutator mutate(seed);
    ModelFile file;
    std::string why;
    if (!fromJson(mutate(text), file, &why)) {
      EXPECT_FALSE(why.empty()) << seed;
      continue;
    }
    ++accepted;
    for (const Superquadric& s : file.model.parts) {
      EXPECT_TRUE(std::isfinite(s.volume()) && s.volume() > 0.0) << seed;
      EXPECT_TRUE(s.inertia().allFinite()) << seed;
    }
    EXPECT_TRUE(massProperties(file.model, 8).inertia.allFinite()) << seed;
<<<<<<< HEAD
    const nlohmann::json written = nlohmann::json::parse(toJson(file));
    const nlohmann::json flat = written.flatten(); // {} becomes null in there
    for (const auto& [path, value] : flat.items())
      EXPECT_FALSE(value.is_null() &&
                   written.at(nlohmann::json::json_pointer(path)).is_null())
          << seed << ' ' << path;
=======
    // kept, for items() refers to it
    const nlohmann::json written = nlohmann::json::parse(toJson(file)).flatten();
    for (const auto& [path, value] : written.items())
      // the figures: what else there is stays as it was, and empty lists flatten to
      // null
      if (path.rfind("/superquadrics/", 0) == 0 || path == "/distortion") {
        EXPECT_FALSE(value.is_null()) << seed << ' ' << path;
      }
>>>>>>> main
  }
  EXPECT_GT(accepted, 150);
}

TEST(ModelJson, SizesThatArithmeticCannotBearAreRefused) {
  EXPECT_EQ(refusal(withAxis("0.033")), "nothing was refused");
  for (const char* number : {"1e300", "1e148", "1e-61", "1e21", "1e-21"})
    EXPECT_NE(refusal(withAxis(number)).find("semi-axis"), std::string::npos) << number;
  EXPECT_NE(refusal(withAxis("1e999")).find("too large"), std::string::npos);
}

TEST(ModelJson, NestingIsBounded) {
  std::string deep = sample();
  deep.insert(deep.find("\"options\": ") + 11, std::string(40000, '['));
  EXPECT_FALSE(refusal(deep).empty());
  std::string closed = sample();
  const std::size_t at = closed.find("{}", closed.find("\"options\": "));
  closed.replace(at, 2, std::string(20000, '[') + std::string(20000, ']'));
  EXPECT_NE(refusal(closed).find("nest deeper"), std::string::npos);
}

TEST(ModelJson, NeverWritesANumberThatIsNone) {
  ModelFile file;
  file.model.parts = {Superquadric()};
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  file.statistics = {{1, nothing, nothing, "x"}};
  file.distortion = file.rms_distance = nothing;
  file.timings_ms = {{"fit", nothing}};
  const std::string text = toJson(file);
  EXPECT_EQ(text.find("null"), std::string::npos) << text;
  EXPECT_EQ(refusal(text), "nothing was refused");
}

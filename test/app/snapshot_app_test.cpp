// SPDX-License-Identifier: BSD-3-Clause
#include "bottle_view.h"
#include "program.h"

#include "pcl_sq/model_io.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

std::string bottleJson() {
  ModelFile file;
  file.model = bottle();
  return toJson(file);
}

std::string bottleXyz() {
  std::ostringstream text;
  text << visiblePoints(bottle(), 500, 0.0005).transpose() << "\n";
  return text.str();
}

/** \brief Width and height in a PNG's header; zeros if it is none. */
std::pair<int, int> sizeOf(const std::string& path) {
  const std::string bytes = slurp(path);
  if (bytes.size() < 24 || bytes.substr(1, 3) != "PNG")
    return {0, 0};
  const auto number = [&bytes](std::size_t at) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
      value = 256 * value + static_cast<unsigned char>(bytes[i]);
    return value;
  };
  return {number(16), number(20)};
}

const std::pair<int, int> SMALL{200, 150};

/** \brief The program refuses and leaves nothing behind. */
void expectNoPicture(const Folder& folder,
                     const std::vector<std::string>& arguments,
                     int code) {
  test::expectRefusal("pcl_sq_snapshot", arguments, code, "", &folder);
}

} // namespace

TEST(SnapshotApp, TakesAPictureOfModelAndCloudWithoutADisplay) {
  const Folder folder;
  const std::string model = folder.write("bottle.json", bottleJson());
  const std::string cloud = folder.write("bottle.xyz", bottleXyz());
  for (const char* view : {"front", "camera"}) {
    const std::string output = folder / (std::string(view) + ".png");
    const ProgramRun run = runProgram(
        "pcl_sq_snapshot",
        {model, "--cloud", cloud, "--view", view, "--size", "200x150", "-o", output},
        "env -u DISPLAY");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.sentences(), 0) << run.err;
    EXPECT_EQ(sizeOf(output), SMALL);
  }
  EXPECT_NE(slurp(folder / "front.png"), slurp(folder / "camera.png"));
  EXPECT_EQ(folder.files(), 4u);
}

TEST(SnapshotApp, ModelOrCloudAloneIsEnough) {
  const Folder folder;
  const std::string model = folder.write("bottle.json", bottleJson());
  const std::string cloud = folder.write("bottle.xyz", bottleXyz());
  for (const std::vector<std::string>& input :
       {std::vector<std::string>{model}, std::vector<std::string>{"--cloud", cloud}}) {
    std::vector<std::string> arguments = input;
    arguments.insert(arguments.end(), {"--size", "200x150", "-o", folder / "out.png"});
    EXPECT_EQ(runProgram("pcl_sq_snapshot", arguments).code, 0);
    EXPECT_EQ(sizeOf(folder / "out.png"), SMALL);
  }
}

TEST(SnapshotApp, StandsTheObjectOnTheTableThatTheModelFileTells) {
  const Folder folder;
  const auto picture = [&](const std::string& extra,
                           const std::vector<std::string>& up) {
    ModelFile file;
    file.model = bottle();
    file.extra_json = extra;
    const std::string model = folder.write("bottle.json", toJson(file));
    std::vector<std::string> arguments = {model, "--size", "200x150"};
    arguments.insert(arguments.end(), {"-o", folder / "out.png"});
    arguments.insert(arguments.end(), up.begin(), up.end());
    const ProgramRun run = runProgram("pcl_sq_snapshot", arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return slurp(folder / "out.png");
  };
  const std::string tilted = "{\"report\": {\"up\": [0, -0.8, -0.6]}}";
  const std::string plain = picture("{}", {});
  EXPECT_NE(picture(tilted, {}), plain);
  EXPECT_EQ(picture(tilted, {}), picture("{}", {"--up", "0,-0.8,-0.6"}));
  EXPECT_EQ(picture(tilted, {"--up", "-y"}), plain);
  for (const char* nonsense : {"{\"report\": 3}",
                               "{\"report\": {\"up\": \"-y\"}}",
                               "{\"report\": {\"up\": [0, 0, 0]}}",
                               "{\"report\": {\"up\": [1, null, 2]}}"})
    EXPECT_EQ(picture(nonsense, {}), plain) << nonsense;
}

TEST(SnapshotApp, TurntableWritesNumberedPicturesAndNoProgressIntoAFile) {
  const Folder folder;
  const std::string model = folder.write("bottle.json", bottleJson());
  const ProgramRun run = runProgram(
      "pcl_sq_snapshot",
      {model, "--turntable", "3", "--size", "200x150", "-o", folder / "turn.png"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(run.sentences(), 0) << run.err;
  for (const char* name : {"turn_000.png", "turn_001.png", "turn_002.png"})
    EXPECT_EQ(sizeOf(folder / name), SMALL) << name;
  EXPECT_EQ(folder.files(), 4u);
}

TEST(SnapshotApp, BadCommandLinesEndWithTwo) {
  const Folder folder;
  const std::string model = folder.write("bottle.json", bottleJson());
  const std::string output = folder / "out.png";
  expectNoPicture(folder, {}, 2);
  expectNoPicture(folder, {"-o", output}, 2); // nothing to show
  expectNoPicture(folder, {model}, 2);        // nowhere to
  expectNoPicture(folder, {model, "-o", folder / "out.jpg"}, 2);
  for (const char* size :
       {"0x0", "640", "640x", "x480", "640x480x3", "-640x480", "9999x9", "axb", ""})
    expectNoPicture(folder, {model, "-o", output, "--size", size}, 2);
  for (const char* view : {"bottom", "Iso", ""})
    expectNoPicture(folder, {model, "-o", output, "--view", view}, 2);
  for (const char* count : {"0", "-1", "1001", "many"})
    expectNoPicture(folder, {model, "-o", output, "--turntable", count}, 2);
  for (const char* opacity : {"-0.1", "1.1", "nan", "half"})
    expectNoPicture(folder, {model, "-o", output, "--opacity", opacity}, 2);
  for (const char* up : {"w", "0,0,0", "1,2", "1,2,3,4", "nan,0,0", "--y"})
    expectNoPicture(folder, {model, "-o", output, "--up", up}, 2);
  expectNoPicture(folder, {model, "-o", output, "--veiw", "iso"}, 2);
}

TEST(SnapshotApp, FailuresEndWithOneAndLeaveNothing) {
  const Folder folder;
  const std::string model = folder.write("bottle.json", bottleJson());
  const std::string output = folder / "out.png";
  expectNoPicture(folder, {folder / "missing.json", "-o", output}, 1);
  expectNoPicture(
      folder, {folder.write("no.json", "{\"schema\": 1}"), "-o", output}, 1);
  ModelFile empty;
  const std::string nothing = folder.write("empty.json", toJson(empty));
  expectNoPicture(folder, {nothing, "-o", output}, 1);
  expectNoPicture(folder, {model, "--cloud", folder / "no.pcd", "-o", output}, 1);
  expectNoPicture(folder, {model, "-o", folder / "no/such/folder/out.png"}, 1);
  ModelFile behind;
  behind.model = bottle();
  behind.model.parts[0].center.z() = -1.0;
  const std::string unseen = folder.write("behind.json", toJson(behind));
  expectNoPicture(folder, {unseen, "--view", "camera", "-o", output}, 1);
}

TEST(SnapshotApp, WithoutDisplayAndXvfbOneSentenceNamesTheCure) {
  const Folder folder;
  const std::string model = folder.write("bottle.json", bottleJson());
  const ProgramRun run = runProgram("pcl_sq_snapshot",
                                    {model, "-o", folder / "out.png"},
                                    "env -u DISPLAY PATH=/nonexistent");
  EXPECT_EQ(run.code, 1);
  EXPECT_EQ(run.sentences(), 1) << run.err;
  EXPECT_NE(run.err.find("xvfb"), std::string::npos) << run.err;
  EXPECT_EQ(folder.files(), 1u);
}

TEST(SnapshotApp, HelpShowsExamplesAndVersionTheVersion) {
  const ProgramRun help = runProgram("pcl_sq_snapshot", {"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("Examples:"), std::string::npos);
  for (const char* option : {"--cloud", "--size", "--view", "--turntable"})
    EXPECT_NE(help.out.find(option), std::string::npos) << option;
  const ProgramRun version = runProgram("pcl_sq_snapshot", {"--version"});
  EXPECT_EQ(version.code, 0);
  EXPECT_NE(version.out.find(PCL_SQ_VERSION), std::string::npos);
}

// SPDX-License-Identifier: BSD-3-Clause
// What people really feed to the programs, up to the model.
#include "file_bytes.h"
#include "fit_program.h"
#include "program.h"

#include "pcl_sq/model_io.h"
#include "pcl_sq/triangle_mesh.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

const Eigen::Vector3d SIZE(0.066, 0.066, 0.12); ///< of a can [m]

/** \brief Points all round a can, in units of \a unit [m], moved. */
std::vector<Eigen::Vector3d> can(double unit, const Eigen::Vector3d& place) {
  Superquadric s;
  s.semi_axes = 0.5 * SIZE;
  s.epsilon1 = 0.1;
  s.epsilon2 = 1.0;
  s.center = place;
  std::vector<Eigen::Vector3d> points = sampleUniform(s, 2000);
  for (Eigen::Vector3d& p : points)
    p /= unit;
  return points;
}

std::string text(const std::vector<Eigen::Vector3d>& points) {
  std::ostringstream lines;
  lines.precision(12);
  for (const Eigen::Vector3d& p : points)
    lines << p.transpose() << "\n";
  return lines.str();
}

/** \brief A PLY of shorts, as old Kinect tools write. */
std::string shortPly(const std::vector<Eigen::Vector3d>& points) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(points.size()) +
                      "\nproperty short x\nproperty short y\nproperty short "
                      "z\nend_header\n";
  for (const Eigen::Vector3d& p : points)
    for (const double value : p)
      bytes += bytesOf(static_cast<std::int16_t>(std::lround(value)));
  return bytes;
}

struct Fitted {
  ProgramRun run;
  ModelFile file;
};

Fitted fit(const Folder& folder,
           const std::string& cloud,
           const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments = {cloud, "--parts", "1", "-o", folder / "m.json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  Fitted fitted;
  fitted.run = runProgram("pcl_sq_fit", arguments);
  EXPECT_EQ(fitted.run.code, 0) << fitted.run.err;
  EXPECT_TRUE(fromJson(slurp(folder / "m.json"), fitted.file));
  return fitted;
}

/** \brief Sides of the one part, the smallest first [m]. */
Eigen::Vector3d sides(const ModelFile& file) {
  if (file.model.size() != 1)
    return Eigen::Vector3d::Zero();
  Eigen::Vector3d s = 2.0 * file.model.parts[0].semi_axes;
  std::sort(s.data(), s.data() + 3);
  return s;
}

} // namespace

TEST(CloudInput, MillimetresAreDoubtedAndReadWithTheUnit) {
  const Folder folder;
  const std::string cloud =
      folder.write("kinect.ply", shortPly(can(1e-3, {0.02, 0.01, 0.7})));
  const Fitted metres = fit(folder, cloud);
  EXPECT_TRUE(tells(metres.run.err, {"the object would be 12", "--unit"}))
      << metres.run.err;
  EXPECT_TRUE(tells(slurp(folder / "m.json"), {"--unit"}));
  const Fitted millimetres = fit(folder, cloud, {"--unit", "mm"});
  EXPECT_TRUE(millimetres.run.err.find("--unit") == std::string::npos);
  EXPECT_NEAR((sides(millimetres.file) - SIZE).norm(), 0.0, 0.003);
  EXPECT_EQ(runProgram("pcl_sq_fit", {cloud, "--unit", "furlong"}).code, 2);
}

TEST(CloudInput, MeshesAreSurfacesAndThatIsSaid) {
  const Folder folder;
  const std::string box = folder.write(
      "box.obj",
      "v -.05 -.03 0\nv -.05 -.03 .2\nv -.05 .03 0\nv -.05 .03 .2\nv .05 -.03 0\nv .05 "
      "-.03 .2\nv .05 .03 0\nv .05 .03 .2\nf 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 "
      "7\nf "
      "1 3 7 5\nf 2 6 8 4\n");
  const Fitted fitted = fit(folder, box, {"--samples", "2500"});
  EXPECT_TRUE(tells(fitted.run.err, {"6 faces sampled with 2500 points"}));
  EXPECT_NEAR((sides(fitted.file) - Eigen::Vector3d(0.06, 0.1, 0.2)).norm(), 0.0, 1e-3);
}

TEST(CloudInput, MissingPointsAreLeftOutAndThatIsSaid) {
  const Folder folder;
  std::vector<Eigen::Vector3d> points = can(1.0, {0.02, 0.01, 0.7});
  for (std::size_t i = 0; i < 300; ++i)
    points[i] = i % 3 == 0 ? Eigen::Vector3d(0, 0, 10000) : Eigen::Vector3d(0, 0, 0);
  const Fitted fitted = fit(folder, folder.write("a.txt", text(points)));
  EXPECT_TRUE(
      tells(fitted.run.err, {"200 points at 0 0 0", "100 points with z = 10000"}))
      << fitted.run.err;
  EXPECT_EQ(fitted.file.finite_points, 1700u);
  EXPECT_NEAR((sides(fitted.file) - SIZE).norm(), 0.0, 0.003);
}

TEST(CloudInput, GeoreferencedCloudsGiveGeoreferencedResults) {
  const Folder folder;
  const Eigen::Vector3d place(451234.3, 5412345.7, 312.1);
  const std::string cloud = folder.write("utm.xyz", text(can(1.0, place)));
  const Fitted fitted = fit(folder, cloud, {"--mesh", folder / "m.obj"});
  EXPECT_NEAR((sides(fitted.file) - SIZE).norm(), 0.0, 0.002);
  ASSERT_EQ(fitted.file.model.size(), 1u);
  EXPECT_NEAR((fitted.file.model.parts[0].center - place).norm(), 0.0, 0.001);
  const ProgramRun judged = runProgram(
      "pcl_sq_evaluate", {folder / "m.json", "--cloud", cloud, "--format", "table"});
  ASSERT_EQ(judged.code, 0) << judged.err;
  std::istringstream table(judged.out.substr(judged.out.find("cloud to model, rms")));
  std::string word;
  double rms = 1e9;
  table >> word >> word >> word >> word >> rms;
  EXPECT_LT(rms, 1.0) << judged.out; // [mm]
  // the same grasps as at home, elsewhere
  const std::string home =
      folder.write("home.xyz", text(can(1.0, place - place.array().round().matrix())));
  const auto firstGrasp = [&](const std::string& path) {
    const ProgramRun run =
        runProgram("pcl_sq_grasp",
                   {path, "--parts", "1", "--count", "1", "-o", folder / "g.json"});
    EXPECT_EQ(run.code, 0) << run.err;
    const std::string json = slurp(folder / "g.json");
    Eigen::Vector3d position;
    std::string numbers =
        json.substr(json.find("\"position\"", json.find("\"grasps\"")));
    numbers = numbers.substr(numbers.find('[') + 1);
    std::istringstream(replaced(numbers.substr(0, numbers.find(']')), ",", " ")) >>
        position.x() >> position.y() >> position.z();
    return position;
  };
  EXPECT_NEAR(
      (firstGrasp(cloud) - firstGrasp(home) - place.array().round().matrix()).norm(),
      0.0,
      2e-3);
}

TEST(CloudInput, WhatIsNotUnderstoodIsRefusedByItsName) {
  const Folder folder;
  const auto sentence = [&](const std::string& name, const std::string& bytes) {
    const ProgramRun run = runProgram("pcl_sq_fit", {folder.write(name, bytes)});
    EXPECT_EQ(run.code, 1) << name;
    EXPECT_EQ(run.sentences(), 1) << run.err;
    return run.err;
  };
  EXPECT_TRUE(
      tells(sentence("a.xyz", "1 2 3\n1,5 2,5 3,5\n"), {"line 2", "decimal commas"}));
  EXPECT_TRUE(tells(sentence("b.xyz", "1 2 3\n1 2 3abc\n"), {"line 2", "'3abc'"}));
  const std::string odd = sentence("c\xff.xyz", "1 2 \x1b[31m\n");
  EXPECT_EQ(odd.find('\x1b'), std::string::npos);
  EXPECT_EQ(odd.find('\xff'), std::string::npos);
}

TEST(FitApp, FilesThatAreNoCloudsAreRefusedInOneSentence) {
  const Folder folder;
  const std::string good = bottlePcd(500);
  const auto refuse = [&](const std::string& name, const std::string& bytes) {
    expectRefusal(folder, {folder.write(name, bytes)});
  };
  expectRefusal(folder, {folder / "missing.pcd"});
  expectRefusal(folder, {folder / ""});
  for (const std::string extension : {".pcd", ".ply", ".obj", ".xyz"}) {
    refuse("empty" + extension, "");
    std::string garbage(5000, '\0');
    for (std::size_t i = 0; i < garbage.size(); ++i)
      garbage[i] = char(i * 7919 >> 3);
    refuse("garbage" + extension, garbage);
  }
  const std::string header = good.substr(0, good.find("DATA"));
  refuse("truncated.pcd", good.substr(0, good.size() / 2));
  refuse("no_data.pcd", header);
  refuse("binary.pcd", header + "DATA binary\n" + std::string(100, 'x'));
  refuse("lzf.pcd", header + "DATA binary_compressed\n" + std::string(100, 'x'));
  refuse("lzf_tiny.pcd", header + "DATA binary_compressed\n");
  refuse("kind.pcd", header + "DATA morse\n");
  std::string lie = replaced(good, "HEIGHT 1\n", "HEIGHT 1000000000\n");
  refuse("height.pcd", lie);
  lie = replaced(lie, "POINTS", "#");
  refuse("height_alone.pcd", lie);
  refuse("binary_huge.pcd",
         "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH "
         "1000000\nHEIGHT 1000000\nPOINTS 1000000000000\nDATA binary\n1234");
  refuse("count.pcd", replaced(good, "COUNT 1 1 1", "COUNT 1 1 99999999"));
  refuse("fields.pcd", replaced(good, "FIELDS x y z", "FIELDS x y q"));
  refuse("huge.ply",
         "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000000\nproperty "
         "float x\nproperty float y\nproperty float z\nend_header\n1234");
  refuse("short.ply",
         "ply\nformat ascii 1.0\nelement vertex 4000\nproperty float x\nproperty float "
         "y\nproperty float z\nend_header\n1 2 3\n");
  refuse("no_vertices.ply", "ply\nformat ascii 1.0\nend_header\n");
  refuse("words.xyz", "1 2 3\nfour five six\n");
}

TEST(FitApp, CloudsWithoutAnObjectAreRefusedInOneSentence) {
  const Folder folder;
  const float nan = std::nanf("");
  const auto refuse = [&](const std::vector<Eigen::Vector3f>& points) {
    const std::string cloud = folder.write("cloud.pcd", pcdOf(points));
    for (const std::string decomposition : {"none", "prisms"})
      for (const std::string fit : {"paper", "full"})
        expectRefusal(folder, {cloud, "--decomposition", decomposition, "--fit", fit});
    expectRefusal(folder, {cloud, "--remove-plane"});
  };
  refuse(std::vector<Eigen::Vector3f>(500, Eigen::Vector3f(nan, nan, nan)));
  for (int n = 1; n <= 3; ++n)
    refuse(std::vector<Eigen::Vector3f>(n, Eigen::Vector3f(0.1f, 0.2f, 0.9f)));
  refuse(std::vector<Eigen::Vector3f>(500, Eigen::Vector3f(0.1f, 0.2f, 0.9f)));
  std::vector<Eigen::Vector3f> line, plane, far;
  for (int i = 0; i < 900; ++i) {
    line.push_back(Eigen::Vector3f(0.001f, 0.002f, 0.003f) * float(i));
    plane.emplace_back(0.01f * float(i % 30), 0.01f * float(i / 30), 1.0f);
    far.emplace_back(
        1e30f * float(i % 7), 1e30f * float(i % 11), -1e30f * float(i % 13));
  }
  refuse(line);
  refuse(plane);
  const std::string cloud = folder.write("far.pcd", pcdOf(far));
  expectRefusal(folder, {cloud});
}

TEST(FitApp, DevicesWithoutAnEndAreNoFiles) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"/dev/zero"},
        {"absent.pcd", "--config", "/dev/zero"}}) {
    const ProgramRun run = runProgram("pcl_sq_fit", arguments, "ulimit -v 2000000;");
    EXPECT_NE(run.code, 0);
    EXPECT_NE(run.err.find("is a device"), std::string::npos) << run.err;
  }
}

TEST(FitApp, APresetIsReadAsItIsTyped) {
  const Folder folder;
  for (const char* preset : {"best", "paper"}) {
    const ProgramRun run =
        runProgram("pcl_sq_fit", {folder / "absent.pcd", "--preset", preset});
    EXPECT_EQ(run.code, 1) << run.err;
    EXPECT_NE(run.err.find("absent.pcd"), std::string::npos) << run.err;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// What people really feed to the programs, up to the model.
#include "file_bytes.h"
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

// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/model_io.h"
#include "pcl_sq/object_surface_estimation.h"

#include "bottle_view.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** \brief The paper's chain. */
struct PaperEstimation : ObjectSurfaceEstimation<pcl::PointXYZ> {
  PaperEstimation() { setOptions(EstimationOptions::paper()); }
};

MultiSuperquadric estimate(PaperEstimation& estimation) {
  MultiSuperquadric model;
  EXPECT_TRUE(estimation.estimate(model)) << estimation.getReport().failure;
  return model;
}

std::string failureOf(const Cloud::Ptr& cloud,
                      const EstimationOptions& options = EstimationOptions::paper()) {
  PaperEstimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setOptions(options);
  MultiSuperquadric model = bottle();
  EXPECT_FALSE(estimation.estimate(model));
  EXPECT_TRUE(model.empty()) << "the output must be cleared";
  EXPECT_FALSE(estimation.getReport().failure.empty());
  return estimation.getReport().failure;
}

} // namespace

TEST(ObjectSurfaceEstimation, BottleBecomesBodyAndNeck) {
  const MultiSuperquadric truth = bottle();
  PaperEstimation estimation;
  estimation.setInputCloud(toCloud(visiblePoints(truth, 20000, 0.0005)));
  const MultiSuperquadric model = estimate(estimation);
  ASSERT_EQ(model.size(), 2u);
  const auto width = [](const Superquadric& s) {
    return 2.0 * s.support(Eigen::Vector3d::UnitX());
  };
  const bool first_is_body = width(model.parts[0]) > width(model.parts[1]);
  const Superquadric& body = model.parts[first_is_body ? 0 : 1];
  const Superquadric& neck = model.parts[first_is_body ? 1 : 0];
  EXPECT_NEAR(width(body), 0.07, 0.01);
  EXPECT_NEAR(width(neck), 0.026, 0.012);
}

TEST(ObjectSurfaceEstimation, SeveralPartsFitBetterThanOne) {
  const auto cloud = toCloud(visiblePoints(bottle(), 20000, 0.0005));
  PaperEstimation estimation;
  estimation.setInputCloud(cloud);
  const MultiSuperquadric several = estimate(estimation);
  EstimationOptions options = EstimationOptions::paper();
  options.decomposition = Decomposition::NONE;
  estimation.setOptions(options);
  const double distortion = estimation.getReport().distortion;
  const MultiSuperquadric single = estimate(estimation);
  EXPECT_EQ(single.size(), 1u);
  EXPECT_LT(distortion, estimation.getReport().distortion);
}

TEST(ObjectSurfaceEstimation, ResultIsTheSameToTheLastBitForAnyNumberOfThreads) {
  PaperEstimation estimation;
  estimation.setInputCloud(toCloud(visiblePoints(bottle(), 20000, 0.001)));
  std::string first;
  for (const unsigned threads : {1u, 2u, 3u, 8u, 0u}) {
    estimation.setNumberOfThreads(threads);
    ModelFile file;
    file.model = estimate(estimation);
    if (first.empty())
      first = toJson(file);
    EXPECT_EQ(toJson(file), first) << threads << " threads";
  }
}

TEST(ObjectSurfaceEstimation, UsesOnlyTheGivenIndicesAndReportsThemInTheCloud) {
  const auto object = toCloud(visiblePoints(bottle(), 8000));
  auto scene = pcl::make_shared<Cloud>();
  auto indices = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < object->size(); ++i) {
    scene->push_back(pcl::PointXYZ(5.0f, 5.0f, float(i))); // clutter in between
    indices->push_back(int(scene->size()));
    scene->push_back((*object)[i]);
  }
  PaperEstimation alone, within;
  alone.setInputCloud(object);
  within.setInputCloud(scene);
  within.setIndices(indices);
  ModelFile a, b;
  a.model = estimate(alone);
  b.model = estimate(within);
  EXPECT_EQ(toJson(a), toJson(b));
  for (const PartReport& part : within.getReport().parts)
    for (const auto index : part.indices.indices)
      EXPECT_EQ(index % 2, 1);
  EXPECT_FALSE(within.getReport().grasp_indices.empty());
  for (const auto index : within.getReport().grasp_indices)
    EXPECT_EQ(index % 2, 1);
}

TEST(ObjectSurfaceEstimation, PointOrderDoesNotMatterBeyondRounding) {
  Eigen::Matrix3Xd points = visiblePoints(bottle(), 8000, 0.001);
  PaperEstimation estimation;
  estimation.setInputCloud(toCloud(points));
  const MultiSuperquadric forward = estimate(estimation);
  estimation.setInputCloud(toCloud(points.rowwise().reverse()));
  const MultiSuperquadric backward = estimate(estimation);
  ASSERT_EQ(forward.size(), backward.size());
  for (std::size_t i = 0; i < forward.size(); ++i) {
    EXPECT_LT((forward.parts[i].semi_axes - backward.parts[i].semi_axes).norm(), 1e-9);
    EXPECT_NEAR(forward.parts[i].epsilon1, backward.parts[i].epsilon1, 1e-6);
  }
}

TEST(ObjectSurfaceEstimation, RegionLeavesOutWhatLiesOutside) {
  const auto cloud = toCloud(visiblePoints(bottle(), 8000));
  cloud->push_back(pcl::PointXYZ(0, 0, 3));
  PaperEstimation estimation;
  estimation.setInputCloud(cloud);
  RoiBox region;
  region.min = {-0.2, -0.3, 0.5};
  region.max = {0.3, 0.3, 1.2};
  estimation.setRegion(region);
  estimate(estimation);
  EXPECT_EQ(estimation.getReport().region_points, cloud->size() - 1);
  for (const PartReport& part : estimation.getReport().parts)
    EXPECT_TRUE(part.fit.ok());
}

TEST(ObjectSurfaceEstimation, ReportNamesEveryStageWithItsTime) {
  PaperEstimation estimation;
  estimation.setInputCloud(toCloud(visiblePoints(bottle(), 5000)));
  estimate(estimation);
  std::vector<std::string> names;
  for (const auto& [stage, ms] : estimation.getReport().timings_ms) {
    names.push_back(stage);
    EXPECT_GE(ms, 0.0);
  }
  const std::vector<std::string> expected = {
      "crop", "decompose", "fit", "evaluate", "grasp_points"};
  EXPECT_EQ(names, expected);
  EXPECT_EQ(estimation.getReport().prisms.size(), estimation.getReport().parts.size());
}

TEST(ObjectSurfaceEstimation, BadCloudsGiveAReasonAndNoModel) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  auto cloud = pcl::make_shared<Cloud>();
  failureOf(cloud);
  for (const int n : {1, 2, 3}) {
    cloud->assign(n, pcl::PointXYZ(0.1f * float(n), 0.2f, 1.0f));
    failureOf(cloud);
  }
  cloud->assign(1000, pcl::PointXYZ(nan, nan, nan));
  EXPECT_NE(failureOf(cloud).find("finite"), std::string::npos);
  cloud->assign(1000, pcl::PointXYZ(0.1f, 0.2f, 1.0f)); // identical points
  failureOf(cloud);
  for (int i = 0; i < 1000; ++i) // collinear
    (*cloud)[i] = pcl::PointXYZ(0.001f * float(i), 0.002f * float(i), 1.0f);
  failureOf(cloud);
  for (int i = 0; i < 1000; ++i) // coplanar
    (*cloud)[i] = pcl::PointXYZ(0.01f * float(i % 31), 0.01f * float(i / 31), 1.0f);
  EXPECT_NE(failureOf(cloud).find("volume"), std::string::npos);
}

TEST(ObjectSurfaceEstimation, HugeCoordinatesAndHugeGridsAreRefusedOrSurvived) {
  auto cloud = toCloud(visiblePoints(bottle(), 2000));
  EstimationOptions options = EstimationOptions::paper();
  options.voxels.rule = VoxelRule::DIVISIONS;
  options.voxels.divisions.setConstant(10000); // 1e12 voxels
  EXPECT_NE(failureOf(cloud, options).find("voxels"), std::string::npos);
  for (auto& p : *cloud)
    p.x *= 1e30f;
  PaperEstimation estimation;
  estimation.setInputCloud(cloud);
  MultiSuperquadric model;
  const bool found = estimation.estimate(model);
  EXPECT_EQ(found, !model.empty());
  for (const Superquadric& s : model.parts)
    EXPECT_TRUE(s.isValid());
}

TEST(ObjectSurfaceEstimation, InvalidOptionsAreRefusedAndTheOldOnesKept) {
  PaperEstimation estimation;
  EstimationOptions options = EstimationOptions::paper();
  options.grasp_threshold = -1.0;
  estimation.setOptions(options);
  EXPECT_EQ(estimation.getOptions().grasp_threshold, 0.05);
}

TEST(ObjectSurfaceEstimation, TellsItsStagesInOrder) {
  std::vector<std::pair<std::string, double>> told;
  EstimationOptions options = EstimationOptions::paper();
  options.progress = [&told](const std::string& stage, double share) {
    told.emplace_back(stage, share);
  };
  ObjectSurfaceEstimation<pcl::PointXYZ> estimation;
  estimation.setOptions(options);
  estimation.setInputCloud(toCloud(visiblePoints(bottle(), 5000, 0.0005)));
  MultiSuperquadric model;
  ASSERT_TRUE(estimation.estimate(model));
  std::vector<std::string> begun;
  double last = 0.0;
  for (const auto& [stage, share] : told) {
    if (share == 0.0) {
      begun.push_back(stage);
      last = 0.0;
    }
    EXPECT_EQ(stage, begun.back());
    EXPECT_GE(share, last);
    EXPECT_LE(share, 1.0);
    last = share;
  }
  std::vector<std::string> timed;
  for (const auto& [stage, ms] : estimation.getReport().timings_ms)
    timed.push_back(stage);
  EXPECT_EQ(begun, timed);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/model_io.h"
#include "pcl_sq/object_surface_estimation.h"

#include "view_scene.h"

#include <pcl/point_types.h>

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Estimation = ObjectSurfaceEstimation<pcl::PointXYZ>;

Cloud::Ptr organizedCloud(const ViewScene& scene) {
  auto cloud =
      pcl::make_shared<Cloud>(std::uint32_t(scene.width), std::uint32_t(scene.height));
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i].getVector3fMap() = scene.points.col(Eigen::Index(i));
  return cloud;
}

} // namespace

TEST(BestMode, OneViewOfACanOnATableGivesItsWholeBody) {
  const ViewScene scene = canScene();
  Estimation estimation;
  estimation.setInputCloud(organizedCloud(scene));
  EstimationOptions options = EstimationOptions::best();
  for (const bool with_mask : {true, false}) {
    options.view.mask = with_mask ? scene.mask : CellMask();
    estimation.setOptions(options);
    MultiSuperquadric model;
    ASSERT_TRUE(estimation.estimate(model)) << estimation.getReport().failure;
    const EstimationReport& report = estimation.getReport();
    ASSERT_EQ(model.size(), 1u);
    EXPECT_EQ(report.view.outline,
              with_mask ? OutlineSource::MASK : OutlineSource::DEPTH);
    EXPECT_EQ(report.parts[0].shape.shape, ShapeClass::ROTATIONAL);
    EXPECT_GT(report.parts[0].margin, 0.0);
    const double truth = scene.object.parts[0].volume();
    EXPECT_NEAR(model.parts[0].volume() / truth, 1.0, with_mask ? 0.06 : 0.15);
    EXPECT_FALSE(report.grasp_indices.empty());
  }
}

TEST(BestMode, StagesAreThoseOfThePaperButForWhatTheViewTells) {
  Estimation estimation;
  estimation.setInputCloud(organizedCloud(canScene()));
  estimation.setOptions(EstimationOptions::best());
  MultiSuperquadric model;
  ASSERT_TRUE(estimation.estimate(model));
  std::vector<std::string> names;
  for (const auto& [stage, ms] : estimation.getReport().timings_ms)
    names.push_back(stage);
  const std::vector<std::string> expected = {
      "crop", "observe", "fit", "evaluate", "grasp_points"};
  EXPECT_EQ(names, expected);
}

TEST(BestMode, ResultIsTheSameToTheLastBitForAnyNumberOfThreads) {
  const ViewScene scene = canScene();
  Estimation estimation;
  estimation.setInputCloud(organizedCloud(scene));
  EstimationOptions options = EstimationOptions::best();
  options.view.mask = scene.mask;
  estimation.setOptions(options);
  std::string first;
  for (const unsigned threads : {1u, 2u, 5u, 0u}) {
    estimation.setNumberOfThreads(threads);
    ModelFile file;
    ASSERT_TRUE(estimation.estimate(file.model));
    if (first.empty())
      first = toJson(file);
    EXPECT_EQ(toJson(file), first) << threads << " threads";
  }
}

TEST(BestMode, MaskOfAnotherSizeFailsWithASentence) {
  Estimation estimation;
  estimation.setInputCloud(organizedCloud(canScene()));
  EstimationOptions options = EstimationOptions::best();
  options.view.mask = CellMask(10, 10);
  estimation.setOptions(options);
  MultiSuperquadric model;
  EXPECT_FALSE(estimation.estimate(model));
  EXPECT_TRUE(model.empty());
  EXPECT_NE(estimation.getReport().failure.find("10 x 10"), std::string::npos);
}

TEST(BestMode, TableInFrontOfTheObjectIsLeftOutAndTheReportSaysSo) {
  const ViewScene scene = canScene();
  Estimation estimation;
  estimation.setInputCloud(organizedCloud(scene));
  EstimationOptions options = EstimationOptions::best();
  options.view.mask = scene.mask;
  options.view.table = scene.table;
  options.view.table->offset -= 0.4;
  estimation.setOptions(options);
  MultiSuperquadric model;
  ASSERT_TRUE(estimation.estimate(model)) << estimation.getReport().failure;
  ASSERT_FALSE(estimation.getReport().view.notes.empty());
  EXPECT_NE(estimation.getReport().view.notes.back().find("left out"),
            std::string::npos);
  EXPECT_NEAR(model.parts[0].volume() / scene.object.parts[0].volume(), 1.0, 0.15);
}

TEST(BestMode, PointsThatAreNoSurfaceAreRefused) {
  Random random(12);
  auto cloud = pcl::make_shared<Cloud>();
  for (int i = 0; i < 1500; ++i)
    cloud->emplace_back(static_cast<float>(random.normal(0.05)),
                        static_cast<float>(random.normal(0.04)),
                        static_cast<float>(0.8 + random.normal(0.06)));
  Estimation estimation;
  estimation.setInputCloud(cloud);
  EstimationOptions options;
  options.object_fit.max_parts = 1;
  estimation.setOptions(options);
  MultiSuperquadric model;
  EXPECT_FALSE(estimation.estimate(model));
  EXPECT_TRUE(model.empty());
  EXPECT_NE(estimation.getReport().failure.find("too far"), std::string::npos)
      << estimation.getReport().failure;
  // a number that is asked for is made
  options.object_fit.parts = 1;
  estimation.setOptions(options);
  EXPECT_TRUE(estimation.estimate(model));
}

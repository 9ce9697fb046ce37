// SPDX-License-Identifier: BSD-3-Clause
// "Exactly these points" and "look in here", as the table of ObjectSurfaceEstimation
// has it; and the one default of class and programs.
#include "pcl_sq/object_surface_estimation.h"

#include "clouds.h"
#include "view_scene.h"

#include <gtest/gtest.h>

#include <pcl/point_types.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Estimation = ObjectSurfaceEstimation<pcl::PointXYZ>;

/** \brief A can on a table, as a camera sees it. */
const ViewScene& scene() {
  static const ViewScene instance = [] {
    ViewScene s;
    s.addUpright({0.04, 0.04, 0.07}, 0.2, 1.0, 0.07);
    s.render(0.001);
    return s;
  }();
  return instance;
}

Cloud::Ptr image() {
  return organized(scene().points, scene().width, scene().height);
}

pcl::IndicesPtr underMask() {
  auto indices = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < scene().mask.cells.size(); ++i)
    if (scene().mask.cells[i])
      indices->push_back(int(i));
  return indices;
}

/** \brief A box around the can that holds some of the table, too. */
RoiBox around() {
  RoiBox box;
  const Eigen::AlignedBox3d can = scene().object.boundingBox();
  box.min = can.min().array() - 0.02;
  box.max = can.max().array() + 0.02;
  return box;
}

EstimationReport estimate(Estimation& estimation) {
  // the choice is looked at: one part is quicker than as many as the data ask for
  EstimationOptions options = estimation.getOptions();
  options.object_fit.parts = 1;
  options.object_fit.fit.starts = 1;
  options.object_fit.fit.choose_shape = false;
  estimation.setOptions(options);
  MultiSuperquadric model;
  EXPECT_TRUE(estimation.estimate(model)) << estimation.getReport().failure;
  return estimation.getReport();
}

/** \brief Share of the points taken for the object that are the can's. */
double shareOfTheCan(const EstimationReport& report) {
  const auto own = std::count_if(
      report.object_indices.begin(), report.object_indices.end(), [](int index) {
        return scene().mask.cells[std::size_t(index)] != 0;
      });
  return double(own) / double(report.object_indices.size());
}

} // namespace

TEST(ObjectChoice, NothingSaidTheThingOnTheTableIsLookedFor) {
  Estimation estimation;
  estimation.setInputCloud(image());
  const EstimationReport report = estimate(estimation);
  EXPECT_GT(shareOfTheCan(report), 0.95);
  EXPECT_GT(double(report.object_indices.size()), 0.8 * double(underMask()->size()));
}

TEST(ObjectChoice, IndicesAreExactlyTheObject) {
  Estimation estimation;
  estimation.setInputCloud(image());
  estimation.setIndices(underMask());
  const EstimationReport report = estimate(estimation);
  EXPECT_GT(shareOfTheCan(report), 0.99);
  EXPECT_EQ(report.view.pixels.count(), int(underMask()->size()));
}

TEST(ObjectChoice, IndicesOfTheWholeCloudMakeTheWholeCloudTheObject) {
  const auto cloud = image();
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setIndices(allIndices(cloud->size()));
  const EstimationReport report = estimate(estimation);
  EXPECT_EQ(report.view.pixels.count(), int(cloud->size()))
      << "table and can were given as one object";
}

TEST(ObjectChoice, ABoxIsLookedInForTheThingThatItWasDrawnAround) {
  Estimation estimation;
  estimation.setInputCloud(image());
  estimation.setRegion(around());
  const EstimationReport report = estimate(estimation);
  EXPECT_GT(shareOfTheCan(report), 0.95) << "the table's points in the box are not its";
}

TEST(ObjectChoice, WithABoxIndicesSayWhereToLookAndTheBoxTakenBackWhatItIs) {
  const auto cloud = image();
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setIndices(allIndices(cloud->size()));
  estimation.setRegion(around());
  EXPECT_GT(shareOfTheCan(estimate(estimation)), 0.95);
  estimation.unsetRegion();
  EXPECT_LT(shareOfTheCan(estimate(estimation)), 0.5);
}

TEST(ObjectChoice, AMaskIsExactlyTheObject) {
  Estimation estimation;
  estimation.setInputCloud(image());
  EstimationOptions options;
  options.view.mask = scene().mask;
  estimation.setOptions(options);
  const EstimationReport report = estimate(estimation);
  EXPECT_GT(shareOfTheCan(report), 0.99);
  EXPECT_EQ(report.view.pixels.count(), scene().mask.count());
}

TEST(ObjectChoice, OfABareCloudAllPointsAreTheObjectWithAndWithoutIndices) {
  Eigen::Matrix3Xf points(3, Eigen::Index(underMask()->size()));
  for (std::size_t i = 0; i < underMask()->size(); ++i)
    points.col(Eigen::Index(i)) = scene().points.col((*underMask())[i]);
  const auto cloud = organized(points, int(points.cols()), 1);
  Estimation without, with;
  without.setInputCloud(cloud);
  with.setInputCloud(cloud);
  with.setIndices(allIndices(cloud->size()));
  EXPECT_EQ(estimate(without).object_indices.size(), cloud->size());
  EXPECT_EQ(estimate(with).object_indices, estimate(without).object_indices);
}

TEST(EstimationOptionsDefault, IsTheBestModeEverywhere) {
  for (const EstimationOptions& options :
       {EstimationOptions(), EstimationOptions::best(), Estimation().getOptions()}) {
    EXPECT_EQ(options.decomposition, Decomposition::PARTS);
    EXPECT_EQ(options.fit, FitMode::FULL);
    EXPECT_TRUE(options.isValid());
  }
  EXPECT_EQ(EstimationOptions::paper().decomposition, Decomposition::PRISMS);
  EXPECT_EQ(EstimationOptions::paper().fit, FitMode::PAPER);
}

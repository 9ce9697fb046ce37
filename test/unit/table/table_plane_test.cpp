// SPDX-License-Identifier: BSD-3-Clause
// Planes of PCL and of the library are one thing but for their sign and length.
#include "pcl_sq/object_view.h"
#include "pcl_sq/table_plane.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

#include <pcl/ModelCoefficients.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A plane that has the origin on its positive side. */
TablePlane tilted() {
  TablePlane plane;
  plane.normal = Eigen::Vector3d(0.0, -0.8, -0.6);
  plane.offset = 0.7;
  return plane;
}

void expectSame(const std::optional<TablePlane>& a, const TablePlane& b) {
  ASSERT_TRUE(a);
  EXPECT_LT((a->normal - b.normal).norm(), 1e-6);
  EXPECT_NEAR(a->offset, b.offset, 1e-6);
}

} // namespace

TEST(TablePlane, GoesToModelCoefficientsAndBack) {
  pcl::ModelCoefficients coefficients;
  coefficients.values = tilted().toCoefficients();
  ASSERT_EQ(coefficients.values.size(), 4u);
  EXPECT_FLOAT_EQ(coefficients.values[1], -0.8f);
  EXPECT_FLOAT_EQ(coefficients.values[3], 0.7f);
  expectSame(TablePlane::fromCoefficients(coefficients.values), tilted());
}

TEST(TablePlane, IsTheSameForCoefficientsOfAnySignAndLength) {
  for (const float factor : {1.0f, -1.0f, 25.0f, -0.01f}) {
    std::vector<float> values = tilted().toCoefficients();
    for (float& v : values)
      v *= factor;
    expectSame(TablePlane::fromCoefficients(values), tilted());
  }
}

TEST(TablePlane, TurnsToTheSideOfTheViewpoint) {
  const Eigen::Vector3d below = -3.0 * tilted().normal;
  const auto plane = TablePlane::fromCoefficients(tilted().toCoefficients(), below);
  ASSERT_TRUE(plane);
  EXPECT_LT((plane->normal + tilted().normal).norm(), 1e-6);
  EXPECT_GT(plane->signedDistance(below), 0.0);
}

TEST(TablePlane, KeepsItsSignWhereTheViewpointLiesOnIt) {
  const auto plane =
      TablePlane::fromCoefficients(std::vector<float>{0.0f, 0.0f, -2.0f, 0.0f});
  ASSERT_TRUE(plane);
  EXPECT_EQ(plane->normal.z(), -1.0);
}

TEST(TablePlane, RefusesWhatIsNoPlane) {
  const float nan = std::nanf("");
  for (const std::vector<float>& values :
       std::vector<std::vector<float>>{{},
                                       {0, 0, 1},
                                       {0, 0, 0, 1},
                                       {0, 0, 1, nan},
                                       {nan, 0, 1, 0},
                                       {0, 0, 1, 0, 0}})
    EXPECT_FALSE(TablePlane::fromCoefficients(values));
}

TEST(TablePlane, TakesThePlaneOfPclsSampleConsensusWhateverItsSign) {
  Random random(3);
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  const Eigen::Vector3d along = tilted().normal.cross(Eigen::Vector3d::UnitX());
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p = -tilted().offset * tilted().normal +
                              random.uniform(-0.5, 0.5) * Eigen::Vector3d::UnitX() +
                              random.uniform(-0.5, 0.5) * along;
    cloud->push_back(pcl::PointXYZ(float(p.x()), float(p.y()), float(p.z())));
  }
  pcl::SampleConsensusModelPlane<pcl::PointXYZ>::Ptr model(
      new pcl::SampleConsensusModelPlane<pcl::PointXYZ>(cloud));
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, 0.001);
  ASSERT_TRUE(ransac.computeModel());
  Eigen::VectorXf coefficients;
  ransac.getModelCoefficients(coefficients);
  for (const float sign : {1.0f, -1.0f}) {
    const auto plane =
        TablePlane::fromCoefficients(Eigen::VectorXf(sign * coefficients));
    ASSERT_TRUE(plane);
    EXPECT_LT((plane->normal - tilted().normal).norm(), 1e-4);
    EXPECT_NEAR(plane->offset, tilted().offset, 1e-4);
  }
}

TEST(TablePlane, IsWhatTheViewsTableIsMadeOf) {
  ViewOptions view;
  view.table = TableModel{tilted()};
  EXPECT_TRUE(view.isValid());
  EXPECT_NEAR(view.table->height(Eigen::Vector3d::Zero()), 0.7, 1e-12);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/sac_model_superquadric.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

#include <pcl/point_types.h>
#include <pcl/sample_consensus/msac.h>
#include <pcl/sample_consensus/ransac.h>

using pcl::PointXYZ;
using pcl_sq::SampleConsensusModelSuperquadric;
using pcl_sq::Superquadric;
using pcl_sq::test::Random;

namespace {

using Cloud = pcl::PointCloud<PointXYZ>;
using Model = SampleConsensusModelSuperquadric<PointXYZ>;

/** \brief Opens what RANSAC calls. */
struct OpenModel : Model {
  using Model::error_sqr_dists_;
  using Model::isModelValid;
  using Model::isSampleGood;
  using Model::Model;
};

constexpr double NOISE = 0.0005;

Superquadric can() {
  Superquadric s;
  s.center = {0.1, -0.05, 0.8};
  s.rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  s.semi_axes = {0.03, 0.045, 0.07};
  s.epsilon1 = 0.3;
  s.epsilon2 = 0.8;
  return s;
}

PointXYZ toPcl(const Eigen::Vector3d& p) {
  return {float(p.x()), float(p.y()), float(p.z())};
}

/** \brief \a count points of which the share \a clutter lies anywhere around. */
Cloud::Ptr scene(const Superquadric& s, int count, double clutter) {
  Random random(7);
  Cloud::Ptr cloud(new Cloud);
  for (int i = 0; i < count; ++i)
    if (i < clutter * count)
      cloud->push_back(toPcl(s.center + 0.2 * Eigen::Vector3d(random.uniform(-1, 1),
                                                              random.uniform(-1, 1),
                                                              random.uniform(-1, 1))));
    else
      // alike in all directions: the distances are Gaussian then, as refineModel()
      // takes them to be when it makes a deviation of their median
      cloud->push_back(toPcl(
          random.surfacePoint(s) +
          NOISE * Eigen::Vector3d(random.normal(), random.normal(), random.normal())));
  return cloud;
}

Eigen::VectorXf coefficientsOf(const Superquadric& s) {
  return s.toCoefficients().cast<float>();
}

double largestDeviation(const Superquadric& a, const Superquadric& b) {
  Random random(1);
  double largest = 0.0;
  for (int i = 0; i < 200; ++i)
    largest = std::max(largest, std::abs(a.footPointDistance(random.surfacePoint(b))));
  return largest;
}

} // namespace

TEST(SampleConsensusModelSuperquadric, RansacFindsItInClutter) {
  for (const double clutter : {0.17, 0.4})
    for (const int threads : {-1, 2}) {
      Model::Ptr model(new Model(scene(can(), 1500, clutter)));
      pcl::RandomSampleConsensus<PointXYZ> ransac(model, 0.002);
      ransac.setMaxIterations(200); // of 30 points, 12 are clutter on average
      ransac.setNumberOfThreads(threads);
      ASSERT_TRUE(ransac.computeModel());
      ransac.refineModel();
      pcl::Indices inliers;
      ransac.getInliers(inliers);
      // refineModel() tightens the threshold to three deviations: 99.7 % of the surface
      EXPECT_GT(inliers.size(), 0.98 * (1.0 - clutter) * 1500);
      Eigen::VectorXf coefficients;
      ransac.getModelCoefficients(coefficients);
      EXPECT_LT(largestDeviation(Superquadric::fromCoefficients(coefficients), can()),
                0.002);
    }
}

TEST(SampleConsensusModelSuperquadric, MsacFindsItInClutter) {
  for (const double clutter : {0.17, 0.4}) {
    Model::Ptr model(new Model(scene(can(), 1500, clutter)));
    pcl::MEstimatorSampleConsensus<PointXYZ> msac(model, 0.002);
    msac.setMaxIterations(200);
    ASSERT_TRUE(msac.computeModel());
    msac.refineModel();
    pcl::Indices inliers;
    msac.getInliers(inliers);
    EXPECT_GT(inliers.size(), 0.98 * (1.0 - clutter) * 1500);
    Eigen::VectorXf coefficients;
    msac.getModelCoefficients(coefficients);
    EXPECT_LT(largestDeviation(Superquadric::fromCoefficients(coefficients), can()),
              0.002);
  }
}

TEST(SampleConsensusModelSuperquadric, UsesOnlyTheIndicesItIsGiven) {
  // the clutter stands first and is left out by the indices
  const Cloud::Ptr cloud = scene(can(), 1000, 0.5);
  pcl::Indices indices;
  for (pcl::index_t i = 500; i < 1000; i += 2)
    indices.push_back(i);
  OpenModel model(cloud, indices);
  const Eigen::VectorXf truth = coefficientsOf(can());
  std::vector<double> distances;
  model.getDistancesToModel(truth, distances);
  ASSERT_EQ(distances.size(), indices.size());
  for (const double d : distances)
    EXPECT_LT(d, 6.0 * NOISE);
  EXPECT_EQ(model.countWithinDistance(truth, 6.0 * NOISE), indices.size());
  pcl::Indices inliers;
  model.selectWithinDistance(truth, NOISE, inliers);
  EXPECT_EQ(inliers.size(), model.countWithinDistance(truth, NOISE));
  EXPECT_LT(inliers.size(), indices.size());
  ASSERT_EQ(model.error_sqr_dists_.size(), inliers.size());
  for (std::size_t i = 0; i < inliers.size(); ++i) {
    EXPECT_GE(inliers[i], 500);
    const Eigen::Vector3d p =
        (*cloud)[std::size_t(inliers[i])].getVector3fMap().cast<double>();
    const double d = Superquadric::fromCoefficients(truth).footPointDistance(p);
    EXPECT_NEAR(model.error_sqr_dists_[i], d * d, 1e-9);
  }
}

TEST(SampleConsensusModelSuperquadric, InliersOfRansacAreIndicesIntoTheCloud) {
  const Cloud::Ptr cloud = scene(can(), 900, 1.0 / 3.0);
  pcl::Indices indices;
  for (pcl::index_t i = 100; i < 900; ++i)
    indices.push_back(i);
  Model::Ptr model(new Model(cloud, indices));
  pcl::RandomSampleConsensus<PointXYZ> ransac(model, 0.002);
  ransac.setMaxIterations(30);
  ASSERT_TRUE(ransac.computeModel());
  pcl::Indices inliers;
  ransac.getInliers(inliers);
  std::size_t of_the_can = 0;
  for (const auto i : inliers)
    of_the_can += i >= 300;
  EXPECT_GT(double(of_the_can), 0.9 * double(inliers.size()));
}

TEST(SampleConsensusModelSuperquadric, OptimizesWithInputAndOutputInOneVector) {
  const Cloud::Ptr cloud = scene(can(), 800, 0.0);
  const Model model(cloud);
  Superquadric start = can();
  start.semi_axes *= 1.1;
  start.center.x() += 0.004;
  const Eigen::VectorXf initial = coefficientsOf(start);
  Eigen::VectorXf apart, same = initial;
  model.optimizeModelCoefficients(*model.getIndices(), initial, apart);
  model.optimizeModelCoefficients(*model.getIndices(), same, same);
  EXPECT_EQ(apart, same);
  EXPECT_LT(largestDeviation(Superquadric::fromCoefficients(same), can()), 2.0 * NOISE);
}

TEST(SampleConsensusModelSuperquadric, ProjectsOntoTheSurface) {
  const Cloud::Ptr cloud = scene(can(), 100, 0.0);
  const Model model(cloud);
  const pcl::Indices inliers = {3, 50, 97};
  Cloud all, few;
  model.projectPoints(inliers, coefficientsOf(can()), all, true);
  model.projectPoints(inliers, coefficientsOf(can()), few, false);
  ASSERT_EQ(all.size(), cloud->size());
  ASSERT_EQ(few.size(), inliers.size());
  EXPECT_EQ(all[0].x, (*cloud)[0].x);
  for (std::size_t i = 0; i < inliers.size(); ++i) {
    EXPECT_EQ(few[i].x, all[std::size_t(inliers[i])].x);
    EXPECT_NEAR(can().gauge(few[i].getVector3fMap().cast<double>()), 1.0, 1e-4);
  }
}

TEST(SampleConsensusModelSuperquadric, VerifiesSamples) {
  const Model model(scene(can(), 100, 0.1));
  const Eigen::VectorXf truth = coefficientsOf(can());
  EXPECT_TRUE(model.doSamplesVerifyModel({20, 21, 99}, truth, 6.0 * NOISE));
  EXPECT_FALSE(model.doSamplesVerifyModel({20, 0, 1, 2, 3}, truth, 6.0 * NOISE));
}

TEST(SampleConsensusModelSuperquadric, RejectsModelsOutsideTheLimits) {
  OpenModel model(scene(can(), 100, 0.0));
  const Eigen::VectorXf truth = coefficientsOf(can());
  EXPECT_TRUE(model.isModelValid(truth));
  model.setRadiusLimits(0.01, 0.05); // a3 is 0.07
  EXPECT_FALSE(model.isModelValid(truth));
  EXPECT_EQ(model.countWithinDistance(truth, 1.0), 0U);
  model.setRadiusLimits(0.01, 0.1);
  EXPECT_TRUE(model.isModelValid(truth));
  model.setAxis(can().rotation.col(2).cast<float>() * -2.0F);
  model.setEpsAngle(0.05);
  EXPECT_TRUE(model.isModelValid(truth));
  model.setAxis(can().rotation.col(0).cast<float>());
  EXPECT_FALSE(model.isModelValid(truth));
  model.setAxis(Eigen::Vector3f::Zero());
  model.setModelConstraints([](const Eigen::VectorXf& c) { return c[9] > 0.5F; });
  EXPECT_FALSE(model.isModelValid(truth)); // its epsilon1 is 0.3
  EXPECT_FALSE(model.isModelValid(Eigen::VectorXf::Ones(7)));
  EXPECT_FALSE(model.isModelValid(Eigen::VectorXf::Constant(11, NAN)));
}

TEST(SampleConsensusModelSuperquadric, MsacEndsWhenEveryModelIsRejected) {
  Model::Ptr model(new Model(scene(can(), 200, 0.0)));
  model->setModelConstraints([](const Eigen::VectorXf&) { return false; });
  pcl::MEstimatorSampleConsensus<PointXYZ> msac(model, 0.002);
  msac.setMaxIterations(5);
  EXPECT_FALSE(msac.computeModel());
}

TEST(SampleConsensusModelSuperquadric, SamplesInAPlaneAreNotGood) {
  Cloud::Ptr cloud(new Cloud);
  Random random(3);
  for (int i = 0; i < 40; ++i)
    cloud->push_back({float(random.normal()), float(random.normal()), 0.5F});
  const OpenModel model(cloud, 12);
  pcl::Indices samples;
  for (pcl::index_t i = 0; i < 12; ++i)
    samples.push_back(i);
  EXPECT_FALSE(model.isSampleGood(samples));
}

TEST(SampleConsensusModelSuperquadric, PointsThatAreNoneAreNeverInliers) {
  const Cloud::Ptr cloud = scene(can(), 100, 0.0);
  (*cloud)[10].y = NAN;
  const Model model(cloud);
  EXPECT_EQ(model.countWithinDistance(coefficientsOf(can()), 1.0), 99U);
}

TEST(SampleConsensusModelSuperquadric, NamesItself) {
  const Model model(scene(can(), 100, 0.0), 20);
  EXPECT_EQ(model.getClassName(), "SampleConsensusModelSuperquadric");
  EXPECT_EQ(model.getSampleSize(), 20U);
  EXPECT_EQ(model.getModelSize(), 11U);
  EXPECT_EQ(static_cast<int>(model.getModelType()), 31);
}

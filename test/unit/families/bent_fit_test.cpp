// SPDX-License-Identifier: BSD-3-Clause
// Bent rods seen once and from all round: bananas.
#include "families/families.h"
#include "pcl_sq/view_fit.h"

#include "fit_scene.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief Adds a rod of radius .016 that lies on the table. */
Superquadric& addRod(ViewScene& scene, double bend) {
  scene.addUpright({0.016, 0.016, 0.09}, 0.4, 1.0, 0.016);
  Superquadric& s = scene.object.parts.back();
  s.rotation *= Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  s.bend = bend;
  return s;
}

/** \brief One bent part; the direction of its axis and of the bend may be the opposite
 * ones. */
void expectRod(const MultiSuperquadric& model, const Superquadric& rod) {
  ASSERT_EQ(model.size(), 1u) << rod.bend;
  const Superquadric& found = model.parts[0];
  ASSERT_TRUE(found.isBent()) << rod.bend;
  EXPECT_NEAR(std::abs(found.bend), std::abs(rod.bend), 0.1 * std::abs(rod.bend));
  const double angle = 2.0 * rod.semi_axes.z() * std::abs(rod.bend);
  EXPECT_NEAR(2.0 * found.semi_axes.z() * std::abs(found.bend), angle, 0.1 * angle);
  EXPECT_NEAR(
      std::sqrt(found.semi_axes.x() * found.semi_axes.y()), rod.semi_axes.x(), 0.002);
  MultiSuperquadric truth;
  truth.parts.push_back(rod);
  EXPECT_GT(overlap(model, truth), 0.85) << rod.bend;
}

} // namespace

TEST(BentFit, StraightRodStaysStraight) {
  ViewScene scene = finerScene();
  addRod(scene, 0.0);
  scene.render(0.001);
  const ObjectFit fit = fitScene(scene);
  ASSERT_EQ(fit.model.size(), 1u);
  EXPECT_FALSE(fit.model.parts[0].isBent());
}

TEST(BentFit, RodWhoseInsideIsSeenIsOneBentPartOfItsAngleAndRadius) {
  // seen from its outside alone, a straight body explains it as well
  for (const double bend : {-6.0, -7.0, -9.0}) {
    ViewScene scene = finerScene();
    const Superquadric rod = addRod(scene, bend);
    scene.render(0.001);
    ViewOptions view;
    view.mask = scene.mask;
    view.camera = scene.camera;
    view.correlation = 1.0; // the pixels err on their own here
    ObservedObject observed;
    ASSERT_TRUE(
        observeObject(scene.points, scene.width, scene.height, {}, view, observed));
    expectRod(fitObject(observed).model, rod);
  }
}

TEST(BentFit, RodSeenFromAllRoundIsOneBentPartOfItsAngleAndRadius) {
  for (const double bend : {5.0, 8.0, 12.0}) {
    ViewScene scene = finerScene();
    const Superquadric rod = addRod(scene, bend);
    Random random(7);
    std::vector<Eigen::Vector3d> surface = sampleUniform(rod, 3000, 7);
    Eigen::Matrix3Xf points(3, Eigen::Index(surface.size()));
    for (std::size_t i = 0; i < surface.size(); ++i)
      points.col(Eigen::Index(i)) =
          (surface[i] +
           0.001 * Eigen::Vector3d(random.normal(), random.normal(), random.normal()))
              .cast<float>();
    ViewOptions view;
    view.coverage = Coverage::COMPLETE;
    ObservedObject observed;
    ASSERT_TRUE(observeObject(points, int(points.cols()), 1, {}, view, observed));
    expectRod(fitObject(observed).model, rod);
  }
}

TEST(BentFit, ABlockThatFillsTheBendDoesNotKeepARodFromBeingTried) {
  ViewScene scene = finerScene();
  const Superquadric rod = addRod(scene, 8.0);
  const std::vector<Eigen::Vector3d> surface = sampleUniform(rod, 1500, 7);
  Eigen::Matrix3Xd points(3, Eigen::Index(surface.size()));
  for (std::size_t i = 0; i < surface.size(); ++i)
    points.col(Eigen::Index(i)) = surface[i];
  detail::ViewProblem problem;
  ASSERT_TRUE(problem.prepare(points, {}, {}));
  ShapeCandidate block; // as near to the points as the noise allows
  block.cost = 0.0;
  block.model.semi_axes = {0.016, 0.05, 0.08};
  block.model.center = points.rowwise().mean();
  block.model.rotation = rod.rotation;
  block.model = problem.frame().toUnit(block.model);
  constexpr double SIGMA = 0.02; // of the unit frame, some millimetre
  EXPECT_FALSE(detail::fitBent(
      problem, SIGMA, {block}, [](const Superquadric&) { return 0.0; }));
  const auto filled = [&](const Superquadric& body) {
    return body.isBent() ? 0.0 : 1e3 * double(points.cols());
  };
  const auto bent = detail::fitBent(problem, SIGMA, {block}, filled);
  ASSERT_TRUE(bent);
  MultiSuperquadric model;
  model.parts.push_back(problem.frame().toCloud(bent->model));
  expectRod(model, rod);
}

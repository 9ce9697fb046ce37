// SPDX-License-Identifier: BSD-3-Clause
// Parts of an object that a camera sees on its table.
#include "fit_scene.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief A camera with more pixels, for objects with thin parts. */
ViewScene fineScene(int times = 1) {
  ViewScene scene;
  scene.width = times * 240;
  scene.height = times * 180;
  scene.camera.fx = scene.camera.fy = times * 450.0;
  scene.camera.cx = 0.5 * (scene.width - 1);
  scene.camera.cy = 0.5 * (scene.height - 1);
  return scene;
}

ViewScene bottleScene() {
  ViewScene scene = fineScene();
  scene.addUpright({0.035, 0.035, 0.06}, 0.2, 1.0, 0.06);
  scene.addUpright({0.013, 0.013, 0.03}, 0.2, 1.0, 0.14);
  scene.render(0.001);
  return scene;
}

/** \brief A cup with its handle beside it, of three rods. */
ViewScene cupScene() {
  ViewScene scene = fineScene(2);
  const auto add = [&](const Eigen::Vector3d& semi_axes, double aside, double height) {
    scene.addUpright(semi_axes, 0.3, 1.0, height);
    scene.object.parts.back().center += aside * scene.upright().col(0);
  };
  add({0.04, 0.04, 0.05}, 0.0, 0.05);
  add({0.006, 0.006, 0.028}, 0.066, 0.05);
  add({0.016, 0.006, 0.006}, 0.054, 0.075);
  add({0.016, 0.006, 0.006}, 0.054, 0.025);
  scene.render(0.001);
  return scene;
}

} // namespace

TEST(FitObject, PlainCanStaysOnePart) {
  ViewScene scene;
  scene.addUpright({0.04, 0.04, 0.07}, 0.2, 1.0, 0.07);
  scene.render(0.001);
  const ObjectFit fit = fitScene(scene);
  ASSERT_EQ(fit.model.size(), 1u);
  EXPECT_EQ(fit.parts[0].chosen.shape, ShapeClass::ROTATIONAL);
  EXPECT_GT(overlap(fit.model, scene.object), 0.93);
}

TEST(FitObject, BottleBecomesBodyAndNeckOnOneAxis) {
  const ViewScene scene = bottleScene();
  const ObjectFit fit = fitScene(scene);
  ASSERT_EQ(fit.model.size(), 2u);
  EXPECT_GT(overlap(fit.model, scene.object), 0.9);
  for (const ViewFit& part : fit.parts)
    EXPECT_EQ(part.chosen.shape, ShapeClass::ROTATIONAL);
  const Eigen::Vector3d axis = fit.model.parts[0].rotation.col(2);
  const Eigen::Vector3d apart = fit.model.parts[1].center - fit.model.parts[0].center;
  EXPECT_LT(apart.cross(axis).norm(), 0.004);
}

TEST(FitObject, CupWhoseHandleLeavesAGapBecomesABodyAndThreeRods) {
  const ViewScene scene = cupScene();
  const ObjectFit fit = fitScene(scene);
  ASSERT_EQ(fit.model.size(), 4u);
  EXPECT_GT(overlap(fit.model, scene.object), 0.88);
  const Superquadric& rod = scene.object.parts[1];
  EXPECT_TRUE(fit.model.contains(rod.center));
  const Eigen::Vector3d between =
      scene.object.parts[0].center + 0.05 * scene.upright().col(0);
  EXPECT_FALSE(fit.model.contains(between));
}

TEST(FitObject, GapIsOpenedOnlyWhereTheBackgroundShowsAndFourPartsAreAllowed) {
  ObjectFitOptions options;
  options.max_parts = 3;
  EXPECT_LE(fitScene(cupScene(), options).model.size(), 3u);
  const auto hole = [&](bool through) {
    ViewScene scene = bottleScene();
    Eigen::Vector2d middle = scene.camera.project(scene.object.parts[0].center);
    for (int y = -4; y <= 4; ++y)
      for (int x = -4; x <= 4; ++x) {
        const int at = (int(middle.y()) + y) * scene.width + int(middle.x()) + x;
        scene.mask.cells[std::size_t(at)] = 0;
        if (through)
          scene.points.col(at) *= 2.0f;
      }
    ViewOptions view;
    view.mask = scene.mask;
    view.camera = scene.camera;
    ObservedObject observed;
    EXPECT_TRUE(
        observeObject(scene.points, scene.width, scene.height, {}, view, observed));
    return observed.gap.size();
  };
  EXPECT_EQ(hole(false), 0u);
  EXPECT_EQ(hole(true), 81u);
}

TEST(FitObject, MisfitOfAllFamiliesIsNoEvidenceForOne) {
  ObjectFitOptions options;
  options.max_parts = 1;
  // BIC over cost between families of as many parameters: 1, and less where none fits;
  // but a taper and a vessel have prior odds against them
  const auto worthOf = [](const ViewFit& fit) {
    std::vector<double> worth;
    for (const ShapeCandidate& a : fit.candidates)
      for (const ShapeCandidate& b : fit.candidates)
        if (a.parameters == b.parameters && a.cost > b.cost + 1.0 &&
            a.shape < ShapeClass::TAPERED && b.shape < ShapeClass::TAPERED)
          worth.push_back((a.bic - b.bic) / (a.cost - b.cost));
    return worth;
  };
  ViewScene can;
  can.addUpright({0.04, 0.04, 0.07}, 0.2, 1.0, 0.07);
  can.render(0.001);
  const std::vector<double> plain = worthOf(fitScene(can, options).parts[0]);
  ASSERT_FALSE(plain.empty());
  for (const double w : plain)
    EXPECT_NEAR(w, 1.0, 1e-9);
  const ViewFit bottle = fitScene(bottleScene(), options).parts[0];
  const std::vector<double> misfit = worthOf(bottle);
  ASSERT_FALSE(misfit.empty());
  for (const double w : misfit) {
    EXPECT_LT(w, 0.9);
    EXPECT_NEAR(w, misfit.front(), 1e-9);
  }
}

TEST(FitObject, OneSuperquadricIsGivenWhereOnlyOneIsAllowed) {
  ObjectFitOptions options;
  options.max_parts = 1;
  const ViewScene scene = bottleScene();
  const ObjectFit single = fitScene(scene, options);
  ASSERT_EQ(single.model.size(), 1u);
  EXPECT_LT(overlap(single.model, scene.object),
            overlap(fitScene(scene).model, scene.object));
}

TEST(FitObject, RodSeenFromTheSideIsNoPlateSeenEdgeOn) {
  ViewScene scene = fineScene();
  scene.addUpright({0.012, 0.012, 0.1}, 0.3, 1.0, 0.1);
  scene.render(0.001);
  ViewOptions view;
  view.mask = scene.mask;
  view.camera = scene.camera;
  view.find_table = false; // which would tell as well
  ObservedObject observed;
  ASSERT_TRUE(
      observeObject(scene.points, scene.width, scene.height, {}, view, observed));
  const ObjectFit fit = fitObject(observed);
  ASSERT_EQ(fit.model.size(), 1u);
  const Superquadric& rod = fit.model.parts[0];
  EXPECT_LT(rod.support((rod.center - observed.camera.center).normalized()), 0.06);
}

TEST(FitObject, LabelsSayWhichPartEachPointBelongsTo) {
  ViewOptions view;
  const ViewScene scene = bottleScene();
  view.mask = scene.mask;
  ObservedObject observed;
  ASSERT_TRUE(
      observeObject(scene.points, scene.width, scene.height, {}, view, observed));
  const ObjectFit fit = fitObject(observed);
  ASSERT_EQ(fit.labels.size(), std::size_t(observed.points.cols()));
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < fit.labels.size(); ++i) {
    ASSERT_GE(fit.labels[i], 0);
    ASSERT_LT(fit.labels[i], int(fit.model.size()));
    const auto distance = [&](int part) {
      return std::abs(fit.model.parts[std::size_t(part)].footPointDistance(
          observed.points.col(Eigen::Index(i))));
    };
    nearest += distance(fit.labels[i]) <= distance(1 - fit.labels[i]) + 0.003;
  }
  EXPECT_GT(double(nearest), 0.97 * double(fit.labels.size()));
}

TEST(FitObject, PotIsOneTaperedPart) {
  ObjectFitOptions straight;
  straight.fit.taper = straight.fit.vessel = false;
  ViewScene scene = fineScene();
  scene.addUpright({0.035, 0.035, 0.05}, 0.2, 1.0, 0.05);
  for (const double taper : {0.3, -0.3}) {
    scene.taper = taper;
    scene.render(0.001);
    const ObjectFit fit = fitScene(scene);
    ASSERT_EQ(fit.model.size(), 1u);
    EXPECT_EQ(fit.parts[0].chosen.shape, ShapeClass::TAPERED);
    EXPECT_EQ(fit.parts[0].chosen.before, ShapeClass::ROTATIONAL);
    EXPECT_GT(fit.parts[0].margin, 10.0);
    EXPECT_NEAR(std::abs(fit.model.parts[0].kx), 0.3, 0.05);
    const double found = overlap(fit.model, scene.tapered());
    EXPECT_GT(found, 0.93);
    // without, it is a stack of parts or a poor one
    const ObjectFit plain = fitScene(scene, straight);
    EXPECT_FALSE(plain.model.parts[0].isTapered());
    EXPECT_LT(overlap(plain.model, scene.tapered()), found - 0.05);
  }
}

TEST(FitObject, CanAndBottleTakeNoTaper) {
  ObjectFitOptions straight;
  straight.fit.taper = false;
  ViewScene can;
  can.addUpright({0.04, 0.04, 0.07}, 0.2, 1.0, 0.07);
  can.render(0.001);
  // a can to the bit, a bottle's two parts may come another way to the same optimum
  for (const auto& [scene, within] :
       {std::pair(can, 0.0), std::pair(bottleScene(), 1e-5)}) {
    const ObjectFit fit = fitScene(scene), plain = fitScene(scene, straight);
    for (const Superquadric& part : fit.model.parts)
      EXPECT_FALSE(part.isTapered());
    ASSERT_EQ(fit.model.size(), plain.model.size());
    const SuperquadricCoefficients apart =
        fit.model.parts[0].toCoefficients() - plain.model.parts[0].toCoefficients();
    EXPECT_LE(apart.cwiseAbs().maxCoeff(), within);
  }
}

TEST(FitObject, SettingsOutOfRangeAreRefusedWithASentence) {
  ObjectFitOptions options;
  std::string why;
  EXPECT_TRUE(options.isValid(&why)) << why;
  options.max_parts = -1;
  EXPECT_FALSE(options.isValid(&why));
  EXPECT_NE(why.find("max_parts"), std::string::npos);
  options = {};
  options.silhouette_lines = 7;
  EXPECT_FALSE(options.isValid());
}

// SPDX-License-Identifier: BSD-3-Clause
// Parts of an object whose points lie all around it, without any view.
#include "fit_scene.h"

#include "pcl_sq/triangle_mesh.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

/** \brief Points all around the outer surface of a union, with noise [m]. */
Eigen::Matrix3Xf isWholeCloud(const MultiSuperquadric& object, double noise) {
  Random random(12);
  std::vector<Eigen::Vector3f> surface;
  for (std::size_t k = 0; k < object.size(); ++k)
    for (const Eigen::Vector3d& p : sampleUniform(object.parts[k], 1200, unsigned(k))) {
      bool inner = false;
      for (std::size_t j = 0; j < object.size(); ++j)
        inner = inner || (j != k && object.parts[j].gauge(p) < 1.0);
      const Eigen::Vector3d error(random.normal(), random.normal(), random.normal());
      if (!inner)
        surface.push_back((p + noise * error).cast<float>());
    }
  Eigen::Matrix3Xf points(3, Eigen::Index(surface.size()));
  for (std::size_t i = 0; i < surface.size(); ++i)
    points.col(Eigen::Index(i)) = surface[i];
  return points;
}

MultiSuperquadric dumbbell() {
  MultiSuperquadric object;
  for (const double z : {-0.08, 0.0, 0.08}) {
    Superquadric s;
    s.center = {0.1, 0.2, 0.7 + z};
    s.semi_axes = z == 0.0 ? Eigen::Vector3d(0.012, 0.012, 0.08)
                           : Eigen::Vector3d(0.035, 0.035, 0.035);
    s.epsilon1 = z == 0.0 ? 0.2 : 1.0;
    object.parts.push_back(s);
  }
  return object;
}

} // namespace

TEST(FitObject, FullCloudOfADumbbellIsThreePartsWithoutAnyView) {
  const MultiSuperquadric truth = dumbbell();
  const Eigen::Matrix3Xf points = isWholeCloud(truth, 0.0007);
  ObservedObject observed;
  ASSERT_TRUE(observeObject(points, int(points.cols()), 1, {}, {}, observed));
  const ObjectFit fit = fitObject(observed);
  EXPECT_EQ(fit.model.size(), 3u);
  EXPECT_GT(overlap(fit.model, truth), 0.9);
  for (const int parts : {1, 2}) {
    ObjectFitOptions forced;
    forced.parts = parts;
    EXPECT_EQ(fitObject(observed, forced).model.size(), std::size_t(parts));
  }
}

TEST(FitObject, OrderOfThePointsDoesNotMatterMuch) {
  const Eigen::Matrix3Xf points = isWholeCloud(dumbbell(), 0.0007);
  const Eigen::Matrix3Xf backwards = points.rowwise().reverse();
  ObservedObject a, b;
  ASSERT_TRUE(observeObject(points, int(points.cols()), 1, {}, {}, a));
  ASSERT_TRUE(observeObject(backwards, int(points.cols()), 1, {}, {}, b));
  const ObjectFit one = fitObject(a), other = fitObject(b);
  ASSERT_EQ(one.model.size(), other.model.size());
  EXPECT_GT(overlap(one.model, other.model), 0.97);
}

TEST(FitObject, ConeSeenFromAllSidesIsOneTaperedPart) {
  Superquadric cone;
  cone.center = {0.1, -0.2, 0.7};
  cone.rotation = Random(4).rotation();
  cone.semi_axes = {0.04, 0.04, 0.06};
  cone.epsilon1 = 0.3;
  cone.kx = cone.ky = 0.5;
  MultiSuperquadric truth;
  truth.parts.push_back(cone);
  Random random(21);
  const std::vector<Eigen::Vector3d> even = sampleUniform(cone, 2500);
  Eigen::Matrix3Xf points(3, Eigen::Index(even.size()));
  for (std::size_t i = 0; i < even.size(); ++i) {
    const Eigen::Vector3d error(random.normal(), random.normal(), random.normal());
    points.col(Eigen::Index(i)) = (even[i] + 0.0007 * error).cast<float>();
  }
  ObservedObject observed;
  ASSERT_TRUE(observeObject(points, int(points.cols()), 1, {}, {}, observed));
  const ObjectFit fit = fitObject(observed, {});
  ASSERT_EQ(fit.model.size(), 1u);
  EXPECT_GT(overlap(fit.model, truth), 0.97);
}

TEST(FitObject, PointsThatSpanNoVolumeGiveNoModel) {
  ObservedObject observed;
  observed.points = Eigen::Matrix3Xd::Zero(3, 100);
  EXPECT_TRUE(fitObject(observed).model.empty());
  observed.points.row(0) = Eigen::RowVectorXd::LinSpaced(100, 0.0, 1.0);
  EXPECT_TRUE(fitObject(observed).model.empty());
}

// SPDX-License-Identifier: BSD-3-Clause
// Clouds from all round of things of many parts, and the scores by which they are cut.
#include "fit_scene.h"
#include "observe_points.h"

#include "parts/union_score.h"
#include "union/exposed_area.h"
#include "util/cloud_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

using namespace pcl_sq;
using namespace pcl_sq::test;

namespace {

Superquadric boxAt(const Eigen::Vector3d& semi_axes, const Eigen::Vector3d& center) {
  Superquadric s;
  s.semi_axes = semi_axes;
  s.center = center;
  s.epsilon1 = s.epsilon2 = 0.1;
  return s;
}

constexpr int LEGS = 4;

/** \brief The top, then the legs. */
MultiSuperquadric table() {
  MultiSuperquadric t;
  t.parts.push_back(boxAt({0.5, 0.35, 0.02}, {0.0, 0.0, 0.7}));
  for (int k = 0; k < LEGS; ++k) {
    t.parts.push_back(boxAt({0.025, 0.025, 0.35},
                            {k % 2 ? 0.42 : -0.42, k / 2 ? 0.28 : -0.28, 0.35}));
    t.parts.back().epsilon2 = 1.0;
  }
  return t;
}

/** \brief Points spread evenly over the outside of a union. */
Eigen::Matrix3Xd outsideOf(const MultiSuperquadric& object, double points_per_area) {
  std::vector<Eigen::Vector3d> surface;
  for (std::size_t k = 0; k < object.size(); ++k) {
    const auto count =
        std::size_t(points_per_area * detail::exposedArea({object.parts[k]}));
    for (const Eigen::Vector3d& p : sampleUniform(object.parts[k], count, unsigned(k)))
      if (std::none_of(object.parts.begin(), object.parts.end(), [&](const auto& s) {
            return &s != &object.parts[k] && s.gauge(p) < 1.0;
          }))
        surface.push_back(p);
  }
  Eigen::Matrix3Xd points(3, Eigen::Index(surface.size()));
  for (std::size_t i = 0; i < surface.size(); ++i)
    points.col(Eigen::Index(i)) = surface[i];
  return points;
}

/** \brief Points in the faces of a box, without noise. */
void addFaces(const Eigen::Vector3d& semi_axes,
              const Eigen::Vector3d& center,
              int count,
              Random& random,
              std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d area(semi_axes.y() * semi_axes.z(),
                             semi_axes.z() * semi_axes.x(),
                             semi_axes.x() * semi_axes.y());
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < int(count * area[axis] / area.sum()); ++i) {
      Eigen::Vector3d p;
      for (int k = 0; k < 3; ++k)
        p[k] = semi_axes[k] * random.uniform(-1.0, 1.0);
      p[axis] = i % 2 ? semi_axes[axis] : -semi_axes[axis];
      points.emplace_back(center + p);
    }
}

} // namespace

TEST(CloudGraph, LegsOfATableAreItsLimbs) {
  const MultiSuperquadric object = table();
  const Eigen::Matrix3Xd points = outsideOf(object, 1500.0);
  const detail::CloudGraph graph(points);
  detail::Segment all(std::size_t(points.cols()));
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(graph.components(all).size(), 1u);
  bool found = false;
  for (const auto& segments : graph.limbs(all, Eigen::Matrix3d::Identity(), 24)) {
    std::size_t points_of_all = 0;
    for (const auto& segment : segments)
      points_of_all += segment.size();
    EXPECT_EQ(points_of_all, all.size()) << "each point is in one segment";
    found = found || segments.size() == std::size_t(LEGS + 1);
    if (segments.size() != std::size_t(LEGS + 1))
      continue;
    // each leg as a whole, and no two in one
    std::set<std::size_t> owners;
    for (std::size_t leg = 1; leg < object.size(); ++leg) {
      std::set<std::size_t> own;
      for (std::size_t k = 0; k < segments.size(); ++k)
        for (const int i : segments[k])
          if (points(2, i) < 0.6 && object.parts[leg].gauge(points.col(i)) < 1.1)
            own.insert(k);
      EXPECT_EQ(own.size(), 1u) << "leg " << leg;
      owners.insert(own.begin(), own.end());
    }
    EXPECT_EQ(owners.size(), std::size_t(LEGS));
  }
  EXPECT_TRUE(found) << "no way shows the legs and the top";
}

TEST(WholeCloud, EveryLegOfATableIsAPart) {
  const MultiSuperquadric object = table();
  const ObjectFit fit =
      fitObject(observe(outsideOf(object, 2000.0), Coverage::AUTOMATIC));
  ASSERT_EQ(fit.model.size(), object.size());
  for (std::size_t k = 0; k < object.size(); ++k) {
    double nearest = 1e300, longest = 0.0;
    for (const Superquadric& part : fit.model.parts)
      if (const double d = (part.center - object.parts[k].center).norm(); d < nearest) {
        nearest = d;
        longest = part.semi_axes.maxCoeff();
      }
    EXPECT_LT(nearest, 0.03) << "part " << k;
    EXPECT_NEAR(longest, object.parts[k].semi_axes.maxCoeff(), 0.05) << "part " << k;
  }
}

TEST(WholeCloud, FacesWithoutAnyNoiseAreSplitAsOthersAre) {
  Random random(3);
  std::vector<Eigen::Vector3d> faces;
  addFaces({0.5, 0.35, 0.02}, {0.0, 0.0, 0.72}, 2000, random, faces);
  for (const double x : {-0.42, 0.42})
    for (const double y : {-0.28, 0.28})
      addFaces({0.025, 0.025, 0.35}, {x, y, 0.35}, 250, random, faces);
  Eigen::Matrix3Xd points(3, Eigen::Index(faces.size()));
  for (std::size_t i = 0; i < faces.size(); ++i)
    points.col(Eigen::Index(i)) = faces[i];
  EXPECT_EQ(fitObject(observe(points, Coverage::COMPLETE)).model.size(), 5u);
}

TEST(WholeCloud, ABeltOfHardlyMoreThanAHundredthIsNoPartUnlessManyAreAskedFor) {
  // sigma .01 of the half diagonal is 2 mm, the belt stands off by 3 mm
  MultiSuperquadric belted;
  belted.parts = {boxAt({0.1, 0.1, 0.15}, Eigen::Vector3d::Zero()),
                  boxAt({0.103, 0.103, 0.05}, Eigen::Vector3d::Zero())};
  const ObservedObject observed = observe(outsideOf(belted, 2e4), Coverage::COMPLETE);
  EXPECT_EQ(fitObject(observed).model.size(), 1u);
  ObjectFitOptions detail;
  detail.max_parts = 8;
  EXPECT_GT(fitObject(observed, detail).model.size(), 1u);
}

TEST(WholeCloud, AFreeNumberOfPartsIsNoWorseThanAGivenOne) {
  const Eigen::Matrix3Xd points = outsideOf(table(), 2000.0);
  const ObservedObject observed = observe(points, Coverage::COMPLETE);
  const auto meanDistance = [&](int parts) {
    ObjectFitOptions options;
    options.parts = parts;
    const MultiSuperquadric model = fitObject(observed, options).model;
    double sum = 0.0;
    for (Eigen::Index i = 0; i < points.cols(); ++i)
      sum += std::abs(model.euclideanDistance(points.col(i))) / double(points.cols());
    return sum;
  };
  const double free = meanDistance(0);
  for (const int parts : {1, 2, 3, 5})
    EXPECT_LE(free, meanDistance(parts) + 2e-4) << parts << " parts";
}

TEST(WholeCloud, CutsOfABodyGainWhatItLeavesUnexplainedAndNoMore) {
  const Superquadric body = boxAt({0.05, 0.04, 0.08}, {0.3, 0.0, 0.2});
  MultiSuperquadric one;
  one.parts = {body};
  Eigen::Matrix3Xd points = outsideOf(one, 3e4);
  Random random(9);
  constexpr double SAMPLED_NOISE = 5e-4;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    points.col(i) += SAMPLED_NOISE *
                     Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  const ObservedObject observed = observe(points, Coverage::COMPLETE);
  const ObjectFitOptions options;
  const detail::PieceContext context{observed, options, SAMPLED_NOISE, {}, {}};
  const auto gainOf = [&](const Superquadric& model) {
    detail::Part part;
    part.piece.fit.fit.model = model;
    part.piece.fit.fit.termination = Termination::STEP_TOO_SMALL;
    detail::traceAgain(context, part);
    return detail::mostGain(context, part);
  };
  const double right = gainOf(body), n = observed.effective_points;
  EXPECT_LT(right, 0.1 * n);
  Superquadric longer = body; // a fifth of its surface has no points
  longer.semi_axes.z() *= 1.3;
  longer.center.z() += 0.3 * body.semi_axes.z();
  EXPECT_GT(gainOf(longer), 2.0 * std::log(1.2) * n);
  Superquadric thinner = body;
  thinner.semi_axes.x() -= 3.0 * SAMPLED_NOISE;
  EXPECT_GT(gainOf(thinner), right + 0.2 * n);
}

TEST(WholeCloud, ABodyThatLeavesTheBoxOfThePointsMayBeCutAndCutsOfItCompare) {
  MultiSuperquadric one;
  one.parts = {boxAt({0.05, 0.04, 0.08}, Eigen::Vector3d::Zero())};
  const ObservedObject observed = observe(outsideOf(one, 3e4), Coverage::COMPLETE);
  const ObjectFitOptions options;
  const detail::PieceContext context{observed, options, 5e-4, {}, {}};
  const auto longer = [&](double share) {
    detail::Part part;
    part.piece.fit.fit.model = one.parts[0];
    part.piece.fit.fit.model.semi_axes.z() *= share;
    part.piece.fit.fit.termination = Termination::STEP_TOO_SMALL;
    detail::traceAgain(context, part);
    return part;
  };
  const detail::Part within = longer(1.0), out = longer(1.5), farther = longer(1.8);
  EXPECT_LT(detail::mostGain(context, within), 1e6);
  EXPECT_GT(detail::mostGain(context, out), 1e6);
  const auto score = [&](const detail::Part& part) {
    return detail::scoreOf(context, {&part});
  };
  EXPECT_GT(score(out), score(within) + observed.effective_points);
  EXPECT_GT(score(farther), score(out) + 1.0);
  EXPECT_LT(score(farther), 1e8);
}

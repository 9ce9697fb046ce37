// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/line_intersection.h"
#include "pcl_sq/oriented_box.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::Random;

namespace {

OrientedBox randomBox(Random& random, const Eigen::Vector3d& near, double reach) {
  OrientedBox box;
  box.center = near + random.direction() * random.uniform(0.0, reach);
  box.rotation = random.rotation();
  box.half_sizes = {random.uniform(0.002, 0.1),
                    random.uniform(0.002, 0.1),
                    random.uniform(0.002, 0.1)};
  return box;
}

Eigen::Vector3d nearestInBox(const OrientedBox& box, const Eigen::Vector3d& point) {
  const Eigen::Vector3d local = box.rotation.transpose() * (point - box.center);
  return box.center +
         box.rotation * local.cwiseMax(-box.half_sizes).cwiseMin(box.half_sizes);
}

/** \brief Distance by alternating projections: slow, but without a simplex. */
double alternatingDistance(const OrientedBox& box, const Superquadric& s) {
  Eigen::Vector3d p = box.center;
  double distance = 0.0;
  for (int i = 0; i < 400; ++i) {
    if (s.gauge(p) <= 1.0)
      return 0.0;
    const Eigen::Vector3d q = s.closestPoint(p);
    p = nearestInBox(box, q);
    const double next = (p - q).norm();
    if (i > 5 && std::abs(next - distance) < 1e-10)
      return next;
    distance = next;
  }
  return distance;
}

} // namespace

TEST(OrientedBox, DistanceToASphereIsTheDistanceToItsCentreLessTheRadius) {
  Random random(101);
  for (int i = 0; i < 500; ++i) {
    Superquadric sphere;
    sphere.semi_axes.setConstant(random.uniform(0.01, 0.1));
    sphere.rotation = random.rotation();
    const OrientedBox box = randomBox(random, sphere.center, 0.5);
    const double expected =
        (nearestInBox(box, sphere.center) - sphere.center).norm() - sphere.semi_axes[0];
    EXPECT_NEAR(distance(box, sphere), std::max(expected, 0.0), 1e-6);
    if (std::abs(expected) > 1e-6) {
      EXPECT_EQ(collides(box, sphere), expected < 0.0);
    }
  }
}

TEST(OrientedBox, DistanceEqualsAlternatingProjections) {
  Random random(102);
  for (int i = 0; i < 60; ++i) {
    Superquadric s = random.superquadric();
    s.epsilon1 = random.uniform(0.3, 1.5); // projections crawl along flat faces
    s.epsilon2 = random.uniform(0.3, 1.5);
    const OrientedBox box = randomBox(random, s.center, 0.6);
    EXPECT_NEAR(distance(box, s), alternatingDistance(box, s), 2e-4);
  }
}

TEST(OrientedBox, CollidesExactlyWhenTheDistanceIsBelowTheClearance) {
  Random random(103);
  int both[2] = {0, 0};
  for (int i = 0; i < 3000; ++i) {
    const Superquadric s = random.superquadric();
    const OrientedBox box = randomBox(random, s.center, 0.5);
    const double clearance = random.uniform(0.0, 0.05);
    const double d = distance(box, s);
    if (std::abs(d - clearance) < 1e-6)
      continue;
    const bool expected = d < clearance || d == 0.0;
    EXPECT_EQ(collides(box, s, clearance), expected)
        << i << " d " << d << " clearance " << clearance;
    ++both[expected];
  }
  EXPECT_GT(both[0], 300);
  EXPECT_GT(both[1], 300);
}

TEST(OrientedBox, NoCollisionMeansThatNoSurfacePointLiesInTheBox) {
  Random random(104);
  int apart = 0;
  for (int i = 0; i < 400; ++i) {
    const Superquadric s = random.superquadric();
    const OrientedBox box = randomBox(random, s.center, 0.4);
    if (collides(box, s))
      continue;
    ++apart;
    for (int k = 0; k < 200; ++k) {
      EXPECT_FALSE(box.contains(random.surfacePoint(s), -1e-9));
    }
    for (const Eigen::Vector3d& corner : box.corners()) {
      EXPECT_GT(s.gauge(corner), 1.0);
    }
  }
  EXPECT_GT(apart, 50);
}

TEST(OrientedBox, TheHollowOfABendIsFree) {
  Random random(106);
  for (int i = 0; i < 100; ++i) {
    Superquadric s;
    const double width = random.uniform(0.005, 0.02);
    s.semi_axes = {width, width * random.uniform(1.0, 1.5), random.uniform(0.05, 0.1)};
    s.bend = random.uniform(0.5, 1.4) / s.semi_axes.z(); // the circle's part, half
    s.rotation = random.rotation();
    // a cube beside the middle, where the circle's centre is
    OrientedBox box;
    box.rotation = s.rotation;
    box.half_sizes.setConstant(0.1 * width);
    const double gap = 0.06 * width;
    box.center = s.center + s.rotation.col(0) * (1.1 * width + gap);
    EXPECT_FALSE(collides(box, s)) << i;
    box.center -= s.rotation.col(0) * 1.1 * gap;
    EXPECT_TRUE(collides(box, s)) << i;
  }
}

TEST(OrientedBox, ASharedPointMeansCollision) {
  Random random(105);
  for (int i = 0; i < 500; ++i) {
    const Superquadric s = random.superquadric();
    OrientedBox box = randomBox(random, s.center, 0.3);
    const Eigen::Vector3d inside =
        s.center + random.uniform(0.0, 0.999) * (random.surfacePoint(s) - s.center);
    const Eigen::Vector3d local(random.uniform(-1, 1), random.uniform(-1, 1), 1.0);
    box.center = inside - box.rotation * local.cwiseProduct(box.half_sizes);
    EXPECT_TRUE(collides(box, s)) << i;
    EXPECT_NEAR(distance(box, s), 0.0, 1e-9);
  }
}

TEST(LineIntersection, EndsLieOnTheSurfaceAndTheMiddleInside) {
  Random random(111);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Superquadric s = random.superquadric();
    const Eigen::Vector3d origin = random.pointNear(s);
    const Eigen::Vector3d direction = random.direction() * random.uniform(0.1, 3.0);
    LineInterval interval;
    const bool hit = intersectLine(s, origin, direction, interval);
    if (hit) {
      ++hits;
      EXPECT_LE(interval.enter, interval.leave);
      EXPECT_NEAR(s.gauge(origin + interval.enter * direction), 1.0, 1e-9);
      EXPECT_NEAR(s.gauge(origin + interval.leave * direction), 1.0, 1e-9);
      EXPECT_LE(s.gauge(origin + 0.5 * (interval.enter + interval.leave) * direction),
                1.0 + 1e-9);
    } else {
      for (int k = -50; k <= 50; ++k) {
        EXPECT_GT(s.gauge(origin + 0.02 * k * direction), 1.0);
      }
    }
    if (s.gauge(origin) < 1.0) {
      EXPECT_TRUE(hit && interval.enter < 0.0 && interval.leave > 0.0);
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(LineIntersection, ARayMeetsABodyThatOneOfItsPlacesIsIn) {
  Random random(113);
  int met = 0, missed = 0;
  for (int i = 0; i < 2000; ++i) {
    Superquadric whole = random.superquadric();
    if (i % 2 == 1)
      whole.kx = random.uniform(-0.8, 0.8);
    Superquadric s = whole;
    if (i % 4 > 1)
      s.rim = random.uniform(-0.6, 0.9);
    const Eigen::Vector3d origin = random.pointNear(s), direction = random.direction();
    LineInterval box;
    double least = 1e300; // gauge along the ray, below the rim
    if (intersectLineBox(whole, origin, direction, box))
      for (int k = 0; k <= 500; ++k) {
        const double t = box.enter + k * (box.leave - box.enter) / 500;
        const Eigen::Vector3d p = origin + t * direction;
        if (t >= 0.0 && s.toLocal(p).z() <= s.rimHeight() * s.semi_axes.z())
          least = std::min(least, whole.gauge(p));
      }
    const bool meets = meetsRay(s, origin, direction);
    if (least < 1.0) {
      EXPECT_TRUE(meets) << i;
    } else if (least > 1.1) { // nor is one between two of the places
      EXPECT_FALSE(meets) << i;
    }
    ++(meets ? met : missed);
  }
  EXPECT_GT(met, 200);
  EXPECT_GT(missed, 300);
}

TEST(LineIntersection, TheBoxContainsTheInterval) {
  Random random(112);
  for (int i = 0; i < 500; ++i) {
    const Superquadric s = random.superquadric();
    const Eigen::Vector3d origin = random.pointNear(s), direction = random.direction();
    LineInterval inner, outer;
    if (!intersectLine(s, origin, direction, inner))
      continue;
    ASSERT_TRUE(intersectLineBox(s, origin, direction, outer));
    EXPECT_LE(outer.enter, inner.enter);
    EXPECT_GE(outer.leave, inner.leave);
  }
}

TEST(LineIntersection, ALineThroughTheAxesOfAnOctahedronAndOfABoxIsHit) {
  for (const double epsilon : {0.05, 1.0, 2.0}) {
    Superquadric s;
    s.epsilon1 = s.epsilon2 = epsilon;
    s.semi_axes = {0.1, 0.2, 0.3};
    for (int k = 0; k < 3; ++k) {
      LineInterval interval;
      ASSERT_TRUE(intersectLine(
          s, Eigen::Vector3d::Zero(), Eigen::Vector3d::Unit(k), interval));
      EXPECT_NEAR(interval.leave, s.semi_axes[k], 1e-9);
      EXPECT_NEAR(interval.enter, -s.semi_axes[k], 1e-9);
      EXPECT_FALSE(intersectLine(s,
                                 Eigen::Vector3d::Unit((k + 1) % 3) * 0.31,
                                 Eigen::Vector3d::Unit(k),
                                 interval));
    }
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/grasp_quality.h"

#include "random_superquadric.h"

#include <gtest/gtest.h>

using namespace pcl_sq;
using pcl_sq::test::Random;
using Wrench = Eigen::Matrix<double, 6, 1>;

namespace {

GraspContact contact(const Eigen::Vector3d& position, const Eigen::Vector3d& normal) {
  GraspContact c;
  c.position = position;
  c.normal = normal.normalized();
  return c;
}

/** \brief Two fingers at +-r on the x axis, pressing squarely. */
std::vector<GraspContact> pinch(double r) {
  return {contact({r, 0, 0}, {1, 0, 0}), contact({-r, 0, 0}, {-1, 0, 0})};
}

/** \brief Fingers evenly on a circle of radius r in the x-y plane. */
std::vector<GraspContact> circle(int count, double r) {
  std::vector<GraspContact> all;
  for (int i = 0; i < count; ++i) {
    const double a = 2.0 * M_PI * i / count;
    const Eigen::Vector3d out(std::cos(a), std::sin(a), 0.0);
    all.push_back(contact(r * out, out));
  }
  return all;
}

WrenchOptions options(double friction, double torsion) {
  WrenchOptions o;
  o.friction = friction;
  o.torsional_friction = torsion;
  o.torque_length = 1.0;
  return o;
}

Wrench randomDirection(Random& random) {
  Wrench w;
  for (int k = 0; k < 6; ++k)
    w[k] = random.normal();
  return w.normalized();
}

/** \brief Smallest support over the unit sphere by descent from random directions:
 * epsilon without a hull. */
double epsilonByDescent(const std::vector<GraspContact>& contacts,
                        const WrenchOptions& o,
                        Random& random) {
  double best = 1e9;
  for (int start = 0; start < 60; ++start) {
    Wrench w = randomDirection(random);
    double value = wrenchSupport(contacts, w, o);
    for (double step = 0.5; step > 1e-6; step *= 0.8)
      for (int k = 0; k < 60; ++k) {
        const Wrench next = (w + step * randomDirection(random)).normalized();
        const double trial = wrenchSupport(contacts, next, o);
        if (trial < value) {
          value = trial;
          w = next;
        }
      }
    best = std::min(best, value);
  }
  return best;
}

} // namespace

TEST(GraspQuality, APinchOfSoftFingersEqualsTheValueByHand) {
  // Levers +-l on x. With force F and torque T across such that the tangential parts of
  // one contact cancel (F = l b, T = b), the other holds 2 mu l b; a push of mu l b
  // along x makes both equal. Norm 1 gives mu l / sqrt(1 + l^2 (1 + mu^2)). Twisting
  // about x is held by gamma alone.
  for (const double lever : {0.5, 1.0})
    for (const double mu : {0.2, 0.5, 1.0})
      for (const double gamma : {0.05, 0.3, 0.8}) {
        const WrenchQuality q = wrenchQuality(pinch(lever), options(mu, gamma));
        const double across =
            mu * lever / std::sqrt(1.0 + lever * lever * (1.0 + mu * mu));
        const double expected = std::min(gamma, across);
        EXPECT_TRUE(q.force_closure);
        EXPECT_NEAR(q.epsilon, expected, 0.002 * expected) << mu << " " << gamma;
        EXPECT_LE(q.epsilon_lower, q.epsilon);
        EXPECT_GE(q.epsilon_lower, 0.85 * q.epsilon); // eight edges
      }
}

TEST(GraspQuality, TwoPointContactsNeverCloseAndThreeDo) {
  EXPECT_FALSE(wrenchQuality(pinch(1.0), options(0.5, 0.0)).force_closure);
  EXPECT_EQ(wrenchQuality(pinch(1.0), options(0.5, 0.0)).epsilon, 0.0);
  EXPECT_EQ(wrenchQuality(pinch(1.0), options(0.5, 0.0)).volume, 0.0);
  EXPECT_TRUE(wrenchQuality(circle(3, 1.0), options(0.5, 0.0)).force_closure);
  EXPECT_FALSE(wrenchQuality(circle(3, 1.0), options(0.0, 0.0)).force_closure);
  EXPECT_FALSE(wrenchQuality({}, options(0.5, 0.01)).force_closure);
}

TEST(GraspQuality, ContactsOutsideOfEachOthersConesDoNotClose) {
  for (const double tilt : {0.3, 0.45, 0.6}) { // atan 0.5 = 0.4636
    std::vector<GraspContact> contacts = pinch(1.0);
    contacts[0].normal = {std::cos(tilt), std::sin(tilt), 0.0};
    contacts[1].normal = {-std::cos(tilt), std::sin(tilt), 0.0};
    EXPECT_EQ(wrenchQuality(contacts, options(0.5, 0.1)).force_closure,
              std::tan(tilt) < 0.5);
  }
}

TEST(GraspQuality, EpsilonEqualsTheSmallestSupportFoundWithoutAHull) {
  Random random(301);
  for (int i = 0; i < 6; ++i) {
    std::vector<GraspContact> contacts = circle(2 + i % 3, 1.0);
    for (GraspContact& c : contacts) {
      c.position += 0.1 * random.direction();
      c.normal = (c.normal + 0.15 * random.direction()).normalized();
    }
    const WrenchOptions o =
        options(random.uniform(0.4, 0.8), random.uniform(0.05, 0.3));
    const WrenchQuality q = wrenchQuality(contacts, o);
    const double expected = epsilonByDescent(contacts, o, random);
    ASSERT_TRUE(q.force_closure);
    EXPECT_NEAR(q.epsilon, expected, 0.01 * expected);
    EXPECT_LE(q.epsilon_lower, q.epsilon * (1 + 1e-9));
  }
}

TEST(GraspQuality, EpsilonEqualsQhullOnDenselyCutCones) {
  Random random(304);
  for (int i = 0; i < 2; ++i) {
    std::vector<GraspContact> contacts = circle(3 + i, 1.0);
    for (GraspContact& c : contacts)
      c.normal = (c.normal + 0.2 * random.direction()).normalized();
    WrenchOptions o = options(0.6, 0.0); // point contacts: the edges are the whole cone
    o.cone_edges = 24;
    const WrenchQuality q = wrenchQuality(contacts, o);
    ASSERT_TRUE(q.force_closure);
    EXPECT_NEAR(q.epsilon, q.epsilon_lower, 0.02 * q.epsilon);
    o.cone_edges = 8; // only the lower bound and the volume depend on it
    EXPECT_NEAR(wrenchQuality(contacts, o).epsilon, q.epsilon, 1e-3 * q.epsilon);
  }
}

TEST(GraspQuality, NoWrenchOfTheConesReachesBeyondTheSupport) {
  Random random(302);
  const std::vector<GraspContact> contacts = circle(3, 1.0);
  const WrenchOptions o = options(0.5, 0.2);
  for (int i = 0; i < 2000; ++i) {
    const Wrench d = randomDirection(random);
    const GraspContact& c = contacts[std::size_t(i) % 3];
    // a random admissible wrench of unit normal force
    Eigen::Vector3d t = random.direction();
    t = (t - c.normal * c.normal.dot(t)).normalized();
    const double angle = random.uniform(0.0, 2.0 * M_PI), share = random.uniform(0, 1);
    const Eigen::Vector3d force = -c.normal + share * 0.5 * std::cos(angle) * t;
    Wrench w;
    w << force, c.position.cross(force) - share * 0.2 * std::sin(angle) * c.normal;
    EXPECT_LE(w.dot(d), wrenchSupport(contacts, d, o) + 1e-12);
  }
}

TEST(GraspQuality, DoesNotDependOnTheFrame) {
  Random random(303);
  const std::vector<GraspContact> contacts = circle(4, 1.0);
  const WrenchOptions o = options(0.5, 0.1);
  const WrenchQuality q = wrenchQuality(contacts, o);
  const Eigen::Matrix3d r = random.rotation();
  const Eigen::Vector3d t(1.0, 2.0, 3.0);
  std::vector<GraspContact> moved = contacts;
  for (GraspContact& c : moved) {
    c.position = r * c.position + t;
    c.normal = r * c.normal;
  }
  WrenchOptions at = o;
  at.origin = t;
  EXPECT_NEAR(wrenchQuality(moved, at).epsilon, q.epsilon, 0.01 * q.epsilon);
  EXPECT_NEAR(wrenchQuality(moved, at).volume, q.volume, 0.15 * q.volume);
}

TEST(GraspQuality, MoreFrictionNeverHurts) {
  double epsilon = 0.0, volume = 0.0;
  for (const double mu : {0.2, 0.4, 0.8}) {
    const WrenchQuality q = wrenchQuality(circle(3, 1.0), options(mu, 0.1));
    EXPECT_GT(q.epsilon, epsilon);
    EXPECT_GT(q.volume, volume);
    epsilon = q.epsilon;
    volume = q.volume;
  }
}

TEST(GraspQuality, OptionsOutOfRangeAreNamed) {
  std::string why;
  WrenchOptions o;
  EXPECT_TRUE(o.isValid(&why));
  o.friction = -1.0;
  EXPECT_FALSE(o.isValid(&why));
  EXPECT_NE(why.find("friction"), std::string::npos);
  o = {};
  o.torque_length = 0.0;
  EXPECT_FALSE(o.isValid(&why));
  EXPECT_FALSE(wrenchQuality(pinch(1.0), o).force_closure);
}

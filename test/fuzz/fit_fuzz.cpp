// SPDX-License-Identifier: BSD-3-Clause
// Fits clouds that no sensor should ever deliver: fit_fuzz [COUNT] [SEED] [taper].
// Fails when a fit yields numbers that are no superquadric, claims success for nothing,
// or takes longer than a tenth of a second of processor time. Case i depends on SEED +
// i alone: a million can be run in parts, and one of them again with fit_fuzz 1 (SEED +
// i).
#include "pcl_sq/fit_tapered.h"

#include "random_superquadric.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace {

using namespace pcl_sq;
using pcl_sq::test::Random;

constexpr double LONGEST = 0.1;         ///< [s]
constexpr double LONGEST_TAPERED = 1.0; ///< and with a taper

double processorTime() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

int integer(Random& random, int low, int high) {
  return static_cast<int>(random.uniform(low, high + 1 - 1e-9));
}

/** \brief Points of a shape whose exponents or proportions are extreme. */
Eigen::Matrix3Xd surface(Random& random, int count) {
  Superquadric s = random.superquadric();
  const double ends[] = {0.05, 0.1, 1.0, 2.0};
  s.epsilon1 = ends[integer(random, 0, 3)];
  s.epsilon2 = ends[integer(random, 0, 3)];
  for (int k = 0; k < 3; ++k)
    s.semi_axes[k] = std::pow(10.0, random.uniform(-2.5, 2.5));
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i)
    points.col(i) = random.surfacePoint(s);
  return points;
}

Eigen::Matrix3Xd cloud(Random& random) {
  // few points are the hard case; many are slow to make
  const int count =
      integer(random, 0, 99) == 0 ? integer(random, 80, 3000) : integer(random, 0, 80);
  Eigen::Matrix3Xd points = surface(random, count);
  const auto normal = [&random] { return random.normal(); };
  switch (integer(random, 0, 9)) {
  case 0: // three places at most
    points.resize(3, integer(random, 0, 3));
    points = points.NullaryExpr(3, points.cols(), normal);
    break;
  case 1: // a line, exact or nearly
    for (int i = 0; i < count; ++i)
      points.col(i) = random.normal() * Eigen::Vector3d(1, 2, 3) +
                      1e-9 * Eigen::Vector3d(normal(), normal(), normal());
    break;
  case 2: // a plane
    points.row(integer(random, 0, 2)).setConstant(random.normal());
    break;
  case 3: // few places, each many times
    for (int i = 0; i < count; ++i)
      points.col(i) = points.col(i % integer(random, 1, 5));
    break;
  case 4: // a blob
    points = points.NullaryExpr(3, count, normal);
    break;
  case 5: // one point far away
    if (count > 0)
      points.col(0) *= 1e6;
    break;
  case 6: // numbers that are none
    for (int i = 0; i < count; i += integer(random, 1, 4))
      points(integer(random, 0, 2), i) =
          integer(random, 0, 1) ? std::nan("") : INFINITY;
    break;
  case 7: // two of them
    for (int i = 0; i < count / 2; ++i)
      points.col(i) = random.normal() * points.col(i) + Eigen::Vector3d(3, 0, 0);
    break;
  case 8: // a lattice
    points = (points * 4.0).array().round();
    break;
  default: // the bare surface
    break;
  }
  points *= std::pow(10.0, random.uniform(-9.0, 9.0));
  if (integer(random, 0, 1) && points.cols() > 0)
    points.colwise() += Eigen::Vector3d(normal(), normal(), normal()) *
                        points.cwiseAbs().maxCoeff() *
                        std::pow(10.0, random.uniform(-2.0, 4.0));
  return points;
}

FitOptions options(Random& random) {
  FitOptions o;
  o.robust = integer(random, 0, 3) > 0;
  o.size_prior = integer(random, 0, 3) > 0;
  if (integer(random, 0, 7) == 0)
    o.noise = std::pow(10.0, random.uniform(-12.0, 9.0));
  if (integer(random, 0, 7) == 0)
    o.max_outlier_share = random.uniform(0.0, 0.9);
  if (integer(random, 0, 7) == 0)
    o.min_epsilon = random.uniform(0.05, 1.0);
  return o;
}

/** \brief A fit, one in eight from a start that may be anywhere, parameters held. */
FitSummary fit(Random& random, const Eigen::Matrix3Xd& points, FitOptions o) {
  if (integer(random, 0, 7) > 0)
    return fitSuperquadric(points, o);
  Superquadric start = random.superquadric();
  const double scale = std::pow(10.0, random.uniform(-9.0, 9.0));
  start.semi_axes *= scale;
  start.center *= scale;
  if (points.cols() > 0 && integer(random, 0, 1)) {
    start.center = points.col(0);
    start.semi_axes *= points.col(0).norm() / scale;
  }
  o.fixed = integer(random, 0, 1) ? static_cast<unsigned>(integer(random, 0, 0x7ff))
                                  : static_cast<unsigned>(FIX_NOTHING);
  return fitSuperquadric(points, start, o);
}

/** \brief What is wrong with a result; empty when nothing is. */
std::string complaint(const FitSummary& s) {
  std::string why;
  if (s.ok() && !s.model.isValid(&why))
    return "invalid model: " + why;
  if (!std::isfinite(s.rms_distance) || !std::isfinite(s.distortion) ||
      !std::isfinite(s.sigma) || !s.covariance.allFinite())
    return "not finite: rms " + std::to_string(s.rms_distance) + ", distortion " +
           std::to_string(s.distortion) + ", sigma " + std::to_string(s.sigma) +
           ", covariance " + std::to_string(s.covariance.sum());
  return {};
}

std::string complaint(const TaperedFit& f) {
  std::string why;
  if (f.ok() && !f.model.isValid(&why))
    return "invalid model: " + why;
  if (!std::isfinite(f.margin) || !std::isfinite(f.rms_distance) ||
      !std::isfinite(f.sigma) || !std::isfinite(f.kx_deviation + f.ky_deviation))
    return "not finite: margin " + std::to_string(f.margin) + ", rms " +
           std::to_string(f.rms_distance) + ", sigma " + std::to_string(f.sigma) +
           ", deviations " + std::to_string(f.kx_deviation + f.ky_deviation);
  return complaint(f.untapered);
}

} // namespace

int main(int argc, char** argv) {
  const long count = argc > 1 ? std::atol(argv[1]) : 2000;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atol(argv[2])) : 1U;
  const bool taper = argc > 3 && std::strcmp(argv[3], "taper") == 0;
  long failures = 0, usable = 0;
  double longest = 0.0;
  for (long i = 0; i < count; ++i) {
    // each case can be repeated alone: fit_fuzz 1 SEED
    Random random(seed + static_cast<unsigned>(i));
    const Eigen::Matrix3Xd points = cloud(random);
    const FitOptions o = options(random);
    std::string why;
    bool ok = false;
    const double begin = processorTime();
    if (taper) {
      const TaperedFit f = fitTapered(points, o);
      why = complaint(f);
      ok = f.ok();
    } else {
      const FitSummary summary = fit(random, points, o);
      why = complaint(summary);
      ok = summary.ok();
    }
    const double seconds = processorTime() - begin;
    longest = std::max(longest, seconds);
    usable += ok;
    if (why.empty() && seconds > (taper ? LONGEST_TAPERED : LONGEST))
      why = "took " + std::to_string(seconds) + " s";
    if (!why.empty() && ++failures <= 20)
      std::fprintf(stderr,
                   "SEED %ld (%ld points): %s\n",
                   static_cast<long>(seed) + i,
                   static_cast<long>(points.cols()),
                   why.c_str());
  }
  std::printf("%ld fits, %ld usable, %ld failures, longest %.1f ms\n",
              count,
              usable,
              failures,
              1e3 * longest);
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

// SPDX-License-Identifier: BSD-3-Clause
// The tapered family: one of the others with its section growing along z.
#include "shape_spaces.h"
#include "tapered_support.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

/** \brief Least gain over a taper's parameters that is worth a fit: half of what its
 * prior demands, for one step need not tell all. */
constexpr double WORTH_A_FIT = 0.5 * TAPER;
/** \brief Cost per observation from which on no family is near the body, and a taper is
 * looked for from the search's own starts. */
constexpr double MISFIT = 1.3;
constexpr double WIDE = 0.03;   ///< sigma of that search, in the points' deviation
constexpr std::size_t KEPT = 2; ///< starts of it that are refined

/** \brief The solid of revolution most like a tapered body. */
ShapeCandidate rounded(ShapeCandidate c) {
  c.before = ShapeClass::ROTATIONAL;
  c.model.semi_axes.head<2>().setConstant(
      std::sqrt(c.model.semi_axes.x() * c.model.semi_axes.y()));
  c.model.epsilon2 = 1.0;
  c.kx = c.ky = 0.5 * (c.kx + c.ky);
  return c;
}

/** \brief The dual description of a tapered body's section. */
ShapeCandidate bevelled(ShapeCandidate c) {
  c.before = ShapeClass::GENERIC;
  c.model = dual(c.model);
  c.kx = c.ky = 0.5 * (c.kx + c.ky);
  return c;
}

/** \brief A tapered body with its axis turned upright. */
ShapeCandidate standingUp(ShapeCandidate c, const Eigen::Vector3d& up) {
  c.upright = true;
  c.model = upright(c.model, 2, up);
  return c;
}

/** \brief Tapered bodies from the search's own starts, the best few. */
std::vector<ShapeCandidate> searchTapers(const SupportProblem& problem) {
  const TaperedSupport rough(
      problem, problem.coarse(), std::max(WIDE, 2.0 * problem.noise()));
  std::vector<ShapeCandidate> candidates;
  for (const Superquadric& start : supportStarts(problem)) {
    ShapeCandidate c;
    c.shape = start.epsilon2 == 1.0 ? ShapeClass::ROTATIONAL : ShapeClass::GENERIC;
    c.model = start;
    if (c.shape == ShapeClass::ROTATIONAL)
      c.model.semi_axes.head<2>().setConstant(start.semi_axes.head<2>().mean());
    candidates.push_back(rough.fit(taperStart(problem, c, 2)));
  }
  std::sort(
      candidates.begin(),
      candidates.end(),
      [](const ShapeCandidate& a, const ShapeCandidate& b) { return a.bic < b.bic; });
  candidates.resize(std::min(candidates.size(), KEPT));
  return candidates;
}

} // namespace

std::optional<ShapeCandidate> fitTaper(const SupportProblem& problem,
                                       double sigma,
                                       const std::vector<ShapeCandidate>& candidates) {
  // the best of each kind: of revolution or not, held upright or not
  const ShapeCandidate* best[2][2] = {};
  double least = 1e300;
  for (const ShapeCandidate& c : candidates) {
    least = std::min(least, c.cost);
    if (c.on_axis || c.shape == ShapeClass::ELLIPSOID)
      continue;
    const ShapeCandidate*& of_kind =
        best[c.shape == ShapeClass::ROTATIONAL ? 1 : 0][c.upright ? 1 : 0];
    if (!of_kind || c.bic < of_kind->bic)
      of_kind = &c;
  }
  const TaperedSupport quick(problem, problem.coarse(), sigma);
  const TaperedSupport thorough(problem, problem.medium(), sigma);
  const double observations = problem.observations();
  const double inflation = std::max(1.0, least / observations);
  std::optional<ShapeCandidate> found;
  const auto fitFrom = [&](const TaperStart& start) {
    const ShapeCandidate c = thorough.fit(start);
    if (!found || c.bic < found->bic)
      found = c;
  };
  for (const auto& kind : best)
    for (const ShapeCandidate* from : kind) {
      if (!from)
        continue;
      TaperStart most; // of the axes along which it may be tapered
      for (int k = from->shape == ShapeClass::ROTATIONAL ? 2 : 0; k < 3; ++k) {
        TaperStart start = taperStart(problem, *from, k);
        start.gain = quick.gainOf(start);
        if (start.gain >= most.gain)
          most = std::move(start);
      }
      if (most.gain >= inflation * (most.taper * std::log(observations) + WORTH_A_FIT))
        fitFrom(most);
    }
  if (inflation > MISFIT)
    for (const ShapeCandidate& c : searchTapers(problem))
      fitFrom(taperStart(problem, c, 2));
  if (!found)
    return found;
  // untapered, a lampshade is best described lying down, or flat; tapered, it may turn
  // out to stand, and to be round
  if (found->before != ShapeClass::ROTATIONAL) {
    const ShapeCandidate angular = *found;
    fitFrom(taperStart(problem, bevelled(angular), 2));
    fitFrom(taperStart(problem, rounded(angular), 2));
  }
  if (!found->upright && problem.hasUp() &&
      std::abs(found->model.rotation.col(2).dot(problem.up())) > UPRIGHT)
    fitFrom(taperStart(problem, standingUp(*found, problem.up()), 2));
  return found;
}

void fitTaperAllPoints(const SupportProblem& problem,
                       double sigma,
                       ShapeCandidate& chosen) {
  const ShapeCandidate fitted =
      TaperedSupport(problem, problem.all(), sigma).fit(taperStart(problem, chosen, 2));
  chosen.bic += fitted.cost - chosen.cost; // which may be scaled by the misfit
  chosen.cost = fitted.cost;
  chosen.model = fitted.model;
  chosen.kx = fitted.kx;
  chosen.ky = fitted.ky;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// The tapered family: one of the others with its section growing along z.
#include "families/families.h"
#include "tuning/view_tuning.h"
#include "view_problem/plane_sums.h"
#include "view_problem/shape_spaces.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

/** \brief Least gain over a taper's parameters that is worth a fit: half of what its
 * prior demands, for one step need not tell all. */
constexpr double WORTH_A_FIT = 0.5 * TAPER;
using namespace tuning::family;
using namespace tuning::fit_taper;

/** \brief Where a taper is tried from. */
struct TaperStart {
  ShapeCandidate from;                     ///< its model with the axis along z
  ShapeClass family = ShapeClass::GENERIC; ///< that is tapered
  Basis<13> basis;   ///< directions in which it may move, those of the taper last
  int taper = 2;     ///< columns of it
  double gain = 0.0; ///< by the taper, as far as one Gauss-Newton step can tell
};

/** \brief A family's space with the taper's columns behind it. */
Basis<13> withTaper(const ParameterSpace& space, bool round) {
  const Eigen::Index own = space.basis.cols(), taper = round ? 1 : 2;
  Basis<13> basis = Basis<13>::Zero(13, own + taper);
  basis.topLeftCorner(11, own) = space.basis;
  basis(11, own) = 1.0;
  basis(12, own + taper - 1) = 1.0;
  return basis;
}

/** \brief A candidate with its axis \a k as z, and how it may move. */
TaperStart taperStart(const ViewProblem& problem, const ShapeCandidate& c, int k) {
  TaperStart start;
  start.from = c;
  start.family = c.shape == ShapeClass::TAPERED ? c.before : c.shape;
  const bool round = start.family == ShapeClass::ROTATIONAL;
  start.from.model = withAxis(c.model, k);
  start.taper = round ? 1 : 2;
  ParameterSpace space = spaceOf(start.family);
  for (int axis = 0; axis < 3 && c.upright; ++axis)
    if (std::abs(start.from.model.rotation.col(axis).dot(problem.up())) > UPRIGHT)
      space = standing(space, axis);
  start.basis = withTaper(space, round);
  return start;
}

/** \brief Least squares over the parameters of a tapered body. */
class TaperedFamily {
public:
  /** \param[in] points of the problem or fewer; kept by reference
   * \param[in] sigma of the points */
  TaperedFamily(const ViewProblem& problem,
                const UnitPoints& points,
                double sigma,
                int iterations = tuning::fit_taper::ITERATIONS)
      : problem_(problem), points_(points), limits_(problem.limits(sigma)),
        unit_(problem.unitOf(sigma, points)), planes_(problem.planes(sigma, points)),
        contributor_(std::cref(planes_)) {
    limits_.max_iterations = iterations;
  }
  TaperedFamily(const TaperedFamily&) = delete;
  TaperedFamily& operator=(const TaperedFamily&) = delete;

  /** \brief What the taper's directions add to the gain that a Gauss-Newton step
   * promises (Rao's score test, M16). */
  double gainOf(const TaperStart& start) const {
    const PointsProblem<13> squares{points_, limits_, contributor_};
    const SquareSums<13> sums = squares.evaluate(start.from.model);
    const int all = static_cast<int>(start.basis.cols());
    const auto promised = [&](int columns) {
      const auto used = start.basis.leftCols(columns);
      Matrix13 jtj = Matrix13::Zero();
      Vector13 jtr = Vector13::Zero(), step = Vector13::Zero();
      jtj.topLeftCorner(columns, columns) = used.transpose() * sums.jtj * used;
      jtr.head(columns) = used.transpose() * sums.jtr;
      bool frozen[13] = {};
      for (int i = 0; i < columns; ++i)
        frozen[i] = squares.isActiveBound(start.from.model, -jtr[i] * used.col(i));
      if (!dampedSolve<13>(jtj, jtr, columns, frozen, DAMPING, step))
        return 0.0;
      const double gain = -jtr.head(columns).dot(step.head(columns));
      return std::max(gain, 0.0) / (unit_ * unit_);
    };
    return promised(all) - promised(all - start.taper);
  }
  ShapeCandidate fit(const TaperStart& start) const {
    const auto found =
        fitTaperedBody(points_, start.from.model, start.basis, limits_, contributor_);
    ShapeCandidate c;
    c.shape = ShapeClass::TAPERED;
    c.before = start.family;
    c.upright = start.from.upright;
    c.parameters = static_cast<int>(start.basis.cols());
    c.cost = found.equations.cost / (unit_ * unit_);
    c.bic = c.cost + c.parameters * std::log(problem_.observations()) + TAPER;
    c.model = found.model;
    return c;
  }

private:
  using Matrix13 = Eigen::Matrix<double, 13, 13>;

  const ViewProblem& problem_;
  const UnitPoints& points_;
  LmOptions limits_;
  double unit_; ///< what a residual of one sigma costs
  PlaneSums planes_;
  ContributorOf<13> contributor_;
};

/** \brief The solid of revolution most like a tapered body. */
ShapeCandidate rounded(ShapeCandidate c) {
  c.before = ShapeClass::ROTATIONAL;
  c.model.semi_axes.head<2>().setConstant(
      std::sqrt(c.model.semi_axes.x() * c.model.semi_axes.y()));
  c.model.epsilon2 = 1.0;
  c.model.kx = c.model.ky = 0.5 * (c.model.kx + c.model.ky);
  return c;
}

/** \brief The dual description of a tapered body's section. */
ShapeCandidate bevelled(ShapeCandidate c) {
  c.before = ShapeClass::GENERIC;
  c.model = dual(c.model);
  c.model.kx = c.model.ky = 0.5 * (c.model.kx + c.model.ky);
  return c;
}

/** \brief A tapered body with its axis turned upright. */
ShapeCandidate standingUp(ShapeCandidate c, const Eigen::Vector3d& up) {
  c.upright = true;
  c.model = upright(c.model, 2, up);
  return c;
}

/** \brief Tapered bodies from the search's own starts, the best few. */
std::vector<ShapeCandidate> searchTapers(const ViewProblem& problem) {
  const TaperedFamily rough(problem,
                            problem.coarse(),
                            std::max(WIDE, 2.0 * problem.noise()),
                            ROUGH_ITERATIONS);
  std::vector<ShapeCandidate> candidates;
  for (const Superquadric& start : viewStarts(problem)) {
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
  candidates.resize(std::min(candidates.size(), tuning::fit_taper::KEPT));
  return candidates;
}

} // namespace

std::optional<ShapeCandidate> fitTaper(const ViewProblem& problem,
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
  const TaperedFamily quick(problem, problem.coarse(), sigma);
  const TaperedFamily thorough(problem, problem.medium(), sigma);
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

void fitTaperAgain(const ViewProblem& problem,
                   const UnitPoints& points,
                   double sigma,
                   ShapeCandidate& chosen) {
  const ShapeCandidate fitted =
      TaperedFamily(problem, points, sigma).fit(taperStart(problem, chosen, 2));
  chosen.bic += fitted.cost - chosen.cost; // which may be scaled by the misfit
  chosen.cost = fitted.cost;
  chosen.model = fitted.model;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// The families of superquadrics (M15) and their fits from a general one.
#include "families/families.h"
#include "tuning/view_tuning.h"
#include "util/parallel_for.h"
#include "view_fit/search_view.h"
#include "view_problem/shape_spaces.h"

#include <array>
#include <functional>

namespace pcl_sq::detail {

namespace {

using namespace tuning::view_shapes;

/** \brief A solid of revolution that slides along its axis. */
ParameterSpace coaxialSpace() {
  ParameterSpace space = standing(ParameterSpace::rotational(), 2);
  int columns = 0;
  for (int c = 0; c < space.basis.cols(); ++c)
    if (space.basis(0, c) == 0.0 && space.basis(1, c) == 0.0)
      space.basis.col(columns++) = space.basis.col(c);
  space.basis.conservativeResize(11, columns);
  return space;
}

void makeMember(Superquadric& m, ShapeClass shape) {
  if (shape == ShapeClass::ROTATIONAL) {
    m.semi_axes[0] = m.semi_axes[1] = std::sqrt(m.semi_axes[0] * m.semi_axes[1]);
    m.epsilon2 = 1.0;
  }
  if (shape == ShapeClass::BOX)
    m.epsilon1 = m.epsilon2 = BOX_EPSILON;
  if (shape == ShapeClass::ELLIPSOID)
    m.epsilon1 = m.epsilon2 = 1.0;
}

/** \brief Whether a cross-section is far from round. */
bool flat(const Superquadric& m) {
  return std::abs(std::log(m.semi_axes[0] / m.semi_axes[1])) > 0.4;
}

/** \brief Twice the most that a candidate may cost to be better than one of a given
 * cost for its fewer parameters. */
double farAbove(double cost, const ViewProblem& problem) {
  constexpr double PARAMETERS = 8.0;
  const double n = problem.observations();
  return 2.0 * (cost + PARAMETERS * std::log(n) * std::max(1.0, cost / n));
}

constexpr int DESCRIBED = 6; ///< steps from another description

class Families {
public:
  /** \param[in] general fit; those are given up that stay far above it */
  Families(const ViewProblem& problem, const Trial& general)
      : problem_(problem),
        sigma_(general.sigma), hopeless_{JUDGED, farAbove(general.cost, problem)} {}

  /** \brief Members of a family from a start; fitted by take(). */
  void fit(ShapeClass shape, const Superquadric& start, int upright_axis) {
    tasks_.push_back([=](std::vector<ShapeCandidate>& found) {
      fitFamily(shape, start, upright_axis, found);
    });
  }
  void fitCoaxial(const Superquadric& other, const Superquadric& start) {
    tasks_.push_back(
        [=](std::vector<ShapeCandidate>& found) { fitOnAxis(other, start, found); });
  }
  /** \brief A general fit as it is. */
  void keep(const Trial& t) {
    tasks_.push_back([=](std::vector<ShapeCandidate>& found) {
      ShapeCandidate c;
      c.cost = t.cost;
      c.bic = t.cost + c.parameters * std::log(problem_.observations());
      c.model = t.model;
      found.push_back(c);
    });
  }
  /** \brief Fits all; the best of each family. */
  std::vector<ShapeCandidate> take() {
    std::vector<std::vector<ShapeCandidate>> found(tasks_.size());
    parallelFor(tasks_.size(), problem_.options().threads, [&](std::size_t i) {
      tasks_[i](found[i]);
    });
    std::vector<ShapeCandidate> best;
    for (const auto& candidates : found)
      for (const ShapeCandidate& c : candidates)
        add(c, best);
    return best;
  }

private:
  void fitFamily(ShapeClass shape,
                 Superquadric start,
                 int upright_axis,
                 std::vector<ShapeCandidate>& found) const {
    Trial t;
    t.sigma = sigma_;
    ParameterSpace space = spaceOf(shape);
    if (upright_axis >= 0) {
      start = upright(start, upright_axis, problem_.up());
      space = standing(space, upright_axis);
    }
    t.model = start;
    makeMember(t.model, shape);
    found.push_back(run(shape, t, space, upright_axis >= 0, false));
    if (shape != ShapeClass::ROTATIONAL || !problem_.hasView() || !flat(start))
      return;
    // a deep cross-section may be the guess of a shallow one: the front stays in place
    const double front = start.support(problem_.view());
    start.semi_axes[0] = start.semi_axes[1] = start.semi_axes.head<2>().minCoeff();
    start.epsilon2 = 1.0;
    start.center += (start.support(problem_.view()) - front) * problem_.view();
    t.model = start;
    found.push_back(run(shape, t, space, upright_axis >= 0, false));
  }
  void fitOnAxis(const Superquadric& other,
                 const Superquadric& start,
                 std::vector<ShapeCandidate>& found) const {
    Trial t;
    t.sigma = sigma_;
    t.model = start;
    t.model.rotation = other.rotation;
    const Eigen::Vector3d axis = other.rotation.col(2);
    t.model.center = other.center + axis * axis.dot(start.center - other.center);
    int along;
    (start.rotation.transpose() * axis).cwiseAbs().maxCoeff(&along);
    const double a3 = start.semi_axes[along];
    const double rest = std::sqrt(start.semi_axes.prod() / a3);
    t.model.semi_axes = {rest, rest, a3};
    t.model.epsilon1 = std::min(start.epsilon1, 1.0);
    t.model.epsilon2 = 1.0;
    found.push_back(run(ShapeClass::ROTATIONAL, t, coaxialSpace(), false, true));
  }
  ShapeCandidate run(ShapeClass shape,
                     const Trial& start,
                     const ParameterSpace& space,
                     bool is_upright,
                     bool on_axis) const {
    const Trial t = problem_.minimise(start,
                                      problem_.medium(),
                                      kernels::Residual::FOOT_POINT,
                                      ITERATIONS,
                                      space,
                                      false,
                                      hopeless_);
    ShapeCandidate c;
    c.shape = shape;
    c.upright = is_upright;
    c.on_axis = on_axis;
    c.parameters = static_cast<int>(space.basis.cols());
    c.cost = t.cost;
    c.bic = t.cost + c.parameters * std::log(problem_.observations()) -
            (on_axis ? SHARED_AXIS : 0.0);
    c.model = t.model;
    return c;
  }
  static void add(const ShapeCandidate& c, std::vector<ShapeCandidate>& best) {
    for (ShapeCandidate& other : best)
      if (other.shape == c.shape && other.upright == c.upright &&
          other.on_axis == c.on_axis) {
        if (c.bic < other.bic)
          other = c;
        return;
      }
    best.push_back(c);
  }

  const ViewProblem& problem_;
  double sigma_;
  Hopeless hopeless_;
  std::vector<std::function<void(std::vector<ShapeCandidate>&)>> tasks_;
};

/** \brief The best of a model's other descriptions: exponents exchanged, the dual. */
Trial bestDescription(const ViewProblem& problem, Trial best) {
  for (int round = 0; round < 2; ++round) {
    Trial next = best;
    const Superquadric others[] = {dual(best.model),
                                   withAxis(best.model, 0),
                                   withAxis(best.model, 1),
                                   dual(withAxis(best.model, 0)),
                                   dual(withAxis(best.model, 1))};
    std::array<Trial, 5> trials;
    parallelFor(trials.size(), problem.options().threads, [&](std::size_t i) {
      trials[i] = best;
      trials[i].model = others[i];
      trials[i] = problem.minimise(trials[i],
                                   problem.medium(),
                                   kernels::Residual::FOOT_POINT,
                                   DESCRIBED,
                                   {},
                                   false,
                                   {DESCRIBED / 2, farAbove(best.cost, problem)});
    });
    for (const Trial& t : trials)
      if (t.cost < next.cost)
        next = t;
    const bool settled = next.cost > best.cost - 1.0;
    best = next;
    if (settled)
      break;
  }
  return best;
}

} // namespace

void fitAgain(const ViewProblem& problem,
              const UnitPoints& points,
              double sigma,
              ShapeCandidate& chosen) {
  if (chosen.shape == ShapeClass::TAPERED) {
    fitTaperAgain(problem, points, sigma, chosen);
    return;
  }
  if (chosen.shape == ShapeClass::BENT) {
    fitBentAgain(problem, points, sigma, chosen);
    return;
  }
  if (chosen.shape == ShapeClass::VESSEL) {
    fitVesselAgain(problem, points, sigma, chosen);
    return;
  }
  Trial t;
  t.sigma = sigma;
  t.model = chosen.model;
  ParameterSpace space = chosen.on_axis ? coaxialSpace() : spaceOf(chosen.shape);
  for (int k = 0; k < 3 && chosen.upright; ++k)
    if (std::abs(t.model.rotation.col(k).dot(problem.up())) > UPRIGHT)
      space = standing(space, k);
  t = problem.minimise(t, points, kernels::Residual::FOOT_POINT, ITERATIONS, space);
  chosen.bic += t.cost - chosen.cost;
  chosen.cost = t.cost;
  chosen.model = t.model;
}

std::vector<ShapeCandidate> fitShapes(const ViewProblem& problem, const Trial& first) {
  const bool choose = problem.options().choose_shape;
  const Trial general = choose ? bestDescription(problem, first) : first;
  Families families(problem, general);
  const Superquadric& m = general.model;
  if (choose)
    families.fit(ShapeClass::GENERIC, m, -1);
  else
    families.keep(general);
  if (!choose)
    return families.take();
  int standing_axis = -1;
  if (problem.hasUp()) {
    const double cosine =
        (m.rotation.transpose() * problem.up()).cwiseAbs().maxCoeff(&standing_axis);
    if (cosine < UPRIGHT)
      standing_axis = -1;
  }
  for (int k = 0; k < 3; ++k) {
    families.fit(ShapeClass::ROTATIONAL, withAxis(m, k), -1);
    if (k == standing_axis)
      families.fit(ShapeClass::ROTATIONAL, withAxis(m, k), 2);
  }
  families.fit(ShapeClass::BOX, m, -1);
  families.fit(ShapeClass::ELLIPSOID, m, -1);
  if (standing_axis >= 0) {
    families.fit(ShapeClass::GENERIC, m, standing_axis);
    families.fit(ShapeClass::BOX, m, standing_axis);
    families.fit(ShapeClass::ELLIPSOID, m, standing_axis);
  }
  if (problem.options().coaxial)
    families.fitCoaxial(problem.frame().toUnit(*problem.options().coaxial), m);
  return families.take();
}

} // namespace pcl_sq::detail

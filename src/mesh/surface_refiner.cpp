// SPDX-License-Identifier: BSD-3-Clause
// Splitting of edges: the part of SurfaceRemesher that adds vertices.
#include "mesh/surface_remesher.h"

#include "mesh/triangle_shape.h"

#include <queue>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t MAX_TRIANGLES = 400000; ///< where splitting ends
constexpr int PEAK_STEPS = 14;                ///< of the golden section: 0.1 %
constexpr int ROOT_STEPS = 80; ///< bisection alone reaches the last bit in 60
constexpr double GOLDEN = 0.6180339887498949;

/** \brief Way from a point in a part along the unit vector \a outward to its surface.
 */
double heightAlong(const Superquadric& part,
                   const Eigen::Vector3d& point,
                   const Eigen::Vector3d& outward) {
  const auto value = [&](double s) { return part.gauge(point + s * outward) - 1.0; };
  double a = 0.0, fa = value(0.0);
  if (fa >= 0.0)
    return 0.0;
  double step = 1.2 * std::abs(part.firstOrderDistance(point)), b = 0.0, fb = fa;
  while (fb < 0.0) {
    a = b;
    fa = fb;
    b += step;
    fb = value(b);
    step *= 2.0;
  }
  // regula falsi, the end that stays halved (Illinois)
  for (int i = 0; i < ROOT_STEPS && std::abs(fb) > 1e-13; ++i) {
    double c = i % 8 == 7 ? 0.5 * (a + b) : (a * fb - b * fa) / (fb - fa);
    if (!(std::min(a, b) <= c && c <= std::max(a, b)))
      c = 0.5 * (a + b);
    const double fc = value(c);
    if ((fc < 0.0) != (fb < 0.0)) {
      a = b;
      fa = fb;
    } else {
      fa *= 0.5;
    }
    b = c;
    fb = fc;
  }
  return b;
}

/** \brief Where in [low, high] a function with one peak is largest. */
template <typename Function>
double peakOf(const Function& f, double low, double high) {
  double left = high - GOLDEN * (high - low), right = low + GOLDEN * (high - low);
  double at_left = f(left), at_right = f(right);
  for (int i = 0; i < PEAK_STEPS; ++i) {
    if (at_left > at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - GOLDEN * (high - low);
      at_left = f(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + GOLDEN * (high - low);
      at_right = f(right);
    }
  }
  return 0.5 * (low + high);
}

} // namespace

bool SurfaceRemesher::bulges(Index a, Index b, Bulge& found) const {
  std::array<Index, 2> beside{};
  const Eigen::Vector3d& p = mesh_.position(a);
  const Eigen::Vector3d side = mesh_.position(b) - p;
  const double length = side.norm();
  if (length < 2.0 * tolerance_ || !mesh_.beside(a, b, beside))
    return false;
  found.a = a;
  found.b = b;
  if (mesh_.part(beside[0]) != mesh_.part(beside[1]))
    return seamBulges(a, b, found);
  const Superquadric& part = model_.parts[mesh_.part(beside[0])];
  double worst = 0.0;
  for (const double t : {0.5, 0.25, 0.75})
    worst = std::max(worst, std::abs(part.firstOrderDistance(p + t * side)));
  if (worst < 0.5 * tolerance_)
    return false;
  Eigen::Vector3d outward =
      doubleArea(corners(beside[0], a, p)) + doubleArea(corners(beside[1], a, p));
  outward -= side * (side.dot(outward) / (length * length));
  if (!(outward.dot(part.normal(p + 0.5 * side)) > 0.3 * outward.norm())) {
    outward = part.normal(p + 0.5 * side);
    outward -= side * (side.dot(outward) / (length * length));
  }
  if (!(outward.norm() > 0.0))
    return false;
  outward.normalize();
  const auto heightAt = [&](double t) {
    return heightAlong(part, p + t * side, outward);
  };
  const double t = peakOf(heightAt, 0.0, 1.0); // convex: there is one peak
  if (t < 0.01 || t > 0.99)
    return false;
  found.height = heightAt(t);
  found.peak = p + t * side + found.height * outward;
  return found.height > 0.0 && leavesOthers(mesh_.part(beside[0]), found.peak);
}

bool SurfaceRemesher::leavesOthers(std::size_t part, Eigen::Vector3d& peak) const {
  for (std::size_t k = 0; k < model_.size(); ++k)
    if (k != part && model_.parts[k].gauge(peak) < 1.0 - 1e-12)
      return ontoParts(model_, {part, k}, peak) && model_.gauge(peak) > 1.0 - 1e-9;
  return true;
}

bool SurfaceRemesher::seamBulges(Index a, Index b, Bulge& found) const {
  std::array<Index, 2> beside{};
  const Eigen::Vector3d &p = mesh_.position(a), &q = mesh_.position(b);
  if (!mesh_.beside(a, b, beside))
    return false;
  const Eigen::Vector3d middle = 0.5 * (p + q);
  found.peak = middle;
  if (!ontoParts(model_, {mesh_.part(beside[0]), mesh_.part(beside[1])}, found.peak))
    return false;
  found.height = (found.peak - middle).norm();
  return found.height > 0.5 * tolerance_ && found.height < (p - q).norm() &&
         model_.gauge(found.peak) > 1.0 - 1e-9; // not in a third part
}

bool SurfaceRemesher::folds(const Bulge& bulge) const {
  std::array<Index, 2> beside{};
  if (!mesh_.beside(bulge.a, bulge.b, beside))
    return true;
  for (const Index t : beside)
    for (const Index replaced : {bulge.a, bulge.b})
      if (!facesOut(corners(t, replaced, bulge.peak), mesh_.part(t)))
        return true;
  return false;
}

void SurfaceRemesher::refine() {
  // the largest bulge first: splitting a long edge beside a short one folds triangles
  std::priority_queue<Bulge> open;
  const auto add = [&](Index a, Index b) {
    Bulge found;
    if (bulges(a, b, found))
      open.push(found);
  };
  for (const auto& [a, b] : mesh_.edges())
    add(a, b);
  while (!open.empty() && mesh_.triangleCount() < MAX_TRIANGLES) {
    const Bulge top = open.top();
    open.pop();
    if (folds(top))
      continue;
    const Index added = mesh_.split(top.a, top.b, top.peak);
    for (const Index v : mesh_.neighbours(added))
      add(added, v);
    for (const Index t : mesh_.around(added)) // what folded may not do so any more
      for (int i = 0; i < 3; ++i) {
        const Index v = mesh_.triangle(t)[i], w = mesh_.triangle(t)[(i + 1) % 3];
        if (v != added && w != added)
          add(v, w);
      }
  }
}

} // namespace pcl_sq::detail

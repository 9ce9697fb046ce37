// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/surface_remesher.h"

#include "mesh/triangle_shape.h"

#include <functional>
#include <limits>
#include <queue>

namespace pcl_sq::detail {

namespace {

constexpr int ROUNDS = 4; ///< of collapsing and flipping
/** \brief Largest angle between a triangle and the surface behind it, 15 degrees: two
 * facets that share a rounding then differ by less than 30. */
constexpr double LEAST_COSINE = 0.966;
/** \brief Of triangles that collapsing makes: 20 times as long as high. */
constexpr double LEAST_SHAPE = 0.05;
/** \brief Edges up to so many tolerances may go with triangles that face aside. */
constexpr double MENDED = 20.0;

} // namespace

SurfaceRemesher::SurfaceRemesher(const PartMesh& mesh,
                                 const MultiSuperquadric& model,
                                 double tolerance)
    : mesh_(mesh), model_(model), tolerance_(tolerance) {}

SurfaceRemesher::Corners SurfaceRemesher::corners(Index triangle,
                                                  Index replaced,
                                                  const Eigen::Vector3d& by) const {
  Corners result;
  for (int i = 0; i < 3; ++i) {
    const Index v = mesh_.triangle(triangle)[i];
    result[i] = v == replaced ? by : mesh_.position(v);
  }
  return result;
}

bool SurfaceRemesher::isSeam(Index a, Index b) const {
  std::array<Index, 2> beside{};
  return mesh_.beside(a, b, beside) && mesh_.part(beside[0]) != mesh_.part(beside[1]);
}

std::vector<SurfaceRemesher::Index> SurfaceRemesher::seamNeighbours(Index v) const {
  const std::vector<Index>& around = mesh_.around(v);
  std::vector<Index> seams;
  if (std::all_of(around.begin(), around.end(), [&](Index t) {
        return mesh_.part(t) == mesh_.part(around.front());
      }))
    return seams;
  for (const Index w : mesh_.neighbours(v))
    if (isSeam(v, w))
      seams.push_back(w);
  return seams;
}

bool SurfaceRemesher::facesOut(const Corners& triangle, std::size_t part) const {
  const Eigen::Vector3d normal = doubleArea(triangle);
  const Eigen::Vector3d middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
  return normal.dot(model_.parts[part].normal(middle)) > 0.3 * normal.norm();
}

bool SurfaceRemesher::fits(const Corners& triangle, std::size_t part) const {
  const Superquadric& surface = model_.parts[part];
  const Eigen::Vector3d area = doubleArea(triangle);
  if (!(area.norm() > 0.0))
    return false;
  const Eigen::Vector3d normal = area.normalized();
  const auto near = [&](const Eigen::Vector3d& p) {
    return std::abs(surface.firstOrderDistance(p)) <= tolerance_;
  };
  const auto along = [&](const Eigen::Vector3d& p) {
    return near(p) && surface.normal(p).dot(normal) >= LEAST_COSINE;
  };
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d middle = (a + b + c) / 3.0;
  return along(middle) && near(0.5 * (a + b)) && near(0.5 * (b + c)) &&
         near(0.5 * (c + a)) && along(0.5 * (middle + a)) &&
         along(0.5 * (middle + b)) && along(0.5 * (middle + c));
}

bool SurfaceRemesher::keepsSeam(Index from, Index to) const {
  const std::vector<Index> seams = seamNeighbours(from);
  if (seams.empty())
    return true;
  // along the seam, and not where three meet
  if (seams.size() != 2 || (seams[0] != to && seams[1] != to))
    return false;
  const Index other = seams[0] == to ? seams[1] : seams[0];
  return segmentDistance(mesh_.position(from),
                         mesh_.position(other),
                         mesh_.position(to)) <= tolerance_;
}

bool SurfaceRemesher::collapses(Index from, Index to, bool weld) const {
  if (!mesh_.canCollapse(from, to) || !keepsSeam(from, to))
    return false;
  const Eigen::Vector3d &gone = mesh_.position(from), &kept = mesh_.position(to);
  // triangles that are needles already may stay so
  double worst = LEAST_SHAPE, missed = std::numeric_limits<double>::infinity();
  std::vector<Index> moved;
  for (const Index t : mesh_.around(from)) {
    worst = std::min(worst, shapeOf(corners(t, from, gone)));
    const EditMesh::Triangle& v = mesh_.triangle(t);
    if (std::find(v.begin(), v.end(), to) == v.end())
      moved.push_back(t);
  }
  for (const Index t : moved) {
    const Corners then = corners(t, from, kept);
    missed = std::min(missed, triangleDistance(gone, then));
    if (shapeOf(then) < worst)
      return false;
  }
  return (weld || missed <= tolerance_) &&
         std::all_of(moved.begin(), moved.end(), [&](Index t) {
           const Corners then = corners(t, from, kept);
           const std::size_t part = mesh_.part(t);
           return weld ? facesOut(then, part) || !facesOut(corners(t, from, gone), part)
                       : fits(then, part);
         });
}

std::size_t SurfaceRemesher::collapseAll(double longest, bool weld) {
  using Entry = std::pair<double, std::pair<Index, Index>>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto add = [&](Index a, Index b) {
    const double length = (mesh_.position(a) - mesh_.position(b)).norm();
    if (length <= longest)
      open.push({length, {std::min(a, b), std::max(a, b)}});
  };
  for (const auto& [a, b] : mesh_.edges())
    add(a, b);
  std::size_t count = 0;
  while (!open.empty()) {
    auto [from, to] = open.top().second;
    open.pop();
    if (!collapses(from, to, weld)) {
      std::swap(from, to);
      if (!collapses(from, to, weld))
        continue;
    }
    mesh_.collapse(from, to);
    ++count;
    for (const Index v : mesh_.neighbours(to))
      add(v, to);
  }
  return count;
}

void SurfaceRemesher::flipAll() {
  for (const auto& [a, b] : mesh_.edges()) {
    std::array<Index, 2> beside{};
    if (!mesh_.canFlip(a, b) || !mesh_.beside(a, b, beside) || isSeam(a, b))
      continue;
    const std::size_t part = mesh_.part(beside[0]);
    const Eigen::Vector3d &p = mesh_.position(a), &q = mesh_.position(b);
    const Eigen::Vector3d& r = mesh_.position(mesh_.opposite(beside[0], a, b));
    const Eigen::Vector3d& s = mesh_.position(mesh_.opposite(beside[1], a, b));
    const Corners now[2] = {{p, q, r}, {q, p, s}}, then[2] = {{s, q, r}, {r, p, s}};
    const bool better = std::min(shapeOf(then[0]), shapeOf(then[1])) >
                        std::min(shapeOf(now[0]), shapeOf(now[1]));
    if ((better || !fits(now[0], part) || !fits(now[1], part)) && fits(then[0], part) &&
        fits(then[1], part))
      mesh_.flip(a, b);
  }
}

void SurfaceRemesher::weld(double longest) {
  collapseAll(longest, true);
}

void SurfaceRemesher::coarsen() {
  for (int round = 0; round < ROUNDS; ++round) {
    const std::size_t before = mesh_.triangleCount();
    const std::size_t count =
        collapseAll(std::numeric_limits<double>::infinity(), false);
    flipAll();
    if (100 * count < before)
      break;
  }
  mend();
}

void SurfaceRemesher::mend() {
  for (const auto& [a, b] : mesh_.edges()) {
    std::array<Index, 2> beside{};
    if (!mesh_.beside(a, b, beside) ||
        (mesh_.position(a) - mesh_.position(b)).norm() > MENDED * tolerance_)
      continue;
    const Index kept = a; // a lambda of C++17 takes no part of a pair
    const bool wrong = std::any_of(beside.begin(), beside.end(), [&](Index t) {
      return !facesOut(corners(t, kept, mesh_.position(kept)), mesh_.part(t));
    });
    if (!wrong)
      continue;
    if (collapses(a, b, true))
      mesh_.collapse(a, b);
    else if (collapses(b, a, true))
      mesh_.collapse(b, a);
  }
}

} // namespace pcl_sq::detail

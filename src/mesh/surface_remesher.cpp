// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/surface_remesher.h"

#include "mesh/triangle_shape.h"

#include <functional>
#include <limits>
#include <queue>

namespace pcl_sq::detail {

namespace {

constexpr int ROUNDS = 4; ///< of collapsing and flipping
/** \brief Of triangles that collapsing makes: 20 times as long as high. */
constexpr double LEAST_SHAPE = 0.05;
/** \brief Edges up to so many tolerances may go with triangles that face aside. */
constexpr double MENDED = 20.0;

} // namespace

SurfaceRemesher::SurfaceRemesher(const PartMesh& mesh,
                                 const MultiSuperquadric& model,
                                 double tolerance)
    : mesh_(mesh), model_(model), tolerance_(tolerance),
      lost_(mesh.mesh.triangles.size()) {}

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
  if (!mesh_.beside(a, b, beside))
    return false;
  const std::size_t j = mesh_.part(beside[0]), k = mesh_.part(beside[1]);
  if (j == k)
    return false;
  const Eigen::Vector3d middle = 0.5 * (mesh_.position(a) + mesh_.position(b));
  return model_.parts[j].normal(middle).dot(model_.parts[k].normal(middle)) < ALONG;
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

bool SurfaceRemesher::keepsLost(const std::vector<Eigen::Vector3d>& lost,
                                const std::vector<Corners>& triangles) const {
  return std::all_of(lost.begin(), lost.end(), [&](const Eigen::Vector3d& p) {
    return std::any_of(triangles.begin(), triangles.end(), [&](const Corners& t) {
      return triangleDistance(p, t) <= tolerance_;
    });
  });
}

std::vector<Eigen::Vector3d>
SurfaceRemesher::lostAt(const std::vector<Index>& triangles) const {
  std::vector<Eigen::Vector3d> lost;
  for (const Index t : triangles)
    lost.insert(lost.end(), lost_[t].begin(), lost_[t].end());
  return lost;
}

void SurfaceRemesher::assign(const std::vector<Eigen::Vector3d>& lost,
                             const std::vector<Index>& triangles) {
  for (const Index t : triangles)
    lost_[t].clear();
  for (const Eigen::Vector3d& p : lost) {
    Index nearest = triangles.front();
    double least = std::numeric_limits<double>::infinity();
    for (const Index t : triangles) {
      const Index v = mesh_.triangle(t)[0];
      const double distance = triangleDistance(p, corners(t, v, mesh_.position(v)));
      if (distance < least) {
        least = distance;
        nearest = t;
      }
    }
    lost_[nearest].push_back(p);
  }
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
  double worst = LEAST_SHAPE; // triangles that are needles already may stay so
  std::vector<Index> moved;
  std::vector<Corners> then;
  for (const Index t : mesh_.around(from)) {
    worst = std::min(worst, shapeOf(corners(t, from, gone)));
    const EditMesh::Triangle& v = mesh_.triangle(t);
    if (std::find(v.begin(), v.end(), to) != v.end())
      continue;
    moved.push_back(t);
    then.push_back(corners(t, from, kept));
  }
  if (std::any_of(then.begin(), then.end(), [&](const Corners& t) {
        return shapeOf(t) < worst;
      }))
    return false;
  std::vector<Eigen::Vector3d> lost = lostAt(mesh_.around(from));
  lost.push_back(gone);
  if (!keepsLost(lost, then))
    return false;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const std::size_t part = mesh_.part(moved[i]);
    if (weld ? !facesOut(then[i], part) && facesOut(corners(moved[i], from, gone), part)
             : !fits(then[i], part))
      return false;
  }
  return true;
}

void SurfaceRemesher::collapse(Index from, Index to) {
  std::vector<Index> moved = mesh_.around(from);
  std::vector<Eigen::Vector3d> lost = lostAt(moved);
  lost.push_back(mesh_.position(from));
  mesh_.collapse(from, to);
  moved.erase(std::remove_if(moved.begin(),
                             moved.end(),
                             [&](Index t) {
                               const EditMesh::Triangle& v = mesh_.triangle(t);
                               return v[0] == v[1]; // gone
                             }),
              moved.end());
  assign(lost, moved);
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
    collapse(from, to);
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
    const std::vector<Index> both = {beside[0], beside[1]};
    const std::vector<Eigen::Vector3d> lost = lostAt(both);
    if ((better || !fits(now[0], part) || !fits(now[1], part)) && fits(then[0], part) &&
        fits(then[1], part) && keepsLost(lost, {then[0], then[1]})) {
      mesh_.flip(a, b);
      assign(lost, both);
    }
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
      collapse(a, b);
    else if (collapses(b, a, true))
      collapse(b, a);
  }
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/surface_remesher.h"

#include "geometry/taper.h"
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
  return model_.parts[j].normal(middle).dot(model_.parts[k].normal(middle)) <
         LEAST_COSINE;
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

bool SurfaceRemesher::isNear(const Eigen::Vector3d& point,
                             std::size_t part,
                             Eigen::Vector3d& normal) const {
  // the tangent planes of all parts near by
  planes_.clear();
  bool own = false;
  for (std::size_t k = 0; k < model_.size(); ++k) {
    const Superquadric& body = model_.parts[k];
    const Eigen::Vector3d local = body.toLocal(point);
    if ((local.cwiseAbs() - body.halfSizes()).maxCoeff() > tolerance_)
      continue;
    const Place place = placeOf(body, local);
    const double gauge = std::exp(place.gauge.value);
    const Eigen::Vector3d slope = gauge * logGradient(body, place);
    const double length = slope.norm();
    if (!(length > 0.0))
      return false; // in the middle of it
    const double distance = (gauge - 1.0) / length;
    if (distance < -tolerance_)
      return false;
    if (distance > tolerance_)
      continue;
    planes_.push_back({body.rotation * slope / length, distance});
    if (k == part) {
      own = true;
      normal = planes_.back().normal;
    }
  }
  if (!own && !planes_.empty())
    normal = std::min_element(planes_.begin(), planes_.end(), [](const auto& a, const auto& b) {
               return a.distance < b.distance;
             })->normal;
  // a foot on one of them or on the seam of two that is in none
  const auto isOut = [&](const Eigen::Vector3d& step) {
    return step.squaredNorm() <= tolerance_ * tolerance_ &&
           std::all_of(planes_.begin(), planes_.end(), [&](const Plane& p) {
             return p.distance + p.normal.dot(step) > -1e-3 * tolerance_;
           });
  };
  for (const Plane& p : planes_)
    if (isOut(-p.distance * p.normal))
      return true;
  for (const Plane& p : planes_)
    for (const Plane& q : planes_) {
      const double cosine = p.normal.dot(q.normal), sine2 = 1.0 - cosine * cosine;
      if (&p < &q && sine2 > 1e-9 &&
          isOut(((q.distance * cosine - p.distance) * p.normal +
                 (p.distance * cosine - q.distance) * q.normal) /
                sine2))
        return true;
    }
  return false;
}

bool SurfaceRemesher::fits(const Corners& triangle, std::size_t part) const {
  const Eigen::Vector3d area = doubleArea(triangle);
  if (!(area.norm() > 0.0))
    return false;
  const Eigen::Vector3d normal = area.normalized();
  Eigen::Vector3d there;
  const auto near = [&](const Eigen::Vector3d& p) { return isNear(p, part, there); };
  const auto along = [&](const Eigen::Vector3d& p) {
    return near(p) && there.dot(normal) >= LEAST_COSINE;
  };
  const auto& [a, b, c] = triangle;
  const Eigen::Vector3d middle = (a + b + c) / 3.0;
  return along(middle) && near(0.5 * (a + b)) && near(0.5 * (b + c)) &&
         near(0.5 * (c + a)) && along(0.5 * (middle + a)) &&
         along(0.5 * (middle + b)) && along(0.5 * (middle + c));
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

// SPDX-License-Identifier: BSD-3-Clause
#include "scene/mesh_bvh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>

namespace pcl_sq::app {
namespace {

constexpr std::uint32_t LEAF_SIZE = 4;
constexpr double NO_HIT = std::numeric_limits<double>::infinity();

/** \brief Entry of the ray into the box, or NO_HIT (slab test). */
double enter(const Eigen::Vector3d& min,
             const Eigen::Vector3d& max,
             const Eigen::Vector3d& origin,
             const Eigen::Vector3d& inverse,
             double t_max) {
  double from = 0.0, to = t_max;
  for (int k = 0; k < 3; ++k) {
    double a = (min[k] - origin[k]) * inverse[k];
    double b = (max[k] - origin[k]) * inverse[k];
    if (a > b)
      std::swap(a, b);
    // NaN (0 * inf, on the slab's border) fails both comparisons and changes nothing
    if (a > from)
      from = a;
    if (b < to)
      to = b;
  }
  return from <= to ? from : NO_HIT;
}

/** \brief Moeller & Trumbore 1997. \param[out] front whether hit from outside */
double hitTriangle(const Eigen::Vector3d& a,
                   const Eigen::Vector3d& b,
                   const Eigen::Vector3d& c,
                   const Eigen::Vector3d& origin,
                   const Eigen::Vector3d& direction,
                   bool* front) {
  const Eigen::Vector3d e1 = b - a, e2 = c - a;
  const Eigen::Vector3d p = direction.cross(e2);
  const double det = e1.dot(p);
  if (det == 0.0)
    return NO_HIT;
  const Eigen::Vector3d s = origin - a;
  const double u = s.dot(p) / det;
  if (u < 0.0 || u > 1.0)
    return NO_HIT;
  const Eigen::Vector3d q = s.cross(e1);
  const double v = direction.dot(q) / det;
  if (v < 0.0 || u + v > 1.0)
    return NO_HIT;
  *front = det > 0.0;
  return e2.dot(q) / det;
}

/** \brief Squared distance to a triangle (Ericson 2005, Real-Time Collision Detection,
 * 5.1.5). */
double squaredDistance(const Eigen::Vector3d& p,
                       const Eigen::Vector3d& a,
                       const Eigen::Vector3d& b,
                       const Eigen::Vector3d& c) {
  const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0)
    return ap.squaredNorm();
  const Eigen::Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3)
    return bp.squaredNorm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3)
    return (ap - d1 / (d1 - d3) * ab).squaredNorm();
  const Eigen::Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6)
    return cp.squaredNorm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6)
    return (ap - d2 / (d2 - d6) * ac).squaredNorm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6 && d4 - d3 + d5 - d6 > 0.0)
    return (bp - (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b)).squaredNorm();
  const double sum = va + vb + vc;
  if (sum == 0.0) // no area: its corners are as good
    return std::min({ap.squaredNorm(), bp.squaredNorm(), cp.squaredNorm()});
  return (ap - (vb / sum) * ab - (vc / sum) * ac).squaredNorm();
}

double squaredDistance(const Eigen::Vector3d& p,
                       const Eigen::Vector3d& min,
                       const Eigen::Vector3d& max) {
  return (min - p).cwiseMax(p - max).cwiseMax(0.0).squaredNorm();
}

} // namespace

MeshBvh::MeshBvh(TriangleMesh mesh) : mesh_(std::move(mesh)) {
  const auto count = static_cast<std::uint32_t>(mesh_.triangles.size());
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0u);
  centers_.reserve(count);
  for (const auto& t : mesh_.triangles) {
    centers_.push_back(
        (mesh_.vertices[t[0]] + mesh_.vertices[t[1]] + mesh_.vertices[t[2]]) / 3.0);
    for (const std::uint32_t v : t)
      box_.extend(mesh_.vertices[v]);
  }
  if (count == 0)
    return;
  nodes_.reserve(2 * static_cast<std::size_t>(count));
  nodes_.emplace_back();
  build(0, 0, count);
}

void MeshBvh::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
  Eigen::AlignedBox3d box, center_box;
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const std::uint32_t v : mesh_.triangles[order_[i]])
      box.extend(mesh_.vertices[v]);
    center_box.extend(centers_[order_[i]]);
  }
  nodes_[node].min = box.min();
  nodes_[node].max = box.max();
  if (count <= LEAF_SIZE) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  int axis = 0;
  center_box.sizes().maxCoeff(&axis);
  const std::uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](auto a, auto b) {
    return centers_[a][axis] < centers_[b][axis];
  });
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  nodes_.emplace_back();
  nodes_[node].first = left;
  build(left, first, half);
  build(left + 1, first + half, count - half);
}

template <typename Visit>
void MeshBvh::walkRay(const Eigen::Vector3d& origin,
                      const Eigen::Vector3d& direction,
                      Visit&& visit) const {
  if (nodes_.empty())
    return;
  const Eigen::Vector3d inverse = direction.cwiseInverse();
  double limit = NO_HIT; // lowered by the visitor
  std::uint32_t stack[64];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    if (enter(node.min, node.max, origin, inverse, limit) == NO_HIT)
      continue;
    if (node.count == 0) {
      stack[top++] = node.first;
      stack[top++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto& t = mesh_.triangles[order_[i]];
      bool front = false;
      const double at = hitTriangle(mesh_.vertices[t[0]],
                                    mesh_.vertices[t[1]],
                                    mesh_.vertices[t[2]],
                                    origin,
                                    direction,
                                    &front);
      if (at > 0.0 && at != NO_HIT && !visit(order_[i], at, front, &limit))
        return;
    }
  }
}

RayHit MeshBvh::intersect(const Eigen::Vector3d& origin,
                          const Eigen::Vector3d& direction,
                          double t_max) const {
  RayHit hit;
  walkRay(
      origin, direction, [&](std::uint32_t triangle, double t, bool, double* limit) {
        if (t < t_max && t < hit.t) {
          hit.t = t;
          hit.triangle = triangle;
          *limit = t;
        }
        return true;
      });
  return hit;
}

bool MeshBvh::occluded(const Eigen::Vector3d& origin,
                       const Eigen::Vector3d& direction,
                       double t_max) const {
  bool found = false;
  walkRay(origin, direction, [&](std::uint32_t, double t, bool, double*) {
    found = found || t < t_max;
    return !found;
  });
  return found;
}

bool MeshBvh::contains(const Eigen::Vector3d& point) const {
  if (nodes_.empty() || !box_.contains(point))
    return false;
  // odd directions: no ray of a symmetric mesh runs along an edge; two of three decide
  const Eigen::Vector3d directions[] = {
      {0.3713, 0.5591, 0.7413}, {-0.6917, 0.4421, 0.5711}, {0.2129, -0.8017, 0.5584}};
  int votes = 0;
  for (const Eigen::Vector3d& direction : directions) {
    int winding = 0;
    walkRay(point, direction, [&](std::uint32_t, double, bool front, double*) {
      winding += front ? -1 : 1;
      return true;
    });
    votes += winding != 0 ? 1 : 0;
  }
  return votes >= 2;
}

bool MeshBvh::isEnclosed(const Eigen::Vector3d& point) const {
  if (nodes_.empty() || !box_.contains(point))
    return false;
  const Eigen::Vector3d sides[] = {
      {1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, -1.0, 0.0}};
  bool walls = true;
  for (const Eigen::Vector3d& side : sides)
    walls = walls && occluded(point, side);
  return walls;
}

double MeshBvh::distance(const Eigen::Vector3d& point) const {
  double best = NO_HIT;
  if (nodes_.empty())
    return best;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const Node& node = nodes_[stack.back()];
    stack.pop_back();
    if (squaredDistance(point, node.min, node.max) >= best)
      continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto& t = mesh_.triangles[order_[i]];
      best = std::min(
          best,
          squaredDistance(
              point, mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]));
    }
    if (node.count != 0)
      continue;
    // the nearer child last, so that it is looked at first
    const Node& left = nodes_[node.first];
    const Node& right = nodes_[node.first + 1];
    const bool left_first = squaredDistance(point, left.min, left.max) <
                            squaredDistance(point, right.min, right.max);
    stack.push_back(left_first ? node.first + 1 : node.first);
    stack.push_back(left_first ? node.first : node.first + 1);
  }
  return std::sqrt(best);
}

Eigen::Vector3d MeshBvh::normal(std::uint32_t triangle) const {
  const auto& t = mesh_.triangles[triangle];
  return (mesh_.vertices[t[1]] - mesh_.vertices[t[0]])
      .cross(mesh_.vertices[t[2]] - mesh_.vertices[t[0]])
      .normalized();
}

} // namespace pcl_sq::app

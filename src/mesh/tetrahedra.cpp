// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/tetrahedra.h"

#include "geometry/bend.h"

#include <algorithm>
#include <array>
#include <limits>

namespace pcl_sq::detail {

namespace {

/** \brief Added to the gauges of each further part, so that surfaces that coincide are
 * those of the first. */
constexpr double APART = 1e-9;
constexpr int EDGES[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
constexpr std::size_t MOST = 3000000; ///< tetrahedra, where bisecting ends
constexpr double GAP = 1.5;           ///< largest over mean, where a gauge bends evenly
constexpr double DIAGONAL = 1.74;     ///< of a cube
constexpr double NONE_HERE = -1.0;
constexpr double ALL_INSIDE = std::numeric_limits<double>::infinity();

} // namespace

Tetrahedra::Tetrahedra(const MultiSuperquadric& model, double tolerance, double longest)
    : model_(model), straight_(model.parts), tolerance_(tolerance), longest_(longest) {
  for (Superquadric& part : straight_)
    part.kx = part.ky = part.bend = 0.0;
  lists_.emplace_back();
  for (std::size_t k = 0; k < model.size(); ++k)
    lists_[0].push_back(k);
  double side = longest;
  while (side < 0.2 * model.boundingBox().sizes().maxCoeff())
    side *= 2.0;
  addCubes(side);
  // breadth first: if there are too many, the coarse ones have had their turn
  while (!open_.empty()) {
    const std::size_t t = open_.front();
    open_.pop_front();
    if (!all_[t].gone && ((!all_[t].fine && all_.size() < MOST) || hangs(all_[t])))
      bisect(t);
  }
}

Tetrahedra::Index Tetrahedra::addVertex(const Eigen::Vector3d& position) {
  positions_.push_back(position);
  offsets_.resize(positions_.size() * model_.size(),
                  std::numeric_limits<double>::quiet_NaN());
  return Index(positions_.size() - 1);
}

double Tetrahedra::offset(Index vertex, std::size_t part) {
  double& known = offsets_[vertex * model_.size() + part];
  if (std::isnan(known))
    known = model_.parts[part].gauge(positions_[vertex]) - 1.0 + double(part) * APART;
  return known;
}

void Tetrahedra::addCubes(double side) {
  const Eigen::AlignedBox3d box = model_.boundingBox();
  const Eigen::Array3d low = (box.min() / side).array().floor();
  const Eigen::Array3d high = (box.max() / side).array().ceil();
  const Eigen::Array3i n = (high - low).cast<int>() + 1; // vertices
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x)
        addVertex(side * (low + Eigen::Array3d(x, y, z)).matrix());
  // each along the cube's sides from corner 0 to corner 7
  static constexpr int PATHS[6][2] = {{1, 3}, {2, 3}, {2, 6}, {4, 6}, {4, 5}, {1, 5}};
  for (int z = 0; z + 1 < n[2]; ++z)
    for (int y = 0; y + 1 < n[1]; ++y)
      for (int x = 0; x + 1 < n[0]; ++x)
        for (const auto& path : PATHS) {
          const int corners[4] = {0, path[0], path[1], 7};
          std::array<Index, 4> vertices{};
          for (int i = 0; i < 4; ++i) {
            const int c = corners[i];
            vertices[i] =
                Index(((z + (c >> 2)) * n[1] + y + (c >> 1 & 1)) * n[0] + x + (c & 1));
          }
          add(vertices, 3, 0);
        }
}

bool Tetrahedra::isBesideBend(const std::array<Index, 4>& vertices,
                              const Superquadric& body) const {
  // around the circle's centre and opposite of the body straightening tears apart what
  // is close together, and no bisecting would end there
  double farthest = 0.0;
  double least = ALL_INSIDE, most = -ALL_INSIDE; // angles, 0 to 2 pi
  for (const Index v : vertices) {
    const Eigen::Vector3d unbent = detail::unbent(body, body.toLocal(position(v)));
    farthest = std::max(farthest, fibre(body, unbent));
    const double angle = std::abs(body.bend) * unbent.z();
    const double around = angle < 0.0 ? angle + 2.0 * M_PI : angle;
    least = std::min(least, around);
    most = std::max(most, around);
  }
  const double end = std::abs(body.bend) * body.semi_axes.z();
  // nearer to the centre than any of the body; a distance is largest at a corner
  return farthest < 1.0 - Superquadric::MAX_FOLD ||
         (least > end && most < 2.0 * M_PI - end && most - least < M_PI);
}

double Tetrahedra::error(const std::array<Index, 4>& vertices, std::size_t part) {
  const Superquadric& body = model_.parts[part];
  if (body.isBent() && isBesideBend(vertices, body))
    return NONE_HERE;
  double largest = -ALL_INSIDE, length = 0.0, bend = 0.0;
  std::array<double, 4> offsets{};
  std::array<Eigen::Vector3d, 4> straight;
  for (int i = 0; i < 4; ++i) {
    offsets[i] = offset(vertices[i], part);
    largest = std::max(largest, offsets[i]);
    straight[i] = body.straightened(position(vertices[i]));
  }
  for (const auto& [a, b] : EDGES) {
    const Eigen::Vector3d &p = position(vertices[a]), &q = position(vertices[b]);
    length = std::max(length, (p - q).norm());
    if (body.isDeformed()) // how far the edge bends where the body is straight
      bend = std::max(
          bend,
          (body.straightened(0.5 * (p + q)) - 0.5 * (straight[a] + straight[b]))
              .norm());
  }
  // twice the bend of the edges covers that of the middle; no gauge is steeper than
  // that of an octahedron
  const double slack = 2.0 * bend * std::sqrt(3.0) / body.semi_axes.minCoeff();
  if (largest + slack <= 0.0)
    return ALL_INSIDE;
  const Superquadric& tangent = straight_[part];
  const Eigen::Vector3d middle =
      0.25 * (straight[0] + straight[1] + straight[2] + straight[3]);
  const Eigen::Vector3d slope = tangent.gaugeGradient(middle);
  const double at_middle = tangent.gauge(middle) - 1.0;
  double lowest = ALL_INSIDE, gap = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double plane = at_middle + slope.dot(straight[i] - middle) - slack;
    lowest = std::min(lowest, plane);
    gap += 0.25 * (offsets[i] - plane);
  }
  if (lowest > 0.0)
    return NONE_HERE;
  // Of a quadratic function the largest gap is one to two times the mean of those at
  // the corners. Going uphill makes up for it at least as fast as the slope says; where
  // that is not known, on ridges of thin parts, nothing in here is farther than the
  // sides are long.
  return std::min(GAP * std::max(gap, 0.0) / slope.norm(), length);
}

void Tetrahedra::add(const std::array<Index, 4>& vertices,
                     int bisected,
                     std::size_t parts) {
  std::vector<std::size_t> crossing;
  double worst = 0.0;
  for (const std::size_t k : lists_[parts]) {
    const double e = error(vertices, k);
    if (e == ALL_INSIDE)
      return;
    if (e >= 0.0)
      crossing.push_back(k);
    worst = std::max(worst, e);
  }
  if (crossing.empty())
    return;
  Tetrahedron t;
  t.vertices = vertices;
  t.bisected = bisected;
  t.parts = parts;
  if (crossing != lists_[parts]) {
    t.parts = lists_.size();
    lists_.push_back(crossing);
  }
  const Eigen::Vector3d way = position(vertices[0]) - position(vertices[bisected]);
  t.fine = worst <= tolerance_ && way.norm() < DIAGONAL * longest_;
  bool hanging = false;
  for (std::size_t i = 0; i < 6; ++i) {
    Edge& edge = edges_[key(vertices[EDGES[i][0]], vertices[EDGES[i][1]])];
    t.next[i] = edge.first;
    edge.first = all_.size() * 6 + i;
    hanging = hanging || edge.middle != NONE;
  }
  if (!t.fine || hanging)
    open_.push_back(all_.size());
  all_.push_back(t);
}

bool Tetrahedra::hangs(const Tetrahedron& t) const {
  return std::any_of(std::begin(EDGES), std::end(EDGES), [&](const auto& e) {
    return edges_.at(key(t.vertices[e[0]], t.vertices[e[1]])).middle != NONE;
  });
}

void Tetrahedra::bisect(std::size_t index) {
  all_[index].gone = true;
  const Tetrahedron t = all_[index];
  const std::array<Index, 4>& v = t.vertices;
  const int d = t.bisected;
  Edge& edge = edges_[key(v[0], v[d])];
  if (edge.middle == NONE) {
    edge.middle = addVertex(0.5 * (position(v[0]) + position(v[d])));
    for (std::uint64_t use = edge.first; use != NO_USE;
         use = all_[use / 6].next[use % 6])
      if (!all_[use / 6].gone)
        open_.push_back(use / 6);
  }
  std::array<Index, 4> near = v, far = v;
  near[d] = edge.middle; // v0 ... v(d-1), middle, the rest
  for (int i = 0; i < d; ++i)
    far[i] = v[i + 1]; // v1 ... vd, middle, the rest
  far[d] = edge.middle;
  for (const auto& half : {near, far})
    add(half, d == 1 ? 3 : d - 1, t.parts);
}

std::vector<Tetrahedra::Cell> Tetrahedra::cells() const {
  std::vector<Cell> result;
  for (const Tetrahedron& t : all_)
    if (!t.gone) {
      result.push_back({t.vertices, &lists_[t.parts]});
      std::sort(result.back().vertices.begin(), result.back().vertices.end());
    }
  return result;
}

} // namespace pcl_sq::detail

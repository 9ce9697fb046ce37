// SPDX-License-Identifier: BSD-3-Clause
// Marching tetrahedra: in each the gauges of all parts are taken to be linear, so that
// a part's surface is a polygon, and what of it lies in other parts is clipped off: the
// surface is closed, and where parts meet there are edges.
#include "mesh/union_mesh.h"

#include "mesh/tetrahedra.h"

#include <algorithm>
#include <map>

namespace pcl_sq::detail {

namespace {

using Index = Tetrahedra::Index;

constexpr Index NO_VERTEX = ~Index(0);
constexpr int BISECTIONS = 50;

/** \brief Where a vertex comes from: corners of the grid's edge, face or tetrahedron,
 * and the parts whose surfaces meet there; neighbours find each other's by it. */
struct Origin {
  std::array<Index, 4> corners;
  std::vector<std::size_t> parts;
  bool operator<(const Origin& o) const {
    return corners != o.corners ? corners < o.corners : parts < o.parts;
  }
};

/** \brief A tetrahedron with the parts whose surfaces cross it. */
struct Cell {
  std::array<Index, 4> ids; ///< of the corners, ascending: neighbours get the same bits
  std::vector<std::size_t> parts;
  std::vector<std::array<double, 4>> offsets; ///< G - 1 of each of them at the corners
};

/** \brief A corner of a polygon in a tetrahedron. */
struct Node {
  std::array<double, 4> weights{}; ///< of the tetrahedron's corners
  std::vector<std::size_t> parts;  ///< indices into Cell::parts

  double value(const std::array<double, 4>& corners) const {
    double sum = 0.0;
    for (int i = 0; i < 4; ++i)
      sum += weights[i] * corners[i];
    return sum;
  }
};

class TetrahedraMarcher {
public:
  TetrahedraMarcher(const MultiSuperquadric& model, Tetrahedra& grid)
      : model_(model), grid_(grid) {}

  PartMesh run() {
    for (const Tetrahedra::Cell& around : grid_.cells()) {
      Cell cell;
      cell.ids = around.vertices;
      bool filled = false;
      for (const std::size_t k : *around.parts) {
        std::array<double, 4> offsets{};
        for (int i = 0; i < 4; ++i)
          offsets[i] = grid_.offset(cell.ids[i], k);
        const auto inside = std::count_if(
            offsets.begin(), offsets.end(), [](double g) { return g <= 0.0; });
        filled = filled || inside == 4;
        if (inside > 0) {
          cell.parts.push_back(k);
          cell.offsets.push_back(offsets);
        }
      }
      for (std::size_t k = 0; k < cell.parts.size() && !filled; ++k)
        polygon(cell, k);
    }
    return std::move(result_);
  }

private:
  /** \brief The part k's own share of the surface in a tetrahedron. */
  void polygon(const Cell& t, std::size_t k) {
    const std::array<double, 4>& offsets = t.offsets[k];
    std::array<int, 4> in{}, out{};
    int n_in = 0, n_out = 0;
    for (int i = 0; i < 4; ++i)
      (offsets[i] <= 0.0 ? in[n_in++] : out[n_out++]) = i;
    const auto cut = [&](int i, int o) {
      const int a = std::min(i, o), b = std::max(i, o); // neighbours get the same bits
      Node node;
      node.weights[b] = offsets[a] / (offsets[a] - offsets[b]);
      node.weights[a] = 1.0 - node.weights[b];
      node.parts = {k};
      return node;
    };
    std::vector<Node> nodes;
    if (n_in == 1)
      nodes = {cut(in[0], out[0]), cut(in[0], out[1]), cut(in[0], out[2])};
    else if (n_in == 3)
      nodes = {cut(in[0], out[0]), cut(in[1], out[0]), cut(in[2], out[0])};
    else
      nodes = {cut(in[0], out[0]),
               cut(in[0], out[1]),
               cut(in[1], out[1]),
               cut(in[1], out[0])};
    // counter-clockwise seen from where the gauge grows
    const auto linear = [&](const Node& node) {
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      for (int i = 0; i < 4; ++i)
        p += node.weights[i] * grid_.position(t.ids[i]);
      return p;
    };
    const Eigen::Vector3d first = linear(nodes[0]);
    const Eigen::Vector3d area =
        (linear(nodes[1]) - first).cross(linear(nodes[2]) - first);
    if (area.dot(grid_.position(t.ids[in[0]]) - first) > 0.0)
      std::reverse(nodes.begin(), nodes.end());
    for (std::size_t j = 0; j < t.parts.size() && nodes.size() > 2; ++j)
      if (j != k)
        nodes = clip(nodes, t, j, k);
    if (nodes.size() < 3)
      return;
    std::vector<std::uint32_t> corners;
    for (const Node& node : nodes)
      corners.push_back(vertex(t, node, linear(node)));
    for (std::size_t i = 2; i < corners.size(); ++i) {
      result_.mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
      result_.part.push_back(t.parts[k]);
    }
  }

  /** \brief What of a polygon of part k lies outside of part j. */
  static std::vector<Node>
  clip(const std::vector<Node>& nodes, const Cell& t, std::size_t j, std::size_t k) {
    std::vector<Node> kept;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Node &a = nodes[i], &b = nodes[(i + 1) % nodes.size()];
      const double at_a = a.value(t.offsets[j]), at_b = b.value(t.offsets[j]);
      if (at_a > 0.0)
        kept.push_back(a);
      if ((at_a > 0.0) == (at_b > 0.0))
        continue;
      const bool swap = b.weights < a.weights;
      const Node &p = swap ? b : a, &q = swap ? a : b;
      const double at_p = swap ? at_b : at_a, at_q = swap ? at_a : at_b;
      Node node;
      const double share = at_p / (at_p - at_q);
      for (int c = 0; c < 4; ++c)
        node.weights[c] = (1.0 - share) * p.weights[c] + share * q.weights[c];
      node.parts = {j, k};
      for (const std::size_t other : a.parts) // the edge is a seam with a third part
        if (other != k && std::count(b.parts.begin(), b.parts.end(), other) > 0)
          node.parts.push_back(other);
      kept.push_back(node);
    }
    return kept;
  }

  std::uint32_t vertex(const Cell& t, const Node& node, const Eigen::Vector3d& linear) {
    Origin origin;
    for (int i = 0; i < 4; ++i)
      origin.corners[i] = node.weights[i] != 0.0 ? t.ids[i] : NO_VERTEX;
    std::sort(origin.corners.begin(), origin.corners.end());
    for (const std::size_t k : node.parts)
      origin.parts.push_back(t.parts[k]);
    std::sort(origin.parts.begin(), origin.parts.end());
    const auto [it, added] =
        vertices_.try_emplace(origin, std::uint32_t(result_.mesh.vertices.size()));
    if (added)
      result_.mesh.vertices.push_back(exact(origin, linear));
    return it->second;
  }

  /** \brief The vertex on the exact surface; where surfaces nearly coincide, so that
   * their seam is far away, on one of them. */
  Eigen::Vector3d exact(const Origin& origin, const Eigen::Vector3d& linear) const {
    Eigen::Vector3d a = grid_.position(origin.corners[0]),
                    b = grid_.position(origin.corners[1]);
    const double reach = 0.5 * (a - b).norm();
    std::vector<std::size_t> parts = origin.parts;
    Eigen::Vector3d p = linear;
    const auto moveOntoParts = [&] {
      Eigen::Vector3d seam = p;
      if (!ontoParts(model_, parts, seam) || (seam - linear).norm() > reach)
        return false;
      p = seam;
      return true;
    };
    if (parts.size() > 1) {
      moveOntoParts();
    } else { // on an edge of the grid, by bisection
      const Superquadric& part = model_.parts[parts[0]];
      if (part.gauge(a) > 1.0)
        a.swap(b);
      for (int i = 0; i < BISECTIONS; ++i) {
        p = 0.5 * (a + b);
        (part.gauge(p) <= 1.0 ? a : b) = p;
      }
    }
    const std::size_t other = deepest(p);
    if (std::abs(model_.parts[other].gauge(p) - 1.0) < 1e-9)
      return p;
    parts.push_back(other); // linear gauges saw it outside
    return moveOntoParts() ? p : model_.parts[other].closestPoint(p);
  }

  std::size_t deepest(const Eigen::Vector3d& p) const {
    std::size_t best = 0;
    double smallest = model_.parts[0].gauge(p);
    for (std::size_t k = 1; k < model_.size(); ++k)
      if (const double gauge = model_.parts[k].gauge(p); gauge < smallest) {
        smallest = gauge;
        best = k;
      }
    return best;
  }

  const MultiSuperquadric& model_;
  Tetrahedra& grid_;
  PartMesh result_;
  std::map<Origin, std::uint32_t> vertices_;
};

} // namespace

PartMesh marchUnion(const MultiSuperquadric& model, double tolerance, double longest) {
  if (model.empty())
    return {};
  // ridges of the largest part are on faces of the grid
  const Superquadric& largest =
      *std::max_element(model.parts.begin(),
                        model.parts.end(),
                        [](const Superquadric& a, const Superquadric& b) {
                          return a.volume() < b.volume();
                        });
  MultiSuperquadric turned = model;
  for (Superquadric& part : turned.parts) {
    part.center = largest.toLocal(part.center);
    part.rotation = largest.rotation.transpose() * part.rotation;
  }
  Tetrahedra grid(turned, tolerance, longest);
  PartMesh result = TetrahedraMarcher(turned, grid).run();
  for (Eigen::Vector3d& v : result.mesh.vertices)
    v = largest.toWorld(v);
  return result;
}

} // namespace pcl_sq::detail

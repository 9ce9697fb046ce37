// SPDX-License-Identifier: BSD-3-Clause
// Marching tetrahedra: each grid cell is cut into six tetrahedra around its main
// diagonal, the same in every cell, so that neighbours share their faces. In each the
// gauges of all parts are taken to be linear, so that a part's surface is a polygon,
// and what of it lies in other parts is clipped off: the surface is closed, and where
// parts meet there are edges.
#include "mesh/union_mesh.h"

#include <algorithm>
#include <map>

namespace pcl_sq::detail {

namespace {

constexpr int MIN_RESOLUTION = 8;
constexpr int MAX_RESOLUTION = 512;
constexpr int MOST_FINER = 8; ///< cells along one axis for the sake of thin parts
constexpr int BISECTIONS = 50;
/** \brief Added to the gauges of each further part, so that surfaces that coincide are
 * those of the first. */
constexpr double APART = 1e-9;

/** \brief Where a vertex comes from: corners of the grid's edge, face or tetrahedron,
 * and the parts whose surfaces meet there; neighbours find each other's by it. */
struct Origin {
  std::array<std::int64_t, 4> corners;
  std::vector<std::size_t> parts;
  bool operator<(const Origin& o) const {
    return corners != o.corners ? corners < o.corners : parts < o.parts;
  }
};

struct Tetrahedron {
  std::array<std::int64_t, 4> ids;            ///< of the corners
  std::vector<std::size_t> parts;             ///< whose surfaces cross it
  std::vector<std::array<double, 4>> offsets; ///< G - 1 of each of them at the corners
};

/** \brief A corner of a polygon in a tetrahedron. */
struct Node {
  std::array<double, 4> weights{}; ///< of the tetrahedron's corners
  std::vector<std::size_t> parts;  ///< indices into Tetrahedron::parts

  double value(const std::array<double, 4>& corners) const {
    double sum = 0.0;
    for (int i = 0; i < 4; ++i)
      sum += weights[i] * corners[i];
    return sum;
  }
};

class TetrahedraMarcher {
public:
  TetrahedraMarcher(const MultiSuperquadric& model, int resolution) : model_(model) {
    const Eigen::AlignedBox3d box = model.boundingBox();
    const double coarse =
        box.sizes().maxCoeff() / std::clamp(resolution, MIN_RESOLUTION, MAX_RESOLUTION);
    for (int k = 0; k < 3; ++k) {
      cell_[k] = coarse;
      for (const Superquadric& part : model.parts) {
        // two cells across the part, or it slips through the grid
        const double half = 1.0 / part.gauge(part.center + Eigen::Vector3d::Unit(k));
        cell_[k] = std::min(cell_[k], std::max(0.9 * half, coarse / MOST_FINER));
      }
    }
    // a margin of more than one cell, off the surface by an odd fraction
    origin_ = box.min() - 1.37 * cell_;
    for (int k = 0; k < 3; ++k)
      n_[k] =
          static_cast<std::int64_t>(std::ceil(box.sizes()[k] / cell_[k] + 2.74)) + 1;
    for (const Superquadric& part : model.parts)
      radii_.push_back(part.semi_axes.norm());
  }

  PartMesh run() {
    std::vector<double> below = layer(0), above;
    for (std::int64_t z = 0; z + 1 < n_[2]; ++z) {
      above = layer(z + 1);
      for (std::int64_t y = 0; y + 1 < n_[1]; ++y)
        for (std::int64_t x = 0; x + 1 < n_[0]; ++x)
          cell(x, y, z, below, above);
      below.swap(above);
    }
    return std::move(result_);
  }

private:
  Eigen::Vector3d position(std::int64_t id) const {
    const std::int64_t x = id % n_[0], y = id / n_[0] % n_[1], z = id / (n_[0] * n_[1]);
    return origin_ +
           cell_.cwiseProduct(Eigen::Vector3d(double(x), double(y), double(z)));
  }

  /** \brief G - 1 of each part, of all parts for each point of a layer. */
  std::vector<double> layer(std::int64_t z) const {
    const std::size_t parts = model_.size(), points = std::size_t(n_[0] * n_[1]);
    std::vector<double> values(parts * points);
    const double reach = cell_.maxCoeff();
    for (std::size_t i = 0; i < points; ++i) {
      const Eigen::Vector3d p = position(z * n_[0] * n_[1] + std::int64_t(i));
      for (std::size_t k = 0; k < parts; ++k) {
        // away from the part's box only the sign matters
        const Superquadric& part = model_.parts[k];
        const Eigen::Array3d beyond =
            part.toLocal(p).array().abs() - part.semi_axes.array();
        const double far = beyond.maxCoeff();
        values[i * parts + k] =
            (far > 2.0 * reach ? far / reach : part.gauge(p) - 1.0) + double(k) * APART;
      }
    }
    return values;
  }

  void cell(std::int64_t x,
            std::int64_t y,
            std::int64_t z,
            const std::vector<double>& below,
            const std::vector<double>& above) {
    const std::size_t parts = model_.size();
    std::array<std::int64_t, 8> ids;
    std::array<const double*, 8> values;
    for (int c = 0; c < 8; ++c) {
      const std::int64_t in_layer = (y + (c >> 1 & 1)) * n_[0] + x + (c & 1);
      const std::int64_t dz = c >> 2 & 1;
      ids[c] = (z + dz) * n_[0] * n_[1] + in_layer;
      values[c] = (dz ? above : below).data() + std::size_t(in_layer) * parts;
    }
    bool crossed = false;
    for (std::size_t k = 0; k < parts; ++k) {
      int inside = 0;
      for (int c = 0; c < 8; ++c)
        inside += values[c][k] <= 0.0;
      if (inside == 8)
        return;
      crossed = crossed || inside > 0;
    }
    if (!crossed)
      return;
    static constexpr int PATHS[6][2] = {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}};
    for (const auto& path : PATHS) { // all positively oriented
      const int corners[4] = {0, path[0], path[1], 7};
      Tetrahedron t;
      bool filled = false;
      for (int i = 0; i < 4; ++i)
        t.ids[i] = ids[corners[i]];
      for (std::size_t k = 0; k < parts && !filled; ++k) {
        std::array<double, 4> offsets;
        int inside = 0;
        for (int i = 0; i < 4; ++i) {
          offsets[i] = values[corners[i]][k];
          inside += offsets[i] <= 0.0;
        }
        filled = inside == 4;
        if (inside > 0) {
          t.parts.push_back(k);
          t.offsets.push_back(offsets);
        }
      }
      for (std::size_t k = 0; k < t.parts.size() && !filled; ++k)
        polygon(t, k);
    }
  }

  /** \brief The part k's own share of the surface in a tetrahedron. */
  void polygon(const Tetrahedron& t, std::size_t k) {
    const std::array<double, 4>& offsets = t.offsets[k];
    std::array<int, 4> in{}, out{};
    int n_in = 0, n_out = 0;
    for (int i = 0; i < 4; ++i)
      (offsets[i] <= 0.0 ? in[n_in++] : out[n_out++]) = i;
    const auto cut = [&](int i, int o) {
      // from the smaller to the larger number, so that neighbours get the same bits
      const int a = t.ids[i] < t.ids[o] ? i : o, b = t.ids[i] < t.ids[o] ? o : i;
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
    for (std::size_t j = 0; j < t.parts.size() && nodes.size() > 2; ++j)
      if (j != k)
        nodes = clip(nodes, t, j, k);
    if (nodes.size() < 3)
      return;
    // counter-clockwise seen from where the gauge grows
    const auto linear = [&](const Node& node) {
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      for (int i = 0; i < 4; ++i)
        p += node.weights[i] * position(t.ids[i]);
      return p;
    };
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    const Eigen::Vector3d first = linear(nodes[0]);
    for (std::size_t i = 2; i < nodes.size(); ++i)
      area += (linear(nodes[i - 1]) - first).cross(linear(nodes[i]) - first);
    if (area.dot(position(t.ids[in[0]]) - first) > 0.0)
      std::reverse(nodes.begin(), nodes.end());
    std::vector<std::uint32_t> corners;
    for (const Node& node : nodes)
      corners.push_back(vertex(t, node, linear(node)));
    for (std::size_t i = 2; i < corners.size(); ++i) {
      result_.mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
      result_.part.push_back(t.parts[k]);
    }
  }

  /** \brief What of a polygon of part k lies outside of part j. */
  static std::vector<Node> clip(const std::vector<Node>& nodes,
                                const Tetrahedron& t,
                                std::size_t j,
                                std::size_t k) {
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

  std::uint32_t
  vertex(const Tetrahedron& t, const Node& node, const Eigen::Vector3d& linear) {
    Origin origin;
    for (int i = 0; i < 4; ++i)
      origin.corners[i] = node.weights[i] != 0.0 ? t.ids[i] : -1;
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

  /** \brief The vertex on the exact surface. */
  Eigen::Vector3d exact(const Origin& origin, const Eigen::Vector3d& linear) const {
    std::vector<std::size_t> parts = origin.parts;
    Eigen::Vector3d p = linear;
    if (parts.size() == 1) { // on an edge of the grid, by bisection
      const Superquadric& part = model_.parts[parts[0]];
      Eigen::Vector3d a = position(origin.corners[2]), b = position(origin.corners[3]);
      if (part.gauge(a) > 1.0)
        a.swap(b);
      for (int i = 0; i < BISECTIONS; ++i) {
        p = 0.5 * (a + b);
        (part.gauge(p) <= 1.0 ? a : b) = p;
      }
      const std::size_t other = deepest(p);
      if (other == parts[0] || model_.parts[other].gauge(p) > 1.0 - 1e-12)
        return p;
      parts.push_back(other); // linear gauges saw it outside
      p = model_.parts[other].closestPoint(p);
    }
    Eigen::Vector3d seam = p;
    if (ontoParts(model_, parts, seam) &&
        (seam - linear).norm() < 2.0 * cell_.maxCoeff() &&
        model_.gauge(seam) > 1.0 - 1e-9)
      return seam;
    for (int i = 0; i < BISECTIONS;
         ++i) { // out of one part into another, and out again
      const Superquadric& part = model_.parts[deepest(p)];
      if (std::abs(part.gauge(p) - 1.0) < 1e-12)
        break;
      p = part.closestPoint(p);
    }
    return p;
  }

  std::size_t deepest(const Eigen::Vector3d& p) const {
    std::size_t best = 0;
    double smallest = model_.parts[0].gauge(p);
    for (std::size_t k = 1; k < model_.size(); ++k) {
      if ((p - model_.parts[k].center).norm() > radii_[k] * std::max(smallest, 1.0))
        continue;
      const double gauge = model_.parts[k].gauge(p);
      if (gauge < smallest) {
        smallest = gauge;
        best = k;
      }
    }
    return best;
  }

  const MultiSuperquadric& model_;
  Eigen::Vector3d cell_, origin_; ///< [m]
  std::array<std::int64_t, 3> n_{};
  std::vector<double> radii_; ///< of a ball about each part's centre that holds it
  PartMesh result_;
  std::map<Origin, std::uint32_t> vertices_;
};

} // namespace

PartMesh marchUnion(const MultiSuperquadric& model, int resolution) {
  if (model.empty())
    return {};
  // along the axes of the largest part thin plates are where the grid is fine
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
  PartMesh result = TetrahedraMarcher(turned, resolution).run();
  for (Eigen::Vector3d& v : result.mesh.vertices)
    v = largest.toWorld(v);
  return result;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// Marching tetrahedra: each grid cell is cut into six tetrahedra around its main
// diagonal, the same in every cell, so that neighbours share their faces and the mesh
// is closed.
#include "union_mesh.h"

#include <algorithm>
#include <unordered_map>

namespace pcl_sq::detail {

namespace {

constexpr int MIN_RESOLUTION = 8;
constexpr int MAX_RESOLUTION = 512;

class TetrahedraMarcher {
public:
  TetrahedraMarcher(const MultiSuperquadric& model, int resolution) : model_(model) {
    const Eigen::AlignedBox3d box = model.boundingBox();
    cell_ =
        box.sizes().maxCoeff() / std::clamp(resolution, MIN_RESOLUTION, MAX_RESOLUTION);
    // a margin of more than one cell, off the surface by an odd fraction
    origin_ = box.min() - Eigen::Vector3d::Constant(1.37 * cell_);
    for (int k = 0; k < 3; ++k)
      n_[k] = static_cast<std::int64_t>(std::ceil(box.sizes()[k] / cell_ + 2.74)) + 1;
  }

  TriangleMesh run() {
    std::vector<double> below = layer(0), above;
    for (std::int64_t z = 0; z + 1 < n_[2]; ++z) {
      above = layer(z + 1);
      for (std::int64_t y = 0; y + 1 < n_[1]; ++y)
        for (std::int64_t x = 0; x + 1 < n_[0]; ++x)
          cell(x, y, z, below, above);
      below.swap(above);
    }
    return std::move(mesh_);
  }

private:
  struct Corner {
    std::int64_t id;
    double value; ///< G - 1
  };

  Eigen::Vector3d position(std::int64_t id) const {
    const std::int64_t x = id % n_[0], y = id / n_[0] % n_[1], z = id / (n_[0] * n_[1]);
    return origin_ + cell_ * Eigen::Vector3d(double(x), double(y), double(z));
  }

  std::vector<double> layer(std::int64_t z) const {
    std::vector<double> values(n_[0] * n_[1]);
    for (std::int64_t i = 0; i < n_[0] * n_[1]; ++i)
      values[i] = model_.gauge(position(z * n_[0] * n_[1] + i)) - 1.0;
    return values;
  }

  void cell(std::int64_t x,
            std::int64_t y,
            std::int64_t z,
            const std::vector<double>& below,
            const std::vector<double>& above) {
    std::array<Corner, 8> corners;
    int inside = 0;
    for (int c = 0; c < 8; ++c) {
      const std::int64_t in_layer = (y + (c >> 1 & 1)) * n_[0] + x + (c & 1);
      const std::int64_t dz = c >> 2 & 1;
      corners[c] = {(z + dz) * n_[0] * n_[1] + in_layer,
                    (dz ? above : below)[in_layer]};
      inside += corners[c].value <= 0.0;
    }
    if (inside == 0 || inside == 8)
      return;
    static constexpr int PATHS[6][2] = {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}};
    for (const auto& path : PATHS) // all positively oriented
      tetrahedron({corners[0], corners[path[0]], corners[path[1]], corners[7]});
  }

  void tetrahedron(const std::array<Corner, 4>& t) {
    std::array<int, 4> in{}, out{};
    int n_in = 0, n_out = 0;
    for (int i = 0; i < 4; ++i)
      (t[i].value <= 0.0 ? in[n_in++] : out[n_out++]) = i;
    const auto cut = [&](int i, int o) { return crossing(t[i], t[o]); };
    if (n_in == 1)
      triangle(cut(in[0], out[0]), cut(in[0], out[1]), cut(in[0], out[2]), t[in[0]]);
    else if (n_in == 3)
      triangle(cut(in[0], out[0]), cut(in[1], out[0]), cut(in[2], out[0]), t[in[0]]);
    else if (n_in == 2) {
      const auto a = cut(in[0], out[0]), b = cut(in[0], out[1]), c = cut(in[1], out[1]),
                 d = cut(in[1], out[0]);
      triangle(a, b, c, t[in[0]]);
      triangle(a, c, d, t[in[0]]);
    }
  }

  /** \brief Adds a triangle, turned so that \a inside is behind it. */
  void
  triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Corner& inside) {
    if (a == b || b == c || c == a)
      return;
    const Eigen::Vector3d& p = lattice_[a];
    const Eigen::Vector3d normal = (lattice_[b] - p).cross(lattice_[c] - p);
    if (normal.dot(position(inside.id) - p) > 0.0)
      std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
  }

  /** \brief The surface point on a grid edge, by bisection; made once per edge. */
  std::uint32_t crossing(const Corner& inside, const Corner& outside) {
    const std::int64_t low = std::min(inside.id, outside.id);
    const std::int64_t step = std::max(inside.id, outside.id) - low;
    // seven kinds of edges leave a grid point; their id differences are distinct
    const std::int64_t kind = step % n_[0] % 2 + 2 * (step / n_[0] % n_[1] % 2) +
                              4 * (step / (n_[0] * n_[1]));
    const auto [it, added] =
        edges_.try_emplace(low * 8 + kind, std::uint32_t(mesh_.vertices.size()));
    if (added) {
      Eigen::Vector3d a = position(inside.id), b = position(outside.id);
      // orientation is judged on the edge's middle, where no triangle can degenerate
      lattice_.push_back(0.5 * (a + b));
      for (int i = 0; i < 40; ++i) {
        const Eigen::Vector3d middle = 0.5 * (a + b);
        (model_.gauge(middle) <= 1.0 ? a : b) = middle;
      }
      mesh_.vertices.push_back(0.5 * (a + b));
    }
    return it->second;
  }

  const MultiSuperquadric& model_;
  double cell_ = 0.0;
  Eigen::Vector3d origin_;
  std::array<std::int64_t, 3> n_{};
  TriangleMesh mesh_;
  std::vector<Eigen::Vector3d> lattice_; ///< middle of each vertex's grid edge
  std::unordered_map<std::int64_t, std::uint32_t> edges_;
};

} // namespace

TriangleMesh meshUnion(const MultiSuperquadric& model, int resolution) {
  if (model.empty())
    return {};
  return TetrahedraMarcher(model, resolution).run();
}

} // namespace pcl_sq::detail

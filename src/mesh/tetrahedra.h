// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"

#include <cstdint>
#include <deque>
#include <unordered_map>

namespace pcl_sq::detail {

/** \brief Tetrahedra around the surface of a union, so small that in each the gauges
 * may be taken to be linear.
 *
 * Cubes of six tetrahedra are bisected (Maubach 1995) where the gauges bend; a
 * neighbour with the same edge is bisected with it, so that no vertex hangs on an edge
 * and a surface made of polygons in the tetrahedra is closed. A gauge is convex: it
 * lies between its tangent plane and its linear interpolation, which tells for certain
 * how far the surface may be from the polygons, and where there is none. */
class Tetrahedra {
public:
  using Index = std::uint32_t;

  struct Cell {
    std::array<Index, 4> vertices;
    const std::vector<std::size_t>* parts; ///< whose surfaces may cross it
  };

  /** \param[in] model its parts' gauges are of use; must outlive this. The
   * grid has a vertex at the origin of its frame
   * \param[in] tolerance largest distance of polygons and surface [m]
   * \param[in] longest side of the largest cube that may stay [m] */
  Tetrahedra(const MultiSuperquadric& model, double tolerance, double longest);

  const Eigen::Vector3d& position(Index vertex) const { return positions_[vertex]; }
  /** \brief G - 1 of a part at a vertex, negative inside. */
  double offset(Index vertex, std::size_t part);
  /** \brief The tetrahedra that a surface may cross, vertices in ascending order. */
  std::vector<Cell> cells() const;

private:
  /** \brief Two ends and what is between them. */
  struct Edge {
    Index middle = NONE; ///< vertex in the middle of one that is bisected
    std::uint64_t first = NO_USE;
  };
  /** \brief Six edges; `next` chains all tetrahedra beside an edge. */
  struct Tetrahedron {
    std::array<Index, 4> vertices; ///< in Maubach's order
    int bisected = 3; ///< the edge to bisect leads from vertex 0 to this one
    std::size_t parts = 0;
    bool fine = false, gone = false;
    std::array<std::uint64_t, 6> next{};
  };
  static constexpr Index NONE = ~Index(0);
  static constexpr std::uint64_t NO_USE = ~std::uint64_t(0);

  static std::uint64_t key(Index a, Index b) {
    return std::uint64_t(std::min(a, b)) << 32U | std::max(a, b);
  }
  Index addVertex(const Eigen::Vector3d& position);
  void addCubes(double side);
  void add(const std::array<Index, 4>& vertices, int bisected, std::size_t parts);
  /** \brief Whether a tetrahedron is sure to lie beside a bent body, where it cannot be
   * straightened. */
  bool isBesideBend(const std::array<Index, 4>& vertices,
                    const Superquadric& body) const;
  /** \brief Largest distance of a part's surface and its polygon in a tetrahedron [m],
   * negative if there is no surface, infinity if it lies inside of the part. */
  double error(const std::array<Index, 4>& vertices, std::size_t part);
  bool hangs(const Tetrahedron& t) const;
  void bisect(std::size_t t);

  const MultiSuperquadric& model_;
  std::vector<Superquadric> straight_; ///< the parts without their tapers
  double tolerance_, longest_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<double> offsets_; ///< of each vertex those of all parts, NaN: not known
  std::vector<Tetrahedron> all_;
  std::vector<std::vector<std::size_t>> lists_; ///< of parts, shared by neighbours
  std::unordered_map<std::uint64_t, Edge> edges_;
  std::deque<std::size_t> open_;
};

} // namespace pcl_sq::detail

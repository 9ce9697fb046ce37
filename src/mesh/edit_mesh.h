// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/union_mesh.h"

namespace pcl_sq::detail {

/** \brief A closed mesh whose edges can be split, collapsed and flipped; it stays
 * closed, oriented and manifold, and triangles keep the part they belong to. */
class EditMesh {
public:
  using Index = std::uint32_t;
  using Triangle = std::array<Index, 3>;

  explicit EditMesh(const PartMesh& mesh);

  std::size_t triangleCount() const { return triangle_count_; }
  const Eigen::Vector3d& position(Index v) const { return vertices_[v]; }
  /** \brief Triangles around a vertex, none for one that is gone. */
  const std::vector<Index>& around(Index v) const { return around_[v]; }
  const Triangle& triangle(Index t) const { return triangles_[t]; }
  /** \brief The part a triangle belongs to. */
  std::size_t part(Index t) const { return part_[t]; }
  std::vector<Index> neighbours(Index v) const;
  /** \brief Every edge once, smaller index first. */
  std::vector<std::pair<Index, Index>> edges() const;

  /** \brief The triangles beside the edge, in the first of which b follows a.
   * \return false if there is no such edge */
  bool beside(Index a, Index b, std::array<Index, 2>& triangles) const;
  /** \brief Corner of the triangle that is neither a nor b. */
  Index opposite(Index triangle, Index a, Index b) const;

  /** \brief Puts a vertex on an edge that exists; returns it. */
  Index split(Index a, Index b, const Eigen::Vector3d& position);
  /** \brief Whether moving \a from onto \a to keeps the mesh manifold. */
  bool canCollapse(Index from, Index to) const;
  void collapse(Index from, Index to);
  /** \brief Whether the other diagonal of the two triangles is no edge yet. */
  bool canFlip(Index a, Index b) const;
  void flip(Index a, Index b);

  /** \brief The mesh without what is gone. */
  PartMesh compact() const;

private:
  void attach(Index triangle);
  void detach(Index triangle, Index vertex);

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<std::size_t> part_;
  std::vector<std::vector<Index>> around_;
  std::size_t triangle_count_ = 0;
};

} // namespace pcl_sq::detail

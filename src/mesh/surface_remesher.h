// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/edit_mesh.h"

namespace pcl_sq::detail {

/** \brief Makes a mesh of a union's surface as coarse as a tolerance permits.
 *
 * First edges are split where the surface bulges away from them, so that ridges become
 * edges; then edges are collapsed, shortest first, and flipped, as long as the
 * triangles keep near to their part's surface and along it. Vertices are on the exact
 * surface all the time: they are put there when an edge is split, and collapsing moves
 * one onto the other. Seams of parts stay edges. */
class SurfaceRemesher {
public:
  /** \param[in] mesh closed, its vertices on the surface of \a model, which must
   * outlive this \param[in] tolerance largest distance of mesh and surface [m] */
  SurfaceRemesher(const PartMesh& mesh,
                  const MultiSuperquadric& model,
                  double tolerance);

  /** \brief Merges vertices up to \a longest [m] apart. */
  void weld(double longest);
  /** \brief Splits edges until none is farther than the tolerance from the surface. */
  void refine();
  /** \brief Collapses edges and flips what thereby gets better. */
  void coarsen();

  TriangleMesh mesh() const { return mesh_.compact().mesh; }

private:
  using Index = EditMesh::Index;
  using Corners = std::array<Eigen::Vector3d, 3>;

  /** \brief A vertex that an edge lacks. */
  struct Bulge {
    double height = 0.0; ///< above the edge [m]
    Index a = 0, b = 0;
    Eigen::Vector3d peak;
    bool operator<(const Bulge& other) const { return height < other.height; }
  };

  Corners corners(Index triangle, Index replaced, const Eigen::Vector3d& by) const;
  bool isSeam(Index a, Index b) const;
  /** \brief The vertices to which the seams at a vertex lead. */
  std::vector<Index> seamNeighbours(Index v) const;
  bool bulges(Index a, Index b, Bulge& found) const;
  /** \brief Moves a new vertex of a part that is in another one onto their seam. */
  bool leavesOthers(std::size_t part, Eigen::Vector3d& peak) const;
  bool seamBulges(Index a, Index b, Bulge& found) const;
  /** \brief Whether splitting an edge turns a triangle over. */
  bool folds(const Bulge& bulge) const;
  bool facesOut(const Corners& triangle, std::size_t part) const;
  /** \brief Whether a triangle is near to the surface and along it. */
  bool fits(const Corners& triangle, std::size_t part) const;
  bool keepsSeam(Index from, Index to) const;
  bool collapses(Index from, Index to, bool weld) const;
  std::size_t collapseAll(double longest, bool weld);
  void flipAll();
  /** \brief Collapses short edges of triangles that do not face outward. */
  void mend();

  EditMesh mesh_;
  const MultiSuperquadric& model_;
  double tolerance_;
};

} // namespace pcl_sq::detail

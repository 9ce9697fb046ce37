// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/edit_mesh.h"

namespace pcl_sq::detail {

/** \brief Cosine of the largest angle between a triangle and the surface behind it, 15
 * degrees: two facets that share a rounding then differ by less than 30. Parts that
 * meet at less than that have no seam to keep. */
constexpr double ALONG = 0.966;

/** \brief Makes a mesh of a union's surface as coarse as a tolerance permits: collapses
 * edges, shortest first, and flips them, as long as the triangles keep near to the
 * surface and along it, and near to all vertices that went before. Vertices stay where
 * they are. Seams where parts meet at an angle stay edges. */
class SurfaceRemesher {
public:
  /** \param[in] mesh closed, its vertices on the surface of \a model, which must
   * outlive this \param[in] tolerance largest distance of mesh and surface [m] */
  SurfaceRemesher(const PartMesh& mesh,
                  const MultiSuperquadric& model,
                  double tolerance);

  /** \brief Merges vertices up to \a longest [m] apart. */
  void weld(double longest);
  /** \brief Collapses edges and flips what thereby gets better. */
  void coarsen();

  TriangleMesh mesh() const { return mesh_.compact().mesh; }

private:
  using Index = EditMesh::Index;
  using Corners = std::array<Eigen::Vector3d, 3>;

  /** \brief Tangent plane of a part near to a point. */
  struct Plane {
    Eigen::Vector3d normal;
    double distance; ///< of the point [m]
  };

  Corners corners(Index triangle, Index replaced, const Eigen::Vector3d& by) const;
  bool isSeam(Index a, Index b) const;
  /** \brief The vertices to which the seams at a vertex lead. */
  std::vector<Index> seamNeighbours(Index v) const;
  bool facesOut(const Corners& triangle, std::size_t part) const;
  /** \brief Whether a point is near to the union's surface; the normal is that of the
   * part named, or of the one that is nearest. */
  bool
  isNear(const Eigen::Vector3d& point, std::size_t part, Eigen::Vector3d& normal) const;
  /** \brief Whether a triangle is near to the surface and along it. */
  bool fits(const Corners& triangle, std::size_t part) const;
  bool keepsSeam(Index from, Index to) const;
  /** \brief Whether each of the vertices that went is near to one of the triangles. */
  bool keepsLost(const std::vector<Eigen::Vector3d>& lost,
                 const std::vector<Corners>& triangles) const;
  /** \brief What of the vertices that went is nearest to these triangles. */
  std::vector<Eigen::Vector3d> lostAt(const std::vector<Index>& triangles) const;
  void assign(const std::vector<Eigen::Vector3d>& lost,
              const std::vector<Index>& triangles);
  bool collapses(Index from, Index to, bool weld) const;
  void collapse(Index from, Index to);
  std::size_t collapseAll(double longest, bool weld);
  void flipAll();
  /** \brief Collapses short edges of triangles that do not face outward. */
  void mend();

  EditMesh mesh_;
  const MultiSuperquadric& model_;
  double tolerance_;
  mutable std::vector<Plane> planes_;              ///< kept for the sake of its memory
  std::vector<std::vector<Eigen::Vector3d>> lost_; ///< vertices that went, by triangle
};

} // namespace pcl_sq::detail

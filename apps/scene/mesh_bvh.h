// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/triangle_mesh.h"

#include <limits>

namespace pcl_sq::app {

/** \brief First triangle along a ray. */
struct RayHit {
  double t = std::numeric_limits<double>::infinity(); ///< along the ray
  std::uint32_t triangle = 0;
  bool found() const { return t < std::numeric_limits<double>::infinity(); }
};

/** \brief Bounding volume hierarchy over a triangle mesh: rays, distances, inside. */
class MeshBvh {
public:
  /** \brief Sorts the triangles; a mesh without any answers every question with no. */
  explicit MeshBvh(TriangleMesh mesh);

  const TriangleMesh& mesh() const { return mesh_; }
  const Eigen::AlignedBox3d& box() const { return box_; }

  /** \brief Nearest hit with t in (t_min, t_max); direction of any length. */
  RayHit intersect(const Eigen::Vector3d& origin,
                   const Eigen::Vector3d& direction,
                   double t_max = std::numeric_limits<double>::infinity()) const;
  /** \brief Whether anything is hit before t_max. */
  bool occluded(const Eigen::Vector3d& origin,
                const Eigen::Vector3d& direction,
                double t_max = std::numeric_limits<double>::infinity()) const;
  /** \brief Distance to the surface [m]. */
  double distance(const Eigen::Vector3d& point) const;
  /** \brief Whether the winding number of the closed surface(s) is not zero, so that
   * overlapping closed parts count as their union. */
  bool contains(const Eigen::Vector3d& point) const;
  /** \brief Whether a point has walls on all four sides in its plane across z: what a
   * bowl or a mug with its opening up holds. */
  bool isEnclosed(const Eigen::Vector3d& point) const;
  /** \brief Outward unit normal of a triangle. */
  Eigen::Vector3d normal(std::uint32_t triangle) const;

private:
  struct Node {
    Eigen::Vector3d min, max;
    std::uint32_t first = 0; ///< first triangle of a leaf, left child of an inner node
    std::uint32_t count = 0; ///< triangles of a leaf, 0 for inner nodes
  };
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);
  template <typename Visit>
  void walkRay(const Eigen::Vector3d& origin,
               const Eigen::Vector3d& direction,
               Visit&& visit) const;

  TriangleMesh mesh_;
  Eigen::AlignedBox3d box_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_; ///< triangles as the leaves list them
  std::vector<Eigen::Vector3d> centers_;
};

} // namespace pcl_sq::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/triangle_mesh.h"

#include <array>

namespace pcl_sq {

/** \brief A box in any pose: one link of a gripper. */
struct PCL_SQ_EXPORTS OrientedBox {
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< [m], in the cloud's frame
  /** \brief Columns: the box's axes in the cloud's frame. */
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d half_sizes = Eigen::Vector3d::Zero(); ///< [m]

  /** \brief Support function max { n.p : p in the box } [m]. */
  double support(const Eigen::Vector3d& n) const {
    return n.dot(center) + (rotation.transpose() * n).cwiseAbs().dot(half_sizes);
  }
  /** \brief Whether the point lies in the box grown by \a margin [m] on each side. */
  bool contains(const Eigen::Vector3d& point, double margin = 0.0) const {
    return ((rotation.transpose() * (point - center)).cwiseAbs().array() <=
            half_sizes.array() + margin)
        .all();
  }
  /** \brief Axis-aligned box around it. */
  Eigen::AlignedBox3d boundingBox() const {
    const Eigen::Vector3d half = rotation.cwiseAbs() * half_sizes;
    return {center - half, center + half};
  }
  /** \brief The eight corners. */
  std::array<Eigen::Vector3d, 8> corners() const;
};

/** \brief The box's surface: twelve triangles. */
PCL_SQ_EXPORTS TriangleMesh meshBox(const OrientedBox& box);

/** \brief Distance between a box and a superquadric [m], zero where they overlap.
 *
 * Gilbert, Johnson and Keerthi's algorithm (1988) on the support functions. Exact to a
 * millionth of the distance; of a tapered body that is not convex, to its hull, of a
 * hollow one to the body filled up to its rim. */
PCL_SQ_EXPORTS double distance(const OrientedBox& box,
                               const Superquadric& superquadric);

/** \brief Whether box and superquadric come nearer than \a clearance [m]; far cheaper
 * than distance(): a separating plane ends the search. A box may reach through the
 * opening of a hollow body into its hollow. */
PCL_SQ_EXPORTS bool collides(const OrientedBox& box,
                             const Superquadric& superquadric,
                             double clearance = 0.0);

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"
#include "pcl_sq/tapered_superquadric.h"

namespace pcl_sq {

/** \brief A union of superquadrics any of which may be tapered.
 *
 * Beside MultiSuperquadric and not in its place: grasps and collisions there rely on
 * every part being convex and symmetric about its centre.
 * \ingroup pcl_sq */
struct PCL_SQ_EXPORTS TaperedUnion {
  std::vector<TaperedSuperquadric> parts;

  TaperedUnion() = default;
  /** \brief The same union; no part is tapered. */
  explicit TaperedUnion(const MultiSuperquadric& model);

  bool empty() const { return parts.empty(); }
  std::size_t size() const { return parts.size(); }
  /** \brief Whether any part is tapered. */
  bool isTapered() const;

  /** \brief Gauge of the union, min_k G_k; infinity for an empty union. */
  double gauge(const Eigen::Vector3d& point) const;
  /** \brief Whether the point lies in or on any part. */
  bool contains(const Eigen::Vector3d& point) const { return gauge(point) <= 1.0; }
  /** \brief Signed distance to the parts, min_k d_k [m]: to the foot point of a tapered
   * one, Euclidean to any other; infinity for an empty union. */
  double distance(const Eigen::Vector3d& point) const;
  /** \brief Support of the convex hull, see MultiSuperquadric::support(). */
  double support(const Eigen::Vector3d& direction) const;
  /** \brief Axis-aligned bounding box in the cloud's frame. */
  Eigen::AlignedBox3d boundingBox() const;

  /** \brief Distortion D, Eq. (7), see MultiSuperquadric::distortion(): G and the
   * semi-axes of a tapered part are those before tapering. Non-finite points are left
   * out; zero without any. */
  double distortion(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                    double unit = 1.0) const;
  /** \brief Root mean square of the distance to the nearest part's foot point [m]. */
  double rmsDistance(const Eigen::Ref<const Eigen::Matrix3Xd>& points) const;
};

} // namespace pcl_sq

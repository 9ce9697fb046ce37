// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/triangle_mesh.h"

namespace pcl_sq {

/** \brief How well points lie on a union of superquadrics. */
struct SurfaceStatistics {
  double distortion = 0.0; ///< Eq. (7), each point charged to its nearest part by |G-1|
  double rms_distance = 0.0; ///< of the foot-point distance to the nearest part [m]
};

/** \brief A union of superquadrics: the paper's compact volume of an object.
 * \ingroup pcl_sq */
struct PCL_SQ_EXPORTS MultiSuperquadric {
  std::vector<Superquadric> parts;

  bool empty() const { return parts.empty(); }
  std::size_t size() const { return parts.size(); }

  /** \brief Gauge of the union, min_k G_k; infinity for an empty union. */
  double gauge(const Eigen::Vector3d& point) const;
  /** \brief Whether the point lies in or on any part. */
  bool contains(const Eigen::Vector3d& point) const { return gauge(point) <= 1.0; }
  /** \brief Part whose surface is nearest to \a point; \pre not empty. */
  std::size_t nearestPart(const Eigen::Vector3d& point) const;
  /** \brief Signed Euclidean distance to the parts, min_k d_k [m]: exact outside of the
   * union, a bound inside where parts overlap; infinity for an empty union. */
  double euclideanDistance(const Eigen::Vector3d& point) const;
  /** \brief euclideanDistance() of many points: parts whose boxes are farther than
   * another part's surface cost nothing. \param[in] points 3 x N in the cloud's frame
   * [m] \param[in] threads 0 = all cores \return N distances [m] */
  Eigen::VectorXd euclideanDistances(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                                     unsigned int threads = 1) const;
  /** \brief Support of the convex hull, max_k (n.center_k + h_k(n)) [m]: the extent of
   * the union along n, measured from the origin of the cloud's frame. */
  double support(const Eigen::Vector3d& direction) const;
  /** \brief Exact axis-aligned bounding box in the cloud's frame. */
  Eigen::AlignedBox3d boundingBox() const;

  /** \brief Distortion D, Eq. (7), each point charged to its nearest part (by gauge),
   * the sum over the points divided by their number. \param[in] points 3 x N in the
   * cloud's frame [m] \param[in] unit length of the unit in which semi-axes enter
   * sqrt(a1 a2 a3): 1 gives SI (m^1.5), 0.001 the paper's millimetres (the unit of
   * Table I; docs/paper_map.md) */
  double distortion(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                    double unit = 1.0) const;
  double distortion(const CloudPoints& points, double unit = 1.0) const;
  /** \brief distortion() in SI units and rmsDistance() in one pass over the points. */
  SurfaceStatistics statistics(const CloudPoints& points) const;
  /** \brief Root mean square of the point-to-surface distance (foot point) [m]. */
  double rmsDistance(const Eigen::Ref<const Eigen::Matrix3Xd>& points) const;
  double rmsDistance(const CloudPoints& points) const;

  /** \brief All parts as one list of closed meshes. */
  TriangleMesh meshParts(int divisions = 24) const;
  /** \brief Closed surface of the union, inner walls removed.
   * \param[in] resolution cells along the longest side of the bounding box */
  TriangleMesh meshUnion(int resolution = 96) const;
};

/** \brief The number of parts and a line for each. \relates MultiSuperquadric */
PCL_SQ_EXPORTS std::ostream& operator<<(std::ostream& stream,
                                        const MultiSuperquadric& model);

} // namespace pcl_sq

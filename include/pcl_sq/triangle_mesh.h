// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"
#include "pcl_sq/superquadric.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pcl_sq {

/** \brief Indexed triangles, counter-clockwise seen from outside.
 * \ingroup pcl_sq */
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;               ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices into vertices
};

/** \brief Closed mesh of a superquadric: directions of a cube, projected radially,
 * which stays regular down to an exponent of 0.05 (angles pile up there). With a rim:
 * rings along the outside, over the rim, down the inside to the floor. \param[in]
 * divisions quads along an edge of the cube or the outside, at least 2 */
PCL_SQ_EXPORTS TriangleMesh meshSuperquadric(const Superquadric& superquadric,
                                             int divisions = 24);

/** \brief Points uniform in area on the surface, repeatable for a seed.
 * \param[in] count number of points */
PCL_SQ_EXPORTS std::vector<Eigen::Vector3d>
sampleUniform(const Superquadric& superquadric, std::size_t count, unsigned seed = 0);

/** \brief Points about \a spacing [m] apart along the two profile curves (Pilu & Fisher
 * 1995, "Equal-distance sampling of superellipse models"); of a tapered body, before
 * tapering. With a rim as many of sampleUniform(). */
PCL_SQ_EXPORTS std::vector<Eigen::Vector3d>
sampleEqualDistance(const Superquadric& superquadric, double spacing);

} // namespace pcl_sq

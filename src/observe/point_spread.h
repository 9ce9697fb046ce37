// SPDX-License-Identifier: BSD-3-Clause
// Private. How densely points lie on their surface tells where the camera was.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace pcl_sq::detail {

/** \brief M27: pixels are spread evenly over the image, so that a surface seen at an
 * angle has fewer points, as its cosine, and one farther away fewer, as the square of
 * the distance. Points that lie evenly on their surface (a voxel grid was laid over
 * them, or a mesh sampled) tell nothing. */
class PointSpread {
public:
  /** \param[in] points in any order, strays left out */
  explicit PointSpread(const Eigen::Matrix3Xd& points);

  /** \brief Whether the points may have been seen from a place: nothing speaks for
   * another one. */
  bool allows(const Eigen::Vector3d& place) const;

  /** \brief The direction from the points to their camera, of the two from which they
   * are spread alike the one to which they bulge; nothing where the points do not tell.
   * Unit length. */
  const std::optional<Eigen::Vector3d>& direction() const { return direction_; }

private:
  struct Patch {
    Eigen::Vector3d place, normal;
    double density; ///< points' number per area, but for a factor
    double bulge;   ///< along the normal, of the middle over its surroundings [m]
  };
  /** \brief A point and what is around it, nearest first. */
  static std::optional<Patch> patchOf(const Eigen::Matrix3Xd& points,
                                      Eigen::Index middle,
                                      const std::vector<Eigen::Index>& near);
  /** \brief Of the logarithm of the points' number per pixel: how uneven it is. */
  double unevenness(const Eigen::Vector3d& place) const;
  /** \brief How far all patches face a place, or all turn away from it, their outsides
   * being those of a convex body [0, 1]. */
  double facing(const Eigen::Vector3d& place) const;

  std::vector<Patch> patches_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero(); ///< of the patches
  double least_ = 0.0; ///< unevenness from the likeliest direction
  std::optional<Eigen::Vector3d> direction_;
};

} // namespace pcl_sq::detail

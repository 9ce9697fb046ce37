// SPDX-License-Identifier: BSD-3-Clause
// Private. Which points of a cloud are neighbours, and what hangs together by them.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pcl_sq::detail {

/** \brief Columns of points that belong together. */
using Segment = std::vector<int>;

/** \brief Points linked to their nearest neighbours. */
class CloudGraph {
public:
  explicit CloudGraph(const Eigen::Matrix3Xd& points);

  /** \brief Distance to the last of a point's neighbours, the middle one of all [m]. */
  double reach() const { return reach_; }

  /** \brief What hangs together among some points, the largest first. */
  std::vector<Segment> components(const Segment& some) const;

  /** \brief Some points by their limbs: what is apart far out along a way and grows
   * together farther in. One list of segments for each way that shows any: along the
   * given axes, to both sides, and from the middle along the surface.
   * \param[in] axes columns of unit length \param[in] fewest points of a limb */
  std::vector<std::vector<Segment>>
  limbs(const Segment& some, const Eigen::Matrix3d& axes, std::size_t fewest) const;

  /** \brief Whether two sets of points are neighbours. */
  bool touch(const Segment& a, const Segment& b) const;

private:
  std::vector<Segment> branches(const Segment& some,
                                const std::vector<double>& height,
                                std::size_t fewest) const;
  /** \brief Length of the way along links from the point nearest to the middle. */
  std::vector<double> wayFromMiddle(const Segment& some) const;

  const Eigen::Matrix3Xd& points_;
  std::vector<std::vector<int>> links_;
  double reach_ = 0.0;
};

} // namespace pcl_sq::detail

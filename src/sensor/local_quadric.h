// SPDX-License-Identifier: BSD-3-Clause
// Private. Neighbours of points and the curved surfaces through them.
#pragma once

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace pcl_sq::detail {

/** \brief Nearest neighbours among every stride-th point.
 *
 * The points are kept in their order along the longest side of their box: a search
 * looks at a slab of them. */
class Neighbourhood {
public:
  Neighbourhood(const Eigen::Matrix3Xd& points, Eigen::Index stride);

  /** \brief Columns of the \a count points nearest to the i-th one, of which there are
   * as many. */
  const std::vector<Eigen::Index>& of(Eigen::Index i, std::size_t count);

private:
  /** \brief Points nearer to a place than a squared distance. */
  void collect(const Eigen::Vector3d& place, double near_enough);

  const Eigen::Matrix3Xd& points_;
  int axis_ = 0;
  std::vector<Eigen::Index> columns_; ///< in order along the axis
  std::vector<double> along_;         ///< their coordinate on the axis
  Eigen::Matrix3Xd sorted_;           ///< themselves
  double near_enough_ = std::numeric_limits<double>::infinity();
  std::vector<double> distances_;  ///< squared, of what was found
  std::vector<std::size_t> found_; ///< places in the order
  std::vector<double> values_, spare_;
  std::vector<Eigen::Index> near_;
};

/** \brief Points about the quadratic surface through them. */
struct LocalQuadric {
  static constexpr int TERMS = 6;
  Eigen::VectorXd residuals; ///< heights over the surface; empty if all are one place
  Eigen::Matrix2Xd across;   ///< the points' places on it

  /** \brief Standard deviation of the residuals. */
  double scatter() const;
};

LocalQuadric localQuadric(const Eigen::Matrix3Xd& points,
                          const std::vector<Eigen::Index>& columns);

double median(std::vector<double> values);

} // namespace pcl_sq::detail

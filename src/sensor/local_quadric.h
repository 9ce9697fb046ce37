// SPDX-License-Identifier: BSD-3-Clause
// Private. Neighbours of points and the curved surfaces through them.
#pragma once

#include "util/point_grid.h"

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace pcl_sq::detail {

/** \brief Nearest neighbours among every stride-th point. */
class Neighbourhood {
public:
  explicit Neighbourhood(const Eigen::Matrix3Xd& points, Eigen::Index stride = 1);

  /** \brief Columns of the \a count points nearest to the i-th one, nearest first, of
   * which there are as many; the i-th itself is one where the stride takes it. */
  const std::vector<Eigen::Index>& of(Eigen::Index i, std::size_t count);
  /** \brief Distance of the last of of(). */
  double reach() const;

private:
  const Eigen::Matrix3Xd& points_;
  Eigen::Index stride_;
  PointGrid grid_;
  double radius_ = 0.0; ///< of the ball that is searched first
  std::vector<std::pair<double, std::size_t>>
      found_; ///< squared distances, in the grid
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

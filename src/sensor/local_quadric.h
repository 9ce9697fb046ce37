// SPDX-License-Identifier: BSD-3-Clause
// Private. Neighbours of points and the curved surfaces through them.
#pragma once

#include <Eigen/Core>

#include <limits>
#include <vector>

namespace pcl_sq::detail {

/** \brief Nearest neighbours among every stride-th point. */
class Neighbourhood {
public:
  Neighbourhood(const Eigen::Matrix3Xd& points, Eigen::Index stride)
      : points_(points), stride_(stride) {}

  /** \brief Columns of the \a count points nearest to the i-th one. */
  const std::vector<Eigen::Index>& of(Eigen::Index i, std::size_t count);

private:
  struct Found {
    double distance; ///< squared
    Eigen::Index column;
  };
  /** \brief Points nearer to the i-th one than a squared distance. */
  void collect(Eigen::Index i, double near_enough);

  const Eigen::Matrix3Xd& points_;
  Eigen::Index stride_;
  double near_enough_ = std::numeric_limits<double>::infinity();
  std::vector<Found> found_;
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

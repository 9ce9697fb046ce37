// SPDX-License-Identifier: BSD-3-Clause
#include "util/point_set.h"

#include "pcl_sq/superquadric.h"

#include <Eigen/Eigenvalues>

namespace pcl_sq::detail {

template <typename Points>
Moments momentsOf(const Points& points) {
  Moments m;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite()) {
      m.mean += points.col(i).template cast<double>();
      ++m.count;
    }
  if (m.count == 0)
    return m;
  m.mean /= double(m.count);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite()) {
      const Eigen::Vector3d d = points.col(i).template cast<double>() - m.mean;
      m.covariance.noalias() += d * d.transpose();
    }
  m.covariance /= double(m.count);
  return m;
}

template <typename Points>
int spannedDimensions(const Points& points) {
  const Moments m = momentsOf(points);
  if (m.count < 2)
    return 0;
  double largest = 0.0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite())
      largest = std::max(largest, double(points.col(i).cwiseAbs().maxCoeff()));
  const double rounding = 4.0 * 6e-8 * largest; // of a float that holds the coordinate
  const Eigen::Vector3d deviation = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
                                        m.covariance, Eigen::EigenvaluesOnly)
                                        .eigenvalues()
                                        .cwiseMax(0.0)
                                        .cwiseSqrt();
  int dimensions = 0;
  for (int k = 0; k < 3; ++k)
    dimensions += deviation[k] > std::max(rounding, 1e-7 * deviation[2]);
  return dimensions;
}

template Moments momentsOf(const Eigen::Ref<const Eigen::Matrix3Xd>&);
template Moments momentsOf(const CloudPoints&);
template Moments momentsOf(const Eigen::Matrix3Xd&);
template int spannedDimensions(const Eigen::Ref<const Eigen::Matrix3Xd>&);
template int spannedDimensions(const CloudPoints&);
template int spannedDimensions(const Eigen::Matrix3Xd&);

} // namespace pcl_sq::detail

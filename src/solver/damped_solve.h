// SPDX-License-Identifier: BSD-3-Clause
// Private. One step of Levenberg-Marquardt.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace pcl_sq::detail {

/** \brief Solves the equations, damped as Marquardt has it, over the first \a n
 * directions by Cholesky; frozen directions stay where they are.
 * \return false where they are not positive definite */
template <int N>
bool dampedSolve(const Eigen::Matrix<double, N, N>& jtj,
                 const Eigen::Matrix<double, N, 1>& jtr,
                 int n,
                 const bool (&frozen)[N],
                 double damping,
                 Eigen::Matrix<double, N, 1>& step) {
  double largest = 0.0;
  for (int i = 0; i < n; ++i)
    largest = std::max(largest, jtj(i, i));
  if (!(largest > 0.0) || !std::isfinite(largest))
    return false;
  Eigen::Matrix<double, N, N> l; // lower triangle
  for (int j = 0; j < n; ++j)
    for (int i = j; i < n; ++i)
      l(i, j) = frozen[i] || frozen[j] ? 0.0 : jtj(i, j);
  for (int i = 0; i < n; ++i)
    l(i, i) = frozen[i] ? 1.0 : l(i, i) + damping * (l(i, i) + 1e-9 * largest);
  Eigen::Matrix<double, N, 1> inverse; // of the diagonal
  for (int k = 0; k < n; ++k) {
    if (!(l(k, k) > 1e-14 * largest || (frozen[k] && l(k, k) > 0.0)))
      return false;
    l(k, k) = std::sqrt(l(k, k));
    inverse[k] = 1.0 / l(k, k);
    for (int i = k + 1; i < n; ++i)
      l(i, k) *= inverse[k];
    // down the columns, as they lie in memory
    for (int j = k + 1; j < n; ++j)
      for (int i = j; i < n; ++i)
        l(i, j) -= l(i, k) * l(j, k);
  }
  for (int i = 0; i < n; ++i)
    step[i] = frozen[i] ? 0.0 : -jtr[i];
  for (int k = 0; k < n; ++k) {
    step[k] *= inverse[k];
    for (int i = k + 1; i < n; ++i)
      step[i] -= l(i, k) * step[k];
  }
  for (int i = n - 1; i >= 0; --i) {
    double s = step[i];
    for (int k = i + 1; k < n; ++k)
      s -= l(k, i) * step[k];
    step[i] = s * inverse[i];
  }
  return step.head(n).allFinite();
}

} // namespace pcl_sq::detail

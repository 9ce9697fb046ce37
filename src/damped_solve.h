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
  Eigen::Matrix<double, N, N> l;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      double s = frozen[i] || frozen[j] ? 0.0 : jtj(i, j);
      if (i == j)
        s = frozen[i] ? 1.0 : s + damping * (s + 1e-9 * largest);
      for (int k = 0; k < j; ++k)
        s -= l(i, k) * l(j, k);
      if (i != j)
        l(i, j) = s / l(j, j);
      else if (s > 1e-14 * largest || (frozen[i] && s > 0.0))
        l(i, i) = std::sqrt(s);
      else
        return false;
    }
  }
  for (int i = 0; i < n; ++i) {
    double s = frozen[i] ? 0.0 : -jtr[i];
    for (int k = 0; k < i; ++k)
      s -= l(i, k) * step[k];
    step[i] = s / l(i, i);
  }
  for (int i = n - 1; i >= 0; --i) {
    double s = step[i];
    for (int k = i + 1; k < n; ++k)
      s -= l(k, i) * step[k];
    step[i] = s / l(i, i);
  }
  return step.head(n).allFinite();
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/fit_options.h"
#include "pcl_sq/superquadric.h"

#include <array>
#include <vector>

namespace pcl_sq::detail {

/** \brief Least-squares problem of the paper's fit over x = (e1, e2, ln a_free).
 *
 * The pose is fixed, so the logarithms of the coordinates are taken once; an evaluation
 * is then two nested norms per point. */
class PaperProblem {
public:
  /** \brief Logarithms of the folded coordinates in the frame of the fit. */
  struct LocalPoints {
    std::array<std::vector<float>, 3> log_coordinate; ///< ln |y_k|
    std::vector<float> radius;                        ///< |y| [m]
    std::size_t size() const { return radius.size(); }
  };

  /** \brief Cost and normal equations at one x. */
  struct Normal {
    double cost = 0.0;
    Eigen::Vector3d gradient = Eigen::Vector3d::Zero(); ///< J^T r
    Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();  ///< J^T J
  };

  /** \brief The finite points in the frame of \a pose. */
  static LocalPoints toLocal(const Eigen::Ref<const Eigen::Matrix3Xd>& points,
                             const Superquadric& pose);

  /** \param[in] start pose and known semi-axes; its axis k is axis (k + shift) mod 3 of
   * the points' frame
   * \param[in] free_axis semi-axis that is estimated */
  PaperProblem(const LocalPoints& points,
               const Superquadric& start,
               int shift,
               int free_axis,
               const PaperFitOptions& options);

  Eigen::Vector3d parametersOf(const Superquadric& s) const;
  Superquadric superquadricAt(const Eigen::Vector3d& x) const;
  Eigen::Vector3d clamp(const Eigen::Vector3d& x) const;
  /** \brief Whether descent would leave the bound at which parameter k stands. */
  bool pushesOutwards(const Eigen::Vector3d& x,
                      const Eigen::Vector3d& gradient,
                      int k) const;
  Normal linearise(const Eigen::Vector3d& x) const;

private:
  const LocalPoints& points_;
  Superquadric start_;
  int shift_;
  int free_axis_;
  Cost cost_;
  Eigen::Vector3d lower_, upper_;
};

} // namespace pcl_sq::detail

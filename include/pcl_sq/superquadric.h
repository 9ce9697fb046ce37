// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/config.h"
#include "pcl_sq/exports.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <iosfwd>
#include <string>
#include <vector>

namespace pcl_sq {

/** \brief Points as columns [m], NaN where there is none: a matrix, or the coordinates
 * of a pcl::PointCloud where they are (getMatrixXfMap().topRows<3>()). */
using CloudPoints = Eigen::Ref<const Eigen::Matrix3Xf, 0, Eigen::OuterStride<>>;

/** \brief Coefficients of a superquadric in the order of pcl::ModelCoefficients:
 * [x y z | roll pitch yaw | a1 a2 a3 | e1 e2], angles as in pcl::getTransformation. */
using SuperquadricCoefficients = Eigen::Matrix<double, 11, 1>;

/** \brief A superquadric: the one representation used everywhere (paper, Eq. 3).
 *
 * In its own frame, with z the axis of epsilon1,
 * \f[ F(x,y,z) = \left(|x/a_1|^{2/\epsilon_2} +
 *     |y/a_2|^{2/\epsilon_2}\right)^{\epsilon_2/\epsilon_1} + |z/a_3|^{2/\epsilon_1}
 * \f] F < 1 inside, = 1 on the surface, > 1 outside (the paper prints "> 0" for outside
 * and leaves out the absolute values; see docs/paper_map.md).
 *
 * All evaluations go through the gauge G = F^(epsilon1/2). For exponents up to 2 it is
 * a norm: homogeneous of degree one and convex, so that it neither over- nor underflows
 * where F does. Every method is safe for exponents in [0.05, 2], on the axes, at the
 * centre and far away; a derivative that does not exist there is returned as its
 * zero subgradient.
 * \ingroup pcl_sq
 */
struct PCL_SQ_EXPORTS Superquadric {
  /** \brief Smallest exponent that is told apart from a sharp edge. */
  static constexpr double MIN_EPSILON = 0.05;
  /** \brief Largest exponent of a convex superquadric. */
  static constexpr double MAX_EPSILON = 2.0;

  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< [m], the cloud's frame, to 1e20
  /** \brief Columns: the superquadric's axes in the cloud's frame. */
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d semi_axes =
      Eigen::Vector3d::Ones(); ///< a1, a2, a3 [m], 1e-20 to 1e20
  double epsilon1 = 1.0;       ///< squareness along z, in [MIN_EPSILON, MAX_EPSILON]
  double epsilon2 = 1.0;       ///< squareness across z, in [MIN_EPSILON, MAX_EPSILON]

  /** \brief Whether all numbers are finite and in range and the rotation is a rotation.
   * \param[out] why the first violation as a sentence (optional) */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;

  /** \brief A point of the cloud's frame in the superquadric's own frame. */
  Eigen::Vector3d toLocal(const Eigen::Vector3d& point) const {
    return rotation.transpose() * (point - center);
  }
  /** \brief A point of the superquadric's own frame in the cloud's frame. */
  Eigen::Vector3d toWorld(const Eigen::Vector3d& local) const {
    return rotation * local + center;
  }

  /** \brief Inside-outside function F, Eq. (4); saturates at the largest double. */
  double insideOutside(const Eigen::Vector3d& point) const;
  /** \brief Gradient of F in the cloud's frame [1/m]; saturates like F. */
  Eigen::Vector3d insideOutsideGradient(const Eigen::Vector3d& point) const;
  /** \brief Gauge G = F^(epsilon1/2); G - 1 is the paper's distance, Eq. (6). */
  double gauge(const Eigen::Vector3d& point) const;
  /** \brief Gradient of G in the cloud's frame [1/m]. */
  Eigen::Vector3d gaugeGradient(const Eigen::Vector3d& point) const;
  /** \brief Derivatives of ln G at a point for all eleven parameters.
   *
   * Order: t (3, moving along the superquadric's own axes), w (3, right rotation
   * R exp([w]x)), ln a1, ln a2, ln a3, e1, e2. (algorithm: chain rule over the nested
   * norm; d ln G / d epsilon is half an entropy, so no logarithm of zero appears.) */
  SuperquadricCoefficients logGaugeJacobian(const Eigen::Vector3d& point) const;

  /** \brief Signed distance to the surface along the ray from the centre,
   * |y| (1 - 1/G) [m] (Gross & Boult 1988); minus the smallest semi-axis at the centre.
   */
  double radialDistance(const Eigen::Vector3d& point) const;
  /** \brief Signed first-order distance (G - 1) / |grad G| [m] (Taubin 1991); a lower
   * bound of the Euclidean distance outside. At the centre as radialDistance(). */
  double firstOrderDistance(const Eigen::Vector3d& point) const;
  /** \brief Signed distance to the foot point after one tangent-plane projection [m];
   * an upper bound of the Euclidean distance that is far tighter than radialDistance().
   */
  double footPointDistance(const Eigen::Vector3d& point) const;
  /** \brief Surface point closest to \a point, converged to rounding of the distance.
   */
  Eigen::Vector3d closestPoint(const Eigen::Vector3d& point) const;
  /** \brief Signed Euclidean distance to the surface [m], negative inside. */
  double euclideanDistance(const Eigen::Vector3d& point) const;

  /** \brief Point of the surface on the ray from the centre through \a point; for the
   * centre itself the end of the shortest semi-axis. */
  Eigen::Vector3d radialProjection(const Eigen::Vector3d& point) const;
  /** \brief Outward unit normal of the level surface through \a point. */
  Eigen::Vector3d normal(const Eigen::Vector3d& point) const;

  /** \brief Support function h(n) = max { n.(p - center) : p on the surface } [m].
   *
   * The dual of a superquadric is a superquadric with exponents 2 - epsilon, which
   * gives a closed form. The width between parallel plates of unit normal n is 2 h(n).
   * \param[in] direction n in the cloud's frame; h is homogeneous of degree one in it
   */
  double support(const Eigen::Vector3d& direction) const;
  /** \brief Surface point in which h(n) is attained, in the cloud's frame. */
  Eigen::Vector3d supportPoint(const Eigen::Vector3d& direction) const;
  /** \brief Derivatives of n.center + h(n), n fixed in the cloud's frame, in the order
   * of logGaugeJacobian(). */
  SuperquadricCoefficients supportJacobian(const Eigen::Vector3d& direction) const;
  /** \brief The same together with support(), which costs next to nothing beside it.
   * \param[out] support h(n) [m] */
  SuperquadricCoefficients supportJacobian(const Eigen::Vector3d& direction,
                                           double& support) const;
  /** \brief Exact axis-aligned bounding box in the cloud's frame. */
  Eigen::AlignedBox3d boundingBox() const;

  /** \brief Volume 2 a1 a2 a3 e1 e2 B(e1/2 + 1, e1) B(e2/2, e2/2) [m^3]
   * (Jaklic, Leonardis, Solina 2000). */
  double volume() const;
  /** \brief Moment of inertia about the centre at density one, axes of the cloud's
   * frame [m^5] (Jaklic, Leonardis, Solina 2000). */
  Eigen::Matrix3d inertia() const;

  /** \brief The coefficients in PCL's order; see SuperquadricCoefficients. */
  SuperquadricCoefficients toCoefficients() const;
  /** \brief Inverse of toCoefficients(); \a coefficients must hold eleven numbers. */
  static Superquadric fromCoefficients(const SuperquadricCoefficients& coefficients);
  /** \brief From the single-precision vectors of PCL's sample consensus models. */
  static Superquadric fromCoefficients(const Eigen::VectorXf& coefficients);
  /** \brief From pcl::ModelCoefficients::values. */
  static Superquadric fromCoefficients(const std::vector<float>& coefficients);
};

/** \brief One line for people: centre [m], semi-axes [m], exponents and axes, in the
 * stream's precision. \relates Superquadric */
PCL_SQ_EXPORTS std::ostream& operator<<(std::ostream& stream,
                                        const Superquadric& superquadric);

} // namespace pcl_sq

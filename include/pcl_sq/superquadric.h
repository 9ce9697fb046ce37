// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/config.h"
#include "pcl_sq/exports.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
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
 *
 * The cross-section may grow linearly along z (Solina & Bajcsy 1990): a cup, a
 * lampshade, a wedge. A point (x, y, z) of the straight body then goes to
 * \f[ \left( (k_x z / a_3 + 1)\, x,\; (k_y z / a_3 + 1)\, y,\; z \right) \f]
 * and F and G are those at the straight place. A tapered body has no centre of symmetry
 * and need not be convex; turned by 180 degrees about x it has the opposite taper.
 *
 * After the taper the z axis may be bent to a circle (a banana, a handle): with
 * \f$ R = 1/\kappa \f$ and X along the direction at the bend's angle in the xy plane,
 * \f[ x = R - (R - X) \cos(Z / R), \quad z = (R - X) \sin(Z / R) \f]
 * which takes volumes where the section is symmetric as they are, and lengths along z
 * by 1 - X / R. A bent body has neither rim nor wall.
 *
 * The body may be cut at a rim, the plane z = rim a3, above which there is nothing; and
 * it may be hollow, a bowl or a mug: open at the rim, the hollow's section is the
 * body's with both semi-axes shorter by the wall, its floor the wall's thickness above
 * z = -a3. The gauge, the support function and volume() are those of the body filled up
 * to the rim, which is what collides and what an outline shows; closestPoint() and the
 * distances are those of the material's surface, inside and floor included.
 * \ingroup pcl_sq
 */
struct PCL_SQ_EXPORTS Superquadric {
  /** \brief Smallest exponent that is told apart from a sharp edge. */
  static constexpr double MIN_EPSILON = 0.05;
  /** \brief Largest exponent of a convex superquadric. */
  static constexpr double MAX_EPSILON = 2.0;
  /** \brief Largest |kx|, |ky|; 1 would be an apex. */
  static constexpr double MAX_TAPER = 0.95;
  /** \brief Largest |bend| a3 [rad]: to either side of the middle; pi closes a ring. */
  static constexpr double MAX_BEND = 3.0;
  /** \brief Largest |bend| times the section's reach; from 1 on the body folds. */
  static constexpr double MAX_FOLD = 0.95;

  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< [m], the cloud's frame, to 1e20
  /** \brief Columns: the superquadric's axes in the cloud's frame. */
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  /** \brief a1, a2, a3 [m], 1e-20 to 1e20; a1 and a2 are those at z = 0. */
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Ones();
  double epsilon1 = 1.0; ///< squareness along z, in [MIN_EPSILON, MAX_EPSILON]
  double epsilon2 = 1.0; ///< squareness across z, in [MIN_EPSILON, MAX_EPSILON]
  double kx = 0.0;  ///< taper: relative growth of the section's x from z = 0 to z = a3
  double ky = 0.0;  ///< and of its y; both in [-MAX_TAPER, MAX_TAPER]
  double rim = 1.0; ///< height of the rim over a3, in (-1, 1]; 1: the body is not cut
  /** \brief Thickness of the wall of a hollow body, open at its rim [m]; 0: solid. */
  double wall = 0.0;
  double bend = 0.0;       ///< curvature kappa of the z axis after the taper [1/m]
  double bend_angle = 0.0; ///< direction of the circle's centre in the xy plane [rad]

  /** \brief Whether the cross-section changes along z. */
  bool isTapered() const { return kx != 0.0 || ky != 0.0; }
  /** \brief Whether the body is hollow. */
  bool isHollow() const { return wall > 0.0; }
  /** \brief Whether the body ends at a rim. */
  bool isCut() const { return rim < 1.0 || isHollow(); }
  /** \brief Whether the z axis is bent. */
  bool isBent() const { return bend != 0.0; }
  /** \brief Whether the body is tapered or bent. */
  bool isDeformed() const { return isTapered() || isBent(); }
  /** \brief Whether the body is one of the paper's: neither tapered, bent nor cut. */
  bool isPlain() const { return !isDeformed() && !isCut(); }
  /** \brief Height of the rim over a3; a hollow body that is not cut is open a
   * thousandth below its top, where its section has a size. */
  double rimHeight() const { return isHollow() ? std::min(rim, 0.999) : rim; }
  /** \brief Half the sides of a box in the own axes, around the centre, that holds the
   * body [m]: the semi-axes where there is neither taper nor bend. */
  Eigen::Vector3d halfSizes() const {
    return isBent() ? bentHalfSizes()
                    : semi_axes.cwiseProduct(
                          Eigen::Vector3d(1.0 + std::abs(kx), 1.0 + std::abs(ky), 1.0));
  }

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

  /** \brief Where taper and bend take a point of the straight body; both in the
   * cloud's frame. */
  Eigen::Vector3d deformed(const Eigen::Vector3d& point) const;
  /** \brief Inverse of deformed(). Beyond the apex, where there is none, the section is
   * taken to shrink no further than at MAX_TAPER; angles around the circle are those in
   * (-pi, pi]. */
  Eigen::Vector3d straightened(const Eigen::Vector3d& point) const;

  /** \brief Whether a point lies in or on the body, filled up to its rim. */
  bool contains(const Eigen::Vector3d& point) const { return gauge(point) <= 1.0; }
  /** \brief Whether a point of the cloud's frame lies in the hollow: above the floor,
   * within the inner wall, below the rim. */
  bool inHollow(const Eigen::Vector3d& point) const;
  /** \brief Whether a point lies in or on the body's material. */
  bool inMaterial(const Eigen::Vector3d& point) const {
    return contains(point) && !inHollow(point);
  }

  /** \brief Inside-outside function F, Eq. (4); saturates at the largest double. */
  double insideOutside(const Eigen::Vector3d& point) const;
  /** \brief Gradient of F in the cloud's frame [1/m]; saturates like F. */
  Eigen::Vector3d insideOutsideGradient(const Eigen::Vector3d& point) const;
  /** \brief Gauge G = F^(epsilon1/2); G - 1 is the paper's distance, Eq. (6). Of a body
   * with a rim the larger of that and 1 + z / a3 - rim, filled up to there. */
  double gauge(const Eigen::Vector3d& point) const;
  /** \brief Gradient of G in the cloud's frame [1/m]. */
  Eigen::Vector3d gaugeGradient(const Eigen::Vector3d& point) const;
  /** \brief Derivatives of ln G at a point for the eleven parameters of the paper, a
   * taper and a bend held.
   *
   * Order: t (3, moving along the superquadric's own axes), w (3, right rotation
   * R exp([w]x)), ln a1, ln a2, ln a3, e1, e2. (algorithm: chain rule over the nested
   * norm; d ln G / d epsilon is half an entropy, so no logarithm of zero appears.) */
  SuperquadricCoefficients logGaugeJacobian(const Eigen::Vector3d& point) const;

  /** \brief Signed distance to radialProjection(), |y| (1 - 1/G) [m] along the ray from
   * the centre where there is no deformation (Gross & Boult 1988); minus the smallest
   * semi-axis at the centre. */
  double radialDistance(const Eigen::Vector3d& point) const;
  /** \brief Signed first-order distance (G - 1) / |grad G| [m] (Taubin 1991); a lower
   * bound of the Euclidean distance outside. At the centre as radialDistance(). */
  double firstOrderDistance(const Eigen::Vector3d& point) const;
  /** \brief Signed distance to the foot point after one tangent-plane projection [m];
   * an upper bound of the Euclidean distance that is far tighter than radialDistance().
   */
  double footPointDistance(const Eigen::Vector3d& point) const;
  /** \brief Surface point closest to \a point, converged to rounding of the distance;
   * of a hollow body on its outside, inside, floor or rim. */
  Eigen::Vector3d closestPoint(const Eigen::Vector3d& point) const;
  /** \brief Signed Euclidean distance to the surface [m], negative in the material. */
  double euclideanDistance(const Eigen::Vector3d& point) const;

  /** \brief Point of the surface on the ray from the centre through \a point, of a
   * tapered or bent body the same before that; for the centre itself the end of the
   * shortest semi-axis. */
  Eigen::Vector3d radialProjection(const Eigen::Vector3d& point) const;
  /** \brief Outward unit normal of the level surface through \a point. */
  Eigen::Vector3d normal(const Eigen::Vector3d& point) const;

  /** \brief Support function h(n) = max { n.(p - center) : p on the surface } [m].
   *
   * The dual of a superquadric is a superquadric with exponents 2 - epsilon, which
   * gives a closed form. A tapered or bent body is cut into slices and h found to about
   * 1e-9 of its size: it is the support function of the convex hull (with e2 > 1.98
   * that of e2 = 1.98). The width between parallel plates of unit normal n is h(n) +
   * h(-n). \param[in] direction n in the cloud's frame; h is homogeneous of degree one
   * in it
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
   * (Jaklic, Leonardis, Solina 2000); the odd terms of a taper cancel, and kx ky times
   * the second moment along z over a3^2 comes on top. With a rim by quadrature along z,
   * filled up to there. */
  double volume() const;
  /** \brief Volume of the material [m^3]: without the hollow. */
  double materialVolume() const;
  /** \brief Centre of gravity of the material in the cloud's frame [m]: on the axis, at
   * the centre where there is neither a taper nor a rim. */
  Eigen::Vector3d centerOfGravity() const;
  /** \brief Moment of inertia of the material about \a center at density one, axes of
   * the cloud's frame [m^5] (Jaklic, Leonardis, Solina 2000). */
  Eigen::Matrix3d inertia() const;

  /** \brief The coefficients in PCL's order, see SuperquadricCoefficients; they hold no
   * taper, bend, rim or wall. */
  SuperquadricCoefficients toCoefficients() const;
  /** \brief Inverse of toCoefficients(); \a coefficients must hold eleven numbers. */
  static Superquadric fromCoefficients(const SuperquadricCoefficients& coefficients);
  /** \brief From the single-precision vectors of PCL's sample consensus models; of
   * fewer than eleven, as of a model that was not found, what isValid() refuses. */
  static Superquadric fromCoefficients(const Eigen::VectorXf& coefficients);
  /** \brief From pcl::ModelCoefficients::values, as above. */
  static Superquadric fromCoefficients(const std::vector<float>& coefficients);

private:
  Eigen::Vector3d bentHalfSizes() const;
};

/** \brief One line for people: centre [m], semi-axes [m], exponents and axes, in the
 * stream's precision. \relates Superquadric */
PCL_SQ_EXPORTS std::ostream& operator<<(std::ostream& stream,
                                        const Superquadric& superquadric);

} // namespace pcl_sq

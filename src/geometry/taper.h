// SPDX-License-Identifier: BSD-3-Clause
// Private. A superquadric's gauge and distance at a place, with or without a taper, and
// their derivatives for all thirteen parameters.
#pragma once

#include "geometry/gauge.h"
#include "geometry/normalisation.h"

namespace pcl_sq::detail {

class BentSupport; // bend.h

using Vector13 = Eigen::Matrix<double, 13, 1>;

/** \brief Largest e2 of a section's dual norm: with 2 it is the maximum norm, the limit
 * of those below. */
constexpr double MAX_SECTION = 1.98;

/** \brief Growth of the section at a height z of the own frame (M2), never below that
 * of the largest taper; exactly one without a taper. */
inline Eigen::Vector3d growth(const Superquadric& s, double z) {
  if (!s.isTapered())
    return Eigen::Vector3d::Ones();
  constexpr double LEAST = 1.0 - Superquadric::MAX_TAPER;
  const double height = z / s.semi_axes.z();
  return {
      std::max(1.0 + s.kx * height, LEAST), std::max(1.0 + s.ky * height, LEAST), 1.0};
}

/** \brief A place in the own frame, with the gauge there. */
struct Place {
  Eigen::Vector3d at;       ///< in the own frame
  Eigen::Vector3d unbent;   ///< the same before bending
  Eigen::Vector3d straight; ///< and before tapering
  Eigen::Vector3d growth;   ///< of the section at its height
  LogGauge gauge;           ///< of the straight body at the straight place
};

Place placeOf(const Superquadric& s, const Eigen::Vector3d& local);

/** \brief Gradient of ln G in the own frame, by the chain rule through taper and bend.
 */
Eigen::Vector3d logGradient(const Superquadric& s, const Place& place);

/** \brief The radial projection of the straight body, deformed: on the surface. */
Place radiallyProjected(const Superquadric& s, const Place& place);

/** \brief Where taper and bend take a place of the straight body; own frame. */
Eigen::Vector3d deformed(const Superquadric& s, const Eigen::Vector3d& straight);

/** \brief Where taper and bend take the area vector of a small piece of the straight
 * body's surface. \param[in] straight place on it; own frame */
Eigen::Vector3d deformedAreaVector(const Superquadric& s,
                                   const Eigen::Vector3d& straight,
                                   const Eigen::Vector3d& normal);

/** \brief Where tapering takes the area vector of a small piece of the straight body's
 * surface: it is transformed by the cofactors of the taper's derivative. \param[in]
 * straight place before tapering \param[in] normal area vector there; own frame */
inline Eigen::Vector3d taperedAreaVector(const Superquadric& s,
                                         const Eigen::Vector3d& straight,
                                         const Eigen::Vector3d& normal) {
  const double a3 = s.semi_axes.z();
  const Eigen::Vector3d f = growth(s, straight.z());
  return {normal.x() * f.y(),
          normal.y() * f.x(),
          normal.z() * f.x() * f.y() - normal.x() * s.kx * straight.x() * f.y() / a3 -
              normal.y() * s.ky * straight.y() * f.x() / a3};
}

/** \brief A scalar with its derivatives for t (along the own axes), w, ln a, e1, e2,
 * kx, ky; the first eleven as in Superquadric::logGaugeJacobian(). */
struct BodyRow {
  double value;
  Vector13 derivatives;
};

/** \brief ln G at a point. */
BodyRow logGaugeRow(const Superquadric& s, const Eigen::Vector3d& point);

/** \brief Signed distance to the foot point on the tangent plane at the radial
 * projection. The derivatives are those of the gauge at the foot point, as in the
 * kernels: exact on the surface, and up to the curvature times the distance beside it.
 * \param[out] foot optional */
BodyRow footPointRow(const Superquadric& s,
                     const Eigen::Vector3d& point,
                     Place* foot = nullptr);

/** \brief n . center + h(n) for a unit vector n: the envelope theorem, at the point
 * that touches. \param[out] unbent that point before bending, of a bent body; optional
 */
BodyRow supportRow(const Superquadric& s,
                   const Eigen::Vector3d& normal,
                   Eigen::Vector3d* unbent = nullptr);

/** \brief The same of a bent body whose slices are made already. */
BodyRow supportRow(const Superquadric& s,
                   const BentSupport& slices,
                   const Eigen::Vector3d& normal,
                   Eigen::Vector3d* unbent = nullptr);

/** \brief h(n) of a body that is not plain, n in its own frame. */
double slicedSupport(const Superquadric& s, const Eigen::Vector3d& local_direction);

/** \brief Point of such a body that reaches farthest along n; both in its own frame. */
Eigen::Vector3d slicedSupportPoint(const Superquadric& s,
                                   const Eigen::Vector3d& local_direction);

/** \brief Signed distance, or the gauge less one, as the kernels have it. */
double residualAt(const Superquadric& s,
                  const Eigen::Vector3d& point,
                  kernels::Residual residual);

/** \brief The same for many points: by the kernels, or one by one where there is a
 * taper. \param[in] s in the frame of the points \param[out] out room for the points
 * and a block more */
void residualsOf(const Superquadric& s,
                 const UnitPoints& points,
                 kernels::Residual residual,
                 float* out);

/** \brief The integral of x^p y^q z^r, p, q and r even, over the straight body in its
 * own frame. */
double evenMoment(const Superquadric& s, int p, int q, int r);

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace pcl_sq {

/** \brief The plane normal . p + offset = 0; the normal points to the viewer's side.
 *
 * pcl::ModelCoefficients of a plane are the same four numbers, a, b, c, d of
 * a x + b y + c z + d = 0, but their sign says nothing: pcl::SACMODEL_PLANE gives a
 * unit normal that points to either side, and optimised coefficients may turn it round.
 * \code
 * segmentation.segment(inliers, coefficients); // pcl::SACSegmentation
 * options.view.table = TableModel{*TablePlane::fromCoefficients(coefficients.values)};
 * coefficients.values = plane.toCoefficients();
 * \endcode
 * \ingroup pcl_sq */
struct PCL_SQ_EXPORTS TablePlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); ///< unit length
  double offset = 0.0;                               ///< [m]
  /** \brief Distance of a point from the plane, positive on the viewer's side [m]. */
  double signedDistance(const Eigen::Vector3d& p) const {
    return normal.dot(p) + offset;
  }

  /** \brief The four values of pcl::ModelCoefficients, sign and length as they are. */
  std::vector<float> toCoefficients() const;
  /** \brief From pcl::ModelCoefficients::values of a plane of any length and sign.
   *
   * The result has a unit normal and is turned so that \a viewpoint has a positive
   * distance; where it lies on the plane, the sign is kept.
   * \param[in] coefficients a, b, c, d
   * \param[in] viewpoint the camera's place [m]
   * \return nothing unless these are four finite numbers and the normal is not zero */
  static std::optional<TablePlane>
  fromCoefficients(const std::vector<float>& coefficients,
                   const Eigen::Vector3d& viewpoint = Eigen::Vector3d::Zero());
  /** \brief From the vectors of PCL's sample consensus models. */
  static std::optional<TablePlane>
  fromCoefficients(const Eigen::VectorXf& coefficients,
                   const Eigen::Vector3d& viewpoint = Eigen::Vector3d::Zero());
};

} // namespace pcl_sq

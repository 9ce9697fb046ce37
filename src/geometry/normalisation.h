// SPDX-License-Identifier: BSD-3-Clause
// Private. Points of size about one around the origin along their principal axes, in
// single precision: results depend neither on the unit nor on where and how the cloud
// lies, and floats suffice.
#pragma once

#include "kernels/kernels.h"
#include "pcl_sq/superquadric.h"

#include <vector>

namespace pcl_sq::detail {

/** \brief Similarity between the cloud's frame and the frame the solver works in. */
struct Normalisation {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();   ///< in the cloud's frame [m]
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); ///< columns, in the cloud's frame
  double scale = 1.0;                                 ///< metres per unit
  Eigen::Vector3d deviations = Eigen::Vector3d::Ones(); ///< along the axes [m], rising

  Eigen::Vector3d toUnit(const Eigen::Vector3d& p) const {
    return axes.transpose() * (p - origin) / scale;
  }
  Superquadric toUnit(Superquadric s) const {
    s.center = toUnit(s.center);
    s.rotation = axes.transpose() * s.rotation;
    s.semi_axes /= scale;
    s.wall /= scale;
    s.bend *= scale;
    return s;
  }
  Superquadric toCloud(Superquadric s) const {
    s.center = axes * s.center * scale + origin;
    s.rotation = Eigen::Quaterniond(axes * s.rotation).normalized().toRotationMatrix();
    s.semi_axes *= scale;
    s.wall *= scale;
    s.bend /= scale;
    return s;
  }
};

/** \brief Coordinates as the kernels want them: one array each, padded. */
class UnitPoints {
public:
  void reserve(std::size_t count);
  void clear() { count_ = 0; }
  void add(float x, float y, float z) {
    x_[count_] = x;
    y_[count_] = y;
    z_[count_] = z;
    ++count_;
  }
  /** \brief Factors of the squared residuals, one per point; empty: all one. */
  void setPrecision(const std::vector<float>& precision);
  std::size_t size() const { return count_; }
  /** \brief Volume of the box along the axes, no side taken for less than 0.1. */
  double boxVolume() const;
  Eigen::Vector3f operator[](std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
  kernels::Points view() const {
    return {x_.data(),
            y_.data(),
            z_.data(),
            precision_.empty() ? nullptr : precision_.data(),
            count_};
  }

private:
  std::vector<float> x_, y_, z_, precision_;
  std::size_t count_ = 0;
};

/** \brief Frame of the finite points: mean, principal axes signed by the third moments,
 * standard deviation along the longest as the unit.
 * \param[in] points Eigen::Ref<const Eigen::Matrix3Xd> or CloudPoints
 * \return the number of finite points; 0 if there are fewer than three, or if all lie
 * in a single place */
template <typename Points>
std::size_t principalFrame(const Points& points, Normalisation& frame);

/** \brief Whether the points of a frame lie on a line as far as single-precision
 * coordinates can tell. */
bool isLine(const Normalisation& frame);

/** \brief The finite points in a frame. */
template <typename Points>
UnitPoints toUnit(const Points& points, const Normalisation& frame);

/** \brief Up to \a count points, the same ones in whatever order they come: those whose
 * coordinates have the smallest hash. */
UnitPoints subset(const UnitPoints& points, std::size_t count);

/** \brief subset(toUnit(points, frame), count) of many points without a copy of all.
 * \param[in] finite number of finite points, more than \a count */
template <typename Points>
UnitPoints subsetInUnit(const Points& points,
                        const Normalisation& frame,
                        std::size_t finite,
                        std::size_t count);

/** \brief The shape's numbers for the kernels. */
kernels::Shape toShape(const Superquadric& superquadric);

} // namespace pcl_sq::detail

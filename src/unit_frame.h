// SPDX-License-Identifier: BSD-3-Clause
// Private. Points of size about one around the origin, in single precision: results do
// not depend on the unit or on where the cloud lies, and floats suffice.
#pragma once

#include "kernels/kernels.h"
#include "pcl_sq/superquadric.h"

#include <vector>

namespace pcl_sq::detail {

/** \brief Similarity between the cloud's frame and the frame the solver works in. */
struct UnitFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< in the cloud's frame [m]
  double scale = 1.0;                               ///< metres per unit

  Eigen::Vector3d toUnit(const Eigen::Vector3d& p) const {
    return (p - origin) / scale;
  }
  Superquadric toUnit(Superquadric s) const {
    s.center = toUnit(s.center);
    s.semi_axes /= scale;
    return s;
  }
  Superquadric toCloud(Superquadric s) const {
    s.center = s.center * scale + origin;
    s.semi_axes *= scale;
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

/** \brief The shape's numbers for the kernels. */
kernels::Shape toShape(const Superquadric& superquadric);

} // namespace pcl_sq::detail

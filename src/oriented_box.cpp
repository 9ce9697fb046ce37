// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/oriented_box.h"

#include "simplex.h"

namespace pcl_sq {

namespace {

constexpr int MAX_STEPS = 64;

/** \brief Point of the box farthest along n. */
Eigen::Vector3d farthest(const OrientedBox& box, const Eigen::Vector3d& n) {
  Eigen::Vector3d local = box.rotation.transpose() * n;
  for (int k = 0; k < 3; ++k)
    local[k] = std::copysign(box.half_sizes[k], local[k]);
  return box.center + box.rotation * local;
}

/** \brief Whether the boxes in their own axes are apart by a face normal of either:
 * cheap, and enough for most pairs. */
bool apartByFaces(const OrientedBox& box, const Superquadric& s, double clearance) {
  const Eigen::Matrix3d between = box.rotation.transpose() * s.rotation;
  const Eigen::Matrix3d size = between.cwiseAbs();
  const Eigen::Vector3d offset = s.center - box.center;
  const Eigen::Array3d in_box = (box.rotation.transpose() * offset).cwiseAbs();
  if ((in_box > (box.half_sizes + size * s.semi_axes).array() + clearance).any())
    return true;
  const Eigen::Array3d in_superquadric = (s.rotation.transpose() * offset).cwiseAbs();
  return (in_superquadric >
          (s.semi_axes + size.transpose() * box.half_sizes).array() + clearance)
      .any();
}

/** \brief Gilbert-Johnson-Keerthi. \param[in] enough distance from which the pair
 * counts as apart: the search ends as soon as it is on one side of it (infinite: find
 * the distance itself) \return the distance, or a bound of it on the side of enough */
double
gjk(const OrientedBox& box, const Superquadric& s, double enough, bool find_distance) {
  detail::Simplex simplex;
  Eigen::Vector3d v = box.center - s.center;
  if (v.isZero(0.0))
    return 0.0;
  double lower = 0.0;
  for (int step = 0; step < MAX_STEPS; ++step) {
    const double length = v.norm();
    const Eigen::Vector3d w = farthest(box, -v) - s.supportPoint(v);
    lower = std::max(lower, v.dot(w) / length);
    if (!find_distance && lower >= enough)
      return lower;
    const bool converged = step > 0 && length - lower <= 1e-7 * length + 1e-12;
    if (converged || simplex.contains(w))
      return step > 0 ? length : lower;
    simplex.add(w);
    v = simplex.closestToOrigin();
    if (simplex.size() == 4 || v.norm() < 1e-12)
      return 0.0;
    if (!find_distance && v.norm() < enough)
      return v.norm();
  }
  return v.norm();
}

} // namespace

std::array<Eigen::Vector3d, 8> OrientedBox::corners() const {
  std::array<Eigen::Vector3d, 8> all;
  for (unsigned i = 0; i < 8; ++i) {
    const Eigen::Vector3d signs(i & 1u ? 1 : -1, i & 2u ? 1 : -1, i & 4u ? 1 : -1);
    all[i] = center + rotation * half_sizes.cwiseProduct(signs);
  }
  return all;
}

double distance(const OrientedBox& box, const Superquadric& superquadric) {
  return std::max(gjk(box, superquadric, 0.0, true), 0.0);
}

bool collides(const OrientedBox& box,
              const Superquadric& superquadric,
              double clearance) {
  if (apartByFaces(box, superquadric, clearance))
    return false;
  if (superquadric.gauge(box.center) <= 1.0)
    return true;
  const double enough = std::max(clearance, 1e-9);
  return gjk(box, superquadric, enough, false) < enough;
}

} // namespace pcl_sq

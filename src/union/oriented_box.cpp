// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/oriented_box.h"

#include "geometry/bend.h"
#include "union/simplex.h"

#include <limits>

namespace pcl_sq {

namespace {

constexpr int GJK_STEPS = 64;
/** \brief What a bent body may be thickened by in its hollow, over its section's half
 * width: as much as its surface is uncertain. */
constexpr double HULL = 0.05;

/** \brief Point of the box farthest along n. */
Eigen::Vector3d farthest(const OrientedBox& box, const Eigen::Vector3d& n) {
  Eigen::Vector3d local = box.rotation.transpose() * n;
  for (int k = 0; k < 3; ++k)
    local[k] = std::copysign(box.half_sizes[k], local[k]);
  return box.center + box.rotation * local;
}

/** \brief Whether the box and the superquadric's own box are apart along a face normal
 * of either: no power needed, and enough for most pairs. \param[out] axis
 * the box's normal with the largest gap */
bool apartByFaces(const OrientedBox& box,
                  const Superquadric& s,
                  double clearance,
                  Eigen::Index& axis) {
  const Eigen::Matrix3d size = (box.rotation.transpose() * s.rotation).cwiseAbs();
  const Eigen::Vector3d half = s.halfSizes();
  const Eigen::Vector3d offset = s.center - box.center;
  const Eigen::Array3d gaps = (box.rotation.transpose() * offset).cwiseAbs().array() -
                              (box.half_sizes + size * half).array();
  if (gaps.maxCoeff(&axis) > clearance)
    return true;
  return ((s.rotation.transpose() * offset).cwiseAbs().array() >
          (half + size.transpose() * box.half_sizes).array() + clearance)
      .any();
}

/** \brief Point of the box nearest to another. */
Eigen::Vector3d nearest(const OrientedBox& box, const Eigen::Vector3d& point) {
  const Eigen::Vector3d local = box.rotation.transpose() * (point - box.center);
  return box.center +
         box.rotation * local.cwiseMax(-box.half_sizes).cwiseMin(box.half_sizes);
}

/** \brief Gilbert-Johnson-Keerthi. \param[in] enough distance from which the pair
 * counts as apart: the search ends as soon as it is on one side of it (infinite: find
 * the distance itself) \return the distance, or a bound of it on the side of enough */
template <typename Farthest>
double gjk(const OrientedBox& box,
           const Eigen::Vector3d& center,
           const Farthest& farthest_of_body,
           double enough,
           bool find_distance) {
  detail::Simplex simplex;
  Eigen::Vector3d v = box.center - center;
  if (v.isZero(0.0))
    return 0.0;
  double lower = 0.0;
  for (int step = 0; step < GJK_STEPS; ++step) {
    const double length = v.norm();
    const Eigen::Vector3d w = farthest(box, -v) - farthest_of_body(v);
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

/** \brief The same for a body as its convex hull, of a bent one stretch by stretch. */
double
gjk(const OrientedBox& box, const Superquadric& s, double enough, bool find_distance) {
  if (!s.isBent())
    return gjk(
        box,
        s.center,
        [&](const Eigen::Vector3d& n) { return s.supportPoint(n); },
        enough,
        find_distance);
  // a finger fits into the bend: there a stretch's hull may stand off by R angle^2 / 2
  const double sagitta = HULL * s.semi_axes.head<2>().minCoeff();
  const int pieces =
      detail::convexPieces(s, std::sqrt(2.0 * sagitta * std::abs(s.bend)));
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < pieces; ++i) {
    const double low = -1.0 + 2.0 * i / pieces, high = -1.0 + 2.0 * (i + 1) / pieces;
    const double middle = 0.5 * (low + high) * s.semi_axes.z();
    const detail::BentSupport slices(s, low, high);
    const auto farthest_of_piece = [&](const Eigen::Vector3d& n) {
      return s.toWorld(slices.contact(s.rotation.transpose() * n).at);
    };
    least = std::min(least,
                     gjk(box,
                         s.toWorld(detail::bent(s, {0.0, 0.0, middle})),
                         farthest_of_piece,
                         enough,
                         find_distance));
    if (least <= 0.0 || (!find_distance && least < enough))
      break;
  }
  return least;
}

/** \brief Whether all of a box that is below the rim of a hollow body lies in its
 * hollow, no nearer to the material than \a clearance: the corners of what is left of
 * the box, for a hollow is convex where its body is. */
bool liesInHollow(const OrientedBox& box, const Superquadric& s, double clearance) {
  Superquadric shrunk = s;
  shrunk.wall = s.wall + std::max(clearance, 0.0);
  if (!shrunk.isValid())
    return false;
  const double rim = s.rimHeight() * s.semi_axes.z();
  const double below = rim - 1e-9 * s.semi_axes.z();
  std::array<Eigen::Vector3d, 8> corners = box.corners();
  for (Eigen::Vector3d& c : corners)
    c = s.toLocal(c);
  const auto in = [&](const Eigen::Vector3d& p) {
    return shrunk.inHollow(s.toWorld({p.x(), p.y(), std::min(p.z(), below)}));
  };
  for (unsigned i = 0; i < 8; ++i) {
    if (corners[i].z() <= rim && !in(corners[i]))
      return false;
    for (unsigned bit = 1; bit < 8; bit <<= 1) { // the edges through the rim's plane
      const Eigen::Vector3d &a = corners[i], &b = corners[i ^ bit];
      if (!(i & bit) && (a.z() <= rim) != (b.z() <= rim) &&
          !in(a + (rim - a.z()) / (b.z() - a.z()) * (b - a)))
        return false;
    }
  }
  return true;
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

TriangleMesh meshBox(const OrientedBox& box) {
  TriangleMesh mesh;
  const auto corners = box.corners();
  mesh.vertices.assign(corners.begin(), corners.end());
  mesh.triangles = {{0, 2, 1},
                    {1, 2, 3},
                    {4, 5, 6},
                    {5, 7, 6},
                    {0, 1, 4},
                    {1, 5, 4},
                    {2, 6, 3},
                    {3, 6, 7},
                    {0, 4, 2},
                    {2, 4, 6},
                    {1, 3, 5},
                    {3, 7, 5}};
  return mesh;
}

double distance(const OrientedBox& box, const Superquadric& superquadric) {
  return std::max(gjk(box, superquadric, 0.0, true), 0.0);
}

bool collides(const OrientedBox& box,
              const Superquadric& superquadric,
              double clearance) {
  Eigen::Index axis;
  if (apartByFaces(box, superquadric, clearance, axis))
    return false;
  if (superquadric.isHollow() && liesInHollow(box, superquadric, clearance))
    return false;
  // a gripper's pads are tangent planes: their normal separates most of what is left
  Eigen::Vector3d n = box.rotation.col(axis);
  if (n.dot(superquadric.center - box.center) < 0.0)
    n = -n;
  if (n.dot(superquadric.center) - superquadric.support(-n) - box.support(n) >
      clearance)
    return false;
  if (superquadric.gauge(nearest(box, superquadric.center)) <= 1.0)
    return true;
  const double enough = std::max(clearance, 1e-9);
  return gjk(box, superquadric, enough, false) < enough;
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
// Closing lines across the wall of an open vessel, at its rim: one finger inside, one
// outside.
#include "grasp/closing_lines.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int PLACES = 36; ///< around the rim
/** \brief Of the contacts below the rim, over the shifts that a grasp must stand
 * (GraspScores::robustness looks at one and two of them): where the table leaves no
 * room below the larger one, as under a plate's edge, the smaller one has to do. */
constexpr double DEPTHS[] = {2.5, 1.25};
constexpr int BISECTIONS = 40;
/** \brief Of a closing line from the normal towards level, over the friction cone's
 * half angle: from the side of a sloping wall the table is in the way. */
constexpr double TILTS[] = {0.0, 0.45, 0.9};

} // namespace

Eigen::Vector3d ClosingLines::levelled(const Eigen::Vector3d& normal,
                                       const Eigen::Vector3d& up,
                                       double share) const {
  const Eigen::Vector3d level = (normal - up * up.dot(normal)).normalized();
  const double slope = std::acos(std::clamp(normal.dot(level), -1.0, 1.0));
  const double turn = std::min(slope, share * std::atan(options_.friction));
  if (!(slope > 1e-6))
    return normal;
  return (std::sin(slope - turn) * normal + std::sin(turn) * level) / std::sin(slope);
}

bool ClosingLines::throughWall(const Superquadric& s,
                               const Eigen::Vector3d& outside,
                               const Eigen::Vector3d& axis,
                               ClosingLine& line) const {
  // across it the wall is as thick as its slope makes it, or thinner
  double solid = 0.0, hollow = 0.0;
  for (const double thickness : {1.05, 0.8, 0.6, 0.4, 0.2})
    if (s.inHollow(outside - thickness * s.wall * axis))
      hollow = thickness * s.wall;
  if (!(hollow > 0.0))
    return false;
  for (int i = 0; i < BISECTIONS; ++i) {
    const double middle = 0.5 * (solid + hollow);
    (s.inHollow(outside - middle * axis) ? hollow : solid) = middle;
  }
  line.points = {outside - hollow * axis, outside};
  line.normals = {s.normal(line.points[0]), s.normal(outside)};
  line.axis = axis;
  line.width = hollow;
  line.at_rim = true;
  setSlope(line);
  return true;
}

void ClosingLines::findOnRim(std::size_t part, std::vector<ClosingLine>& lines) const {
  const Superquadric& s = object_.parts[part];
  const double a3 = s.semi_axes.z(), rim = s.rimHeight() * a3;
  const double deepest = 0.5 * (rim + a3 - s.wall);
  const double reach = s.halfSizes().head<2>().maxCoeff();
  for (int i = 0; i < PLACES * int(std::size(DEPTHS)); ++i) {
    const double angle = 2.0 * M_PI * i / PLACES;
    const double depth = std::min(DEPTHS[i / PLACES] * options_.shift, deepest);
    const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
    double inside = 0.0, outside = 2.0 * reach; // of the body at that height
    const auto at = [&](double radius) {
      return s.toWorld(radius * direction + (rim - depth) * Eigen::Vector3d::UnitZ());
    };
    for (int k = 0; k < BISECTIONS; ++k) {
      const double middle = 0.5 * (inside + outside);
      (s.contains(at(middle)) ? inside : outside) = middle;
    }
    const Eigen::Vector3d place = at(outside), normal = s.normal(place);
    for (const double share : TILTS) {
      ClosingLine line;
      line.parts = {part, part};
      if (throughWall(s, place, levelled(normal, s.rotation.col(2), share), line))
        lines.push_back(line);
    }
  }
}

} // namespace pcl_sq::detail

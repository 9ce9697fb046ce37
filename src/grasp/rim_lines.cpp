// SPDX-License-Identifier: BSD-3-Clause
// Closing lines across the wall of an open vessel, at its rim: one finger inside, one
// outside.
#include "grasp/closing_lines.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int PLACES = 36; ///< around the rim
/** \brief Of the contacts below the rim, over the largest shift that a grasp must stand
 * (GraspScores::robustness). */
constexpr double DEPTH = 1.25;
constexpr int BISECTIONS = 40;

} // namespace

bool ClosingLines::throughWall(const Superquadric& s,
                               const Eigen::Vector3d& outside,
                               ClosingLine& line) const {
  const Eigen::Vector3d normal = s.normal(outside);
  // along the normal the wall is as thick as its slope makes it, or thinner
  double solid = 0.0, hollow = 0.0;
  for (const double thickness : {1.05, 0.8, 0.6, 0.4, 0.2})
    if (s.inHollow(outside - thickness * s.wall * normal))
      hollow = thickness * s.wall;
  if (!(hollow > 0.0))
    return false;
  for (int i = 0; i < BISECTIONS; ++i) {
    const double middle = 0.5 * (solid + hollow);
    (s.inHollow(outside - middle * normal) ? hollow : solid) = middle;
  }
  line.points = {outside - hollow * normal, outside};
  line.normals = {s.normal(line.points[0]), normal};
  line.axis = normal;
  line.width = hollow;
  line.at_rim = true;
  setSlope(line);
  return true;
}

void ClosingLines::findOnRim(std::size_t part, std::vector<ClosingLine>& lines) const {
  const Superquadric& s = object_.parts[part];
  const double a3 = s.semi_axes.z(), rim = s.rimHeight() * a3;
  const double depth =
      std::min(DEPTH * 2.0 * options_.shift, 0.5 * (rim + a3 - s.wall));
  const double reach = s.halfSizes().head<2>().maxCoeff();
  for (int i = 0; i < PLACES; ++i) {
    const double angle = 2.0 * M_PI * i / PLACES;
    const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0.0);
    double inside = 0.0, outside = 2.0 * reach; // of the body at that height
    const auto at = [&](double radius) {
      return s.toWorld(radius * direction + (rim - depth) * Eigen::Vector3d::UnitZ());
    };
    for (int k = 0; k < BISECTIONS; ++k) {
      const double middle = 0.5 * (inside + outside);
      (s.contains(at(middle)) ? inside : outside) = middle;
    }
    ClosingLine line;
    line.parts = {part, part};
    if (throughWall(s, at(outside), line))
      lines.push_back(line);
  }
}

} // namespace pcl_sq::detail

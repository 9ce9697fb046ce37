// SPDX-License-Identifier: BSD-3-Clause
// Closing lines within one part, by the symmetries of the straight body.
#include "geometry/taper.h"
#include "grasp/closing_lines.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

/** \brief The reflections and half turns of a superquadric's axes, by their signs. */
constexpr int SYMMETRIES[7][3] = {{-1, 1, 1},
                                  {1, -1, 1},
                                  {1, 1, -1},
                                  {-1, -1, 1},
                                  {-1, 1, -1},
                                  {1, -1, -1},
                                  {-1, -1, -1}};

/** \brief Positions along half an edge of the face of a cube, from its middle; the
 * edge itself, where normals turn, is left out. */
double row(int i, int rows) {
  return rows == 1 ? 0.0 : std::tan(0.25 * M_PI * 0.87 * i / (rows - 1));
}

/** \brief The closing lines of a surface point and of its images, by all symmetries.
 * \param[in] p point of the eighth with no negative coordinate, own frame; of a
 * tapered part or one with a rim also of that with negative z
 * \param[in] n its outward normal */
void addSymmetricLines(const Superquadric& s,
                       std::size_t part,
                       const Eigen::Vector3d& p,
                       const Eigen::Vector3d& n,
                       std::vector<ClosingLine>& lines) {
  for (const auto& signs : SYMMETRIES) {
    if (!s.isPlain() && signs[2] < 0)
      continue; // its halves above and below z = 0 differ
    const Eigen::Vector3d g(signs[0], signs[1], signs[2]);
    const Eigen::Vector3d chord = p - g.cwiseProduct(p);
    const double width = chord.norm(), cosine = std::min(n.dot(chord) / width, 1.0);
    // a coordinate of zero makes this symmetry the same as another
    if (!(cosine > MIN_COSINE) || ((g.array() < 0.0) && (p.array() == 0.0)).any())
      continue;
    int first = 0; // g swaps the pair: of an image and its swap one is enough
    while (signs[first] > 0)
      ++first;
    for (unsigned image = 0; image < (s.isPlain() ? 8u : 4u); ++image) {
      const Eigen::Vector3d flip(
          image & 1u ? -1 : 1, image & 2u ? -1 : 1, image & 4u ? -1 : 1);
      if (flip[first] < 0.0 || ((flip.array() < 0.0) && (p.array() == 0.0)).any())
        continue;
      ClosingLine line;
      const Eigen::Vector3d q = flip.cwiseProduct(p), m = flip.cwiseProduct(n);
      line.points = {s.toWorld(q), s.toWorld(g.cwiseProduct(q))};
      line.normals = {s.rotation * m, s.rotation * g.cwiseProduct(m)};
      line.parts = {part, part};
      line.axis = (line.points[1] - line.points[0]) / width;
      line.width = width;
      line.slope = std::sqrt(1.0 - cosine * cosine) / cosine;
      lines.push_back(line);
    }
  }
}

/** \brief Closing lines across the sections of a bent body: from the images of a point
 * of the straight body, an eighth of it, to the places opposite. */
void addBentLines(const Superquadric& s,
                  std::size_t part,
                  const Eigen::Vector3d& straight,
                  std::vector<ClosingLine>& lines) {
  static constexpr int OPPOSITE[3][2] = {{-1, 1}, {1, -1}, {-1, -1}};
  for (const auto& signs : OPPOSITE)
    for (unsigned image = 0; image < 8; ++image) {
      const Eigen::Vector3d flip(
          image & 1u ? -1 : 1, image & 2u ? -1 : 1, image & 4u ? -1 : 1);
      const int first = signs[0] < 0 ? 0 : 1;
      if (flip[first] < 0.0 ||
          ((flip.array() < 0.0) && (straight.array() == 0.0)).any())
        continue;
      const Eigen::Vector3d p = flip.cwiseProduct(straight);
      const Eigen::Vector3d q(signs[0] * p.x(), signs[1] * p.y(), p.z());
      ClosingLine line;
      line.points = {s.toWorld(deformed(s, p)), s.toWorld(deformed(s, q))};
      line.width = (line.points[1] - line.points[0]).norm();
      if (!(line.width > 0.0))
        continue;
      line.axis = (line.points[1] - line.points[0]) / line.width;
      line.normals = {s.normal(line.points[0]), s.normal(line.points[1])};
      line.parts = {part, part};
      const double cosine =
          std::min(-line.normals[0].dot(line.axis), line.normals[1].dot(line.axis));
      if (!(cosine > MIN_COSINE))
        continue;
      line.slope = std::sqrt(std::max(1.0 - cosine * cosine, 0.0)) / cosine;
      lines.push_back(line);
    }
}

} // namespace

void ClosingLines::findOnPart(std::size_t part, std::vector<ClosingLine>& lines) const {
  const Superquadric& s = object_.parts[part];
  Superquadric own = s; // in its own frame, where the symmetries are changes of sign
  own.center.setZero();
  own.rotation.setIdentity();
  // the longer an axis, the more rows along it
  const Eigen::Vector3d share = s.semi_axes / std::cbrt(s.semi_axes.prod());
  Eigen::Vector3i rows;
  for (int k = 0; k < 3; ++k)
    rows[k] = std::clamp(int(std::lround(options_.surface_samples * share[k])),
                         std::min(options_.surface_samples, 2),
                         3 * options_.surface_samples);
  for (int face = 0; face < 3; ++face) {
    const int u = (face + 1) % 3, v = (face + 2) % 3;
    for (int i = 0; i < rows[u]; ++i)
      for (int j = 0; j < rows[v]; ++j) {
        Eigen::Vector3d direction;
        direction[face] = 1.0;
        direction[u] = row(i, rows[u]);
        direction[v] = row(j, rows[v]);
        const Eigen::Vector3d p =
            own.radialProjection(own.deformed(direction.cwiseProduct(s.semi_axes)));
        if (!s.isBent())
          addSymmetricLines(s, part, p, own.normal(p), lines);
        if (s.isPlain())
          continue;
        if (s.isBent()) {
          addBentLines(s, part, own.straightened(p), lines);
          continue;
        }
        direction.z() = -direction.z();
        const Eigen::Vector3d below =
            own.radialProjection(own.deformed(direction.cwiseProduct(s.semi_axes)));
        addSymmetricLines(s, part, below, own.normal(below), lines);
        // from end to end, which no symmetry pairs
        for (unsigned image = 0; image < 4; ++image) {
          const Eigen::Vector3d flip(image & 1u ? -1 : 1, image & 2u ? -1 : 1, 1.0);
          ClosingLine line;
          if (cast(s.toWorld(flip.cwiseProduct(p)), s.rotation.col(2), part, line))
            lines.push_back(line);
        }
      }
  }
}

} // namespace pcl_sq::detail

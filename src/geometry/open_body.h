// SPDX-License-Identifier: BSD-3-Clause
// Private. Bodies with a rim, hollow or not: their sections, their meridian, the
// nearest place of their surface.
#pragma once

#include "geometry/taper.h"

#include <functional>
#include <vector>

namespace pcl_sq::detail {

/** \brief Semi-axes of a section across z. */
struct Section {
  double a = 0.0, b = 0.0; ///< zero where there is none
  bool empty() const { return !(a > 0.0 && b > 0.0); }
};

/** \brief The body's section at a height over a3, shrunk by \a inset on its sides. */
Section sectionAt(const Superquadric& s, double height, double inset = 0.0);

/** \brief Latitude eta of a height over a3: height = sin^e1(eta). */
double latitudeOf(const Superquadric& s, double height);

/** \brief A body of sharp edges and straight walls, cut anywhere, as one that is cut
 * near its top; others as they are. The two differ by less than their walls bend there,
 * a five-hundredth of the radius. Who walks over the surface at equal angles meets few
 * heights of such a body but those near its top. */
PCL_SQ_EXPORTS Superquadric withRimNearTop(const Superquadric& s);

/** \brief Height of the hollow's floor over a3. */
inline double floorHeight(const Superquadric& s) {
  return s.wall / s.semi_axes.z() - 1.0;
}

/** \brief Whether a place of the section's plane lies in it. */
bool contains(const Section& section, double epsilon2, double x, double y);

/** \brief A place on the surface, and what lies behind it. */
struct SurfacePlace {
  Eigen::Vector3d at;     ///< in the own frame
  Eigen::Vector3d normal; ///< out of the material, unit length
};

/** \brief The place of a body's surface nearest to another, both in its own frame. */
SurfacePlace nearestPlace(const Superquadric& s, const Eigen::Vector3d& local);

/** \brief The outline of half a section through the axis of a body with a rim: from the
 * pole below along the outside to the rim, over it, and down the inside to the middle
 * of the floor. A solid of revolution has the same one all round. */
class Meridian {
public:
  /** \param[in] direction of the half plane in the section, own frame */
  Meridian(const Superquadric& s, const Eigen::Vector2d& direction);

  /** \brief Signed distance of a place in the half plane, negative in the material: of
   * a solid of revolution the Euclidean distance of a point, an upper bound otherwise.
   * \param[in] rho distance from the axis */
  double distance(double rho, double z) const;

  /** \brief The outline as the kernels want it, its chords so short that none misses
   * the curve by more than a STRAIGHT part of the body's size. For many points.
   * \param[out] numbers of the outline, to be kept */
  kernels::Outline table(std::vector<float>& numbers) const;

private:
  /** \brief A side of a polygon. */
  struct Chord {
    Eigen::Vector2d begin, side;
    double inverse; ///< of its squared length

    Chord(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
    double squareTo(const Eigen::Vector2d& p) const;
  };
  /** \brief A curve of the outline at equal steps of the latitude, where corners are
   * dense; its places are points (1 - |s|, s) of a line, scaled onto the superellipse,
   * for small exponents make powers of the latitude steep. */
  struct Curve {
    double inset = 0.0;
    std::vector<double> places;          ///< s
    std::vector<Eigen::Vector2d> points; ///< rho, z
    std::vector<Chord> chords;           ///< between them
    std::vector<bool> straight;          ///< whether the chord is as good as the curve
    double miss = 0.0;                   ///< by how much any chord misses the curve
  };
  Eigen::Vector2d at(double s, double inset) const;
  /** \brief Rim, or lid, and floor. */
  std::vector<Chord> straightSides() const;
  void addCurve(double inset, double low, double high);
  /** \brief Distance to a curve, or more than \a enough where it is sure to be. */
  double distanceTo(const Curve& curve, const Eigen::Vector2d& p, double enough) const;

  const Superquadric& s_;
  Eigen::Vector2d direction_;
  std::vector<Curve> curves_;            ///< outside, inside
  std::vector<Eigen::Vector2d> polygon_; ///< of the material, the axis its last side
};

/** \brief A section of a body with its height [m], own frame. */
struct Ring {
  Section section;
  double z = 0.0;
};

/** \brief Rings of a body with a rim, one list for each smooth stretch of its surface:
 * the outside from the pole below, the rim (or the lid), the inside from the rim down,
 * the floor. A list begins where the one before ends.
 * \param[in] steps along the outside */
PCL_SQ_EXPORTS std::vector<std::vector<Ring>> ringsOf(const Superquadric& s, int steps);

/** \brief A point on a ring; it lies in the direction of the angle where the section is
 * as wide as deep. */
PCL_SQ_EXPORTS Eigen::Vector3d onRing(const Ring& ring, double epsilon2, double angle);

/** \brief Whether a solid with a rim is one of revolution. */
inline bool isRound(const Superquadric& s) {
  return s.epsilon2 == 1.0 && s.kx == s.ky && s.semi_axes.x() == s.semi_axes.y();
}

/** \brief Signed distance of a point of the own frame to the surface of a body with a
 * rim, see Meridian. */
double meridianDistance(const Superquadric& s, const Eigen::Vector3d& local);

/** \brief residualsOf() for a body with a rim. A gauge less one is a distance over one
 * to the centre; of a hollow body that would say nothing of its inside, and it is the
 * distance over the geometric mean of the semi-axes. */
void openResiduals(const Superquadric& s,
                   const UnitPoints& points,
                   kernels::Residual residual,
                   float* out);

/** \brief Integrals of 1, x^2 and y^2 over a section. */
struct SectionMoments {
  double area, xx, yy;
};

/** \brief Calls \a use with z, dz [m] and the section's moments, so that sums are
 * integrals over the body between two heights over a3, shrunk by an inset: Gauss's rule
 * between heights of equal steps of the latitude, which are dense at the poles, where
 * the section's size is steep. */
void forEachSection(
    const Superquadric& s,
    double low,
    double high,
    double inset,
    const std::function<void(double, double, const SectionMoments&)>& use);

/** \brief Integrals of 1, z, x^2, y^2 and z^2 over a body in its own frame. */
struct AxialMoments {
  double volume = 0.0, z = 0.0, xx = 0.0, yy = 0.0, zz = 0.0;
  AxialMoments operator-(const AxialMoments& o) const {
    return {volume - o.volume, z - o.z, xx - o.xx, yy - o.yy, zz - o.zz};
  }
};

/** \brief Those of a body filled up to its rim. */
AxialMoments filledMoments(const Superquadric& s);
/** \brief Those of its hollow; zero where there is none. */
AxialMoments hollowMoments(const Superquadric& s);

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
// Private. Inner loops of every fit, on plain float arrays: no Eigen and no PCL type is
// seen by the files that are compiled for wide registers, nor a public header, which
// refuses them.
#pragma once

#include <cstddef>

namespace pcl_sq::kernels {

/** \brief Arrays may be read up to the next multiple of this many points. */
constexpr std::size_t BLOCK = 128;
/** \brief Parameters: t (3, along the own axes), w (3, right rotation), ln a (3), e1,
 * e2: the order of Superquadric::logGaugeJacobian(). */
constexpr int PARAMETERS = 11;
constexpr int ROWS = PARAMETERS + 1; ///< the Jacobian's columns and the residual
/** \brief The same with kx and ky behind. */
constexpr int TAPERED_PARAMETERS = 13;
/** \brief The Jacobian's columns, the residual, and one of zeros: loops take threes. */
constexpr int TAPERED_ROWS = TAPERED_PARAMETERS + 2;

/** \brief Points of size about one around the origin, so that floats suffice. */
struct Points {
  const float* x;
  const float* y;
  const float* z;
  /** \brief Factor of each squared residual; nullptr: all one. */
  const float* precision;
  std::size_t count;
};

/** \brief A superquadric in the frame of the points. */
struct Shape {
  float axes[3][3];      ///< rows: the own axes, R^T
  float offset[3];       ///< R^T center
  float inverse_axis[3]; ///< 1 / a
  float epsilon1, epsilon2;
  float kx, ky; ///< the taper; only the loops for tapered bodies read it
};

/** \brief Longest over shortest semi-axis from which feet are also looked for along the
 * axes. The gauge takes a point near the edge of a flat box for one of the narrow side,
 * that ratio too far away: up to three, a point one sigma off stays within three. */
constexpr float FLAT = 3.0F;

enum class Residual {
  RADIAL,      ///< |y| (1 - 1/G): the widest basin (Gross & Boult 1988)
  FIRST_ORDER, ///< (1 - 1/G) / |grad ln G| (Taubin 1991)
  FOOT_POINT,  ///< distance to the foot point after one projection: the least bias
  GAUGE,       ///< G - 1, the paper's Eq. (6)
  SOLINA       ///< G^2 - 1 = F^e1 - 1 (Solina & Bajcsy 1990)
};

/** \brief Mixture of a Gaussian on the surface with uniform outliers (M5).
 *
 * The share of the Gaussian is p = exp(-s r^2) / (exp(-s r^2) + c); the cost of a point
 * -ln((exp(-s r^2) + c) / (1 + c)) / s, which is r^2 for c = 0. */
struct Mixture {
  float inverse_two_sigma_squared = 1.0F; ///< s
  float outlier = 0.0F;                   ///< c; 0: plain least squares
};

/** \brief Sums over the points. With p the mixture's share and q the precision.
 * \tparam R ROWS or TAPERED_ROWS */
template <int R>
struct SumsOf {
  double products[R][R]; ///< sum p q j j^T, j = (Jacobian, r); upper triangle
  double cost;           ///< sum of the points' costs
  double share;          ///< sum p: the expected number of inliers
};
using Sums = SumsOf<ROWS>;

/** \brief Planes normal . p = offset, in the frame of the points.
 *
 * A plane's residual is weight (h(normal) + normal . center - offset), with h the
 * support function; it counts only above \a least. */
struct Planes {
  const float* x; ///< of the normal
  const float* y;
  const float* z;
  const float* offset;
  const float* weight; ///< 0 beyond the last plane
  const float* least;  ///< 0 for a half-space, far below for a tangent plane
  const float* shared; ///< share in a common error, see PlaneSums::shared
  std::size_t count;
};

/** \brief Sums over planes; j = (Jacobian, r) as in Sums. */
template <int R>
struct PlaneSumsOf {
  double products[R][R]; ///< sum j j^T; upper triangle
  double shared[R];      ///< sum of j times the plane's share
};
using PlaneSums = PlaneSumsOf<ROWS>;

/** \brief Sides of a polygon or chords of a curve, in the half plane (rho, z). */
struct Sides {
  const float* x;       ///< where each begins: its distance from the axis
  const float* y;       ///< and its height
  const float* along_x; ///< from there to where it ends
  const float* along_y;
  const float* inverse; ///< one over its squared length
};

/** \brief The outline of half a section through the axis of a solid of revolution, in
 * the unit of the points: two curves at most, and straight sides. */
struct Outline {
  static constexpr int STEPS = 40; ///< chords of a curve
  static constexpr int FINE = 8;   ///< chords in the place of each, to be exact
  int curves, edges, corners;
  Sides coarse[2];
  /** \brief FINE x (STEPS + 3): those of the first and of the last chord once more
   * before and twice more behind. */
  Sides fine[2];
  Sides edge;
  /** \brief All sides, the axis too; of them \a inverse is along_x / along_y. */
  Sides polygon;
};

/** \brief A chord of an open vessel's meridian in the half plane (rho, z). */
struct VesselChord {
  static constexpr int SLOPES = 6; ///< ln a, ln a3, e1, k, rim, ln wall
  float x, y;                      ///< where it begins: distance from the axis, height
  float along_x, along_y;          ///< from there to where it ends
  float inverse;                   ///< one over its squared length; 0 where it has none
  float begin[2][SLOPES];          ///< derivatives of its ends, (rho, z)
  float end[2][SLOPES];
};

/** \brief An open vessel of revolution about z: what is seen from outside, then what
 * is seen through its opening. */
struct Vessel {
  const VesselChord* chords;
  int outer, count; ///< chords of the outside, of both
  bool has_eye;     ///< else each point is the nearer wall's
  float eye[3];     ///< own frame
  float rim;        ///< its height
  /** \brief Radii of the opening: rays that cross within the larger one may see the
   * inside, those beyond the smaller one the outside. */
  float wide, narrow;
};

/** \brief One implementation of the loops. */
struct Kernels {
  const char* name;
  void (*normalEquations)(const Points&, const Shape&, Residual, const Mixture&, Sums&);
  /** \brief Residual of each point; GAUGE gives G - 1, and so on. */
  void (*residuals)(const Points&, const Shape&, Residual, float* out);
  /** \brief Cost and share only. */
  void (*evaluate)(const Points&, const Shape&, Residual, const Mixture&, Sums&);
  void (*planes)(const Planes&, const Shape&, PlaneSums&);
  /** \brief Distance of each point to the foot point of a tapered body. */
  void (*taperedResiduals)(const Points&, const Shape&, float* out);
  /** \brief normalEquations() of the distance to the foot point of a tapered body. */
  void (*taperedEquations)(const Points&,
                           const Shape&,
                           const Mixture&,
                           SumsOf<TAPERED_ROWS>&);
  void (*taperedPlanes)(const Planes&, const Shape&, PlaneSumsOf<TAPERED_ROWS>&);
  /** \brief The rows themselves, of at most a block of planes. */
  void (*taperedRows)(const Planes&, const Shape&, float (&rows)[TAPERED_ROWS][BLOCK]);
  /** \brief Signed distance of each point to a solid of revolution, negative inside;
   * of the shape only its place is read. */
  void (*outlineDistances)(const Points&, const Shape&, const Outline&, float* out);
  /** \brief normalEquations() of the distance to a vessel; parameters t, w about x and
   * y, and a chord's slopes. Of the shape only its place is read. */
  void (*vesselEquations)(
      const Points&, const Shape&, const Vessel&, const Mixture&, Sums&);
  /** \brief normalEquations() of the distance to the foot point of a body with e2 = 1
   * that is bent towards its x axis; the curvature stands in e2's place. */
  void (*bentEquations)(const Points&, const Shape&, float bend, const Mixture&, Sums&);
  void (*bentResiduals)(const Points&, const Shape&, float bend, float* out);
};

enum class Isa { PORTABLE, SSE2, AVX2, AVX512 };

/** \brief The loops for one instruction set; nullptr where this machine lacks it. */
[[gnu::visibility("default")]] const Kernels* kernelsFor(Isa isa);
/** \brief The widest loops of this machine. */
[[gnu::visibility("default")]] const Kernels& kernels();

} // namespace pcl_sq::kernels

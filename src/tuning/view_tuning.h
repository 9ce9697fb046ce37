// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file
 * The numbers of the single-view method: what they mean, [unit], and after the
 * semicolon where they come from. "odds" are priors, -2 ln of them; "budget" buys time
 * and no accuracy; "chosen" ones were set on rendered scenes. A size is the deviation
 * of the points, or what the line names. A group is named after the file that uses it,
 * or after what several files share.
 *
 * Range: from half to twice its value a number moves the mean IoU of no set by more
 * than the table in benchmarks/README.md says, which benchmarks/sensitivity.py makes.
 */

#include <cstddef>

namespace pcl_sq::detail::tuning {

// Of all stages.
namespace shared {
/// [1] density of outliers over the Gaussian's peak; the border is 3 sigma
inline constexpr double OUTLIER = 0.01;
/// [sigma] from which on a point is not the body's; Gauss: 6e-5
inline constexpr double STANDS_OFF = 4.0;
/// [-2 ln] of one point, pixel or contradiction, as an outlier; -2 ln OUTLIER
inline constexpr double MAX_COST = 9.2;
} // namespace shared

// Of families and handles, before the points speak.
namespace odds {
/// [-2 ln] odds of 400 to 1 that a part shares the axis of the solid of revolution
/// beside it; odds: lathes, wheels, moulds
inline constexpr double SHARED_AXIS = 12.0;
/// [-2 ln] odds against a taper: one view, uneven noise and joints feign one; odds
inline constexpr double TAPER = 20.0;
/// [-2 ln] the same against a bent rod: points of a straight body's one side bend as
/// well; odds
inline constexpr double BENT = 20.0;
/// [-2 ln] the same against an open vessel: as many things are, but a wall follows what
/// is none; odds
inline constexpr double VESSEL = 10.0;
/// [log] deviation of depth over width of what one view shows; household things
inline constexpr double DEPTH_SIGMA = 0.4;
/// [log] deviation of a part's least size over its middle one: cans 0, cartons -1,
/// books and plates -2; household things
inline constexpr double THIN_SIGMA = 1.0;
} // namespace odds

namespace view_problem {
/// [1] cosine of 0.35 rad to the table's normal: an axis that may be upright; chosen
inline constexpr double UPRIGHT = 0.9394;
/// [points] fewer are not fitted; a superquadric has 11 parameters
inline constexpr std::size_t MIN_POINTS = 12;
/// [points] of the first rounds of a search; budget
inline constexpr std::size_t COARSE_POINTS = 128;
/// [points] of its refinement; budget
inline constexpr std::size_t MEDIUM_POINTS = 512;
/// [planes] of the outline in the first rounds; budget
inline constexpr int FEW_PLANES = 16;
} // namespace view_problem

namespace view_fit {
/// [size] of the search, in the points' deviation; budget
inline constexpr double START_SIGMA = 0.1;
/// [starts] that are refined; budget
inline constexpr std::size_t KEPT = 3;
} // namespace view_fit

namespace view_shapes {
/// [1] of a box at its start; budget
inline constexpr double BOX_EPSILON = 0.2;
/// [steps] of a family's fit; budget
inline constexpr int ITERATIONS = 20;
/// [steps] after which a family's fit may be given up; budget
inline constexpr int JUDGED = 5;
} // namespace view_shapes

// Of taper, bend and vessel alike.
namespace family {
/// [1] a rod's ends and a vessel's wall are not pinched; household things
inline constexpr double MAX_EPSILON = 1.5;
/// [1] largest step of a parameter; trust region
inline constexpr double TRUST = 0.5;
/// [1] of the points beyond an extent's end; strays
inline constexpr double CUT = 0.02;
/// [1] cost per observation from which on no family is near the body, and the next is
/// looked for; chosen; the noise's share is 1
inline constexpr double MISFIT = 1.3;
/// [size] sigma of a family's search, in the points' deviation; budget
inline constexpr double WIDE = 0.03;
/// [steps] of a family's search; budget
inline constexpr int SEARCH_ITERATIONS = 12;
} // namespace family

namespace fit_taper {
/// [starts] that are refined; budget
inline constexpr std::size_t KEPT = 2;
/// [steps] of a fit; budget
inline constexpr int ITERATIONS = 20;
/// [steps] of the search: it but ranks its starts; budget
inline constexpr int ROUGH_ITERATIONS = 10;
/// [1] of the score test's step; rounding
inline constexpr double DAMPING = 1e-3;
} // namespace fit_taper

namespace bent_problem {
/// [1/size] curvature: a bend of zero is none; rounding
inline constexpr double SLIGHTEST = 1e-6;
} // namespace bent_problem

namespace bent_starts {
/// [1] depth over half the width of a rod that is seen whole; chosen; 1 is half a rod,
/// 2 a whole one
inline constexpr double ONE_SIDED = 1.6;
/// [1] of a rod with rounded ends; budget
inline constexpr double START_EPSILON = 0.4;
/// [1] of what is valid, that a start is bent; budget
inline constexpr double MOST_BENT = 0.9;
} // namespace bent_starts

namespace vessel_starts {
/// [1] directions in which a whole vessel's width is looked at; budget
inline constexpr int DIRECTIONS = 12;
/// [radius] by which a handle widens a vessel at least; fingers go through it
inline constexpr double NO_HANDLE = 0.1;
} // namespace vessel_starts

namespace fit_bent {
/// [steps] of a last fit where the points show all sides; budget
inline constexpr int ALL_ROUND_ITERATIONS = 6;
/// [1] least length over width of a rod; definition
inline constexpr double SLENDER = 2.0;
/// [1] of a rod's length that has points; chosen
inline constexpr double SEEN_LENGTH = 0.6;
/// [1] of the points beyond either end; strays
inline constexpr double STRAY = 0.02;
/// [rad] to either side, of a bend that starts straight; budget
inline constexpr double SLIGHT = 0.1;
/// [steps] of the search, after which the promising starts go on; budget
inline constexpr int FIRST_ITERATIONS = 4;
/// [starts] that go on; budget
inline constexpr std::size_t PROMISING = 4;
/// [starts] that are refined; budget
inline constexpr std::size_t KEPT = 2;
/// [steps] of a fit; budget
inline constexpr int ITERATIONS = 25;
} // namespace fit_bent

namespace vessel_problem {
/// [a3] lowest rim; below, a plate's depth is none
inline constexpr double MIN_RIM = -0.9;
/// [a3] highest rim: above, the mouth is a point; geometry
inline constexpr double MAX_RIM = 0.97;
/// [1] of a vessel; above, its foot is a point
inline constexpr double MAX_TAPER = 0.9;
/// [a3] largest step of the rim; trust region
inline constexpr double RIM_TRUST = 0.3;
/// [radius] thickest wall, also over the depth: a thicker one is a solid in disguise;
/// geometry
inline constexpr double MOST_WALL = 0.3;
/// [log] of the wall's thickness over the radius, where one side is seen; pots, bowls,
/// mugs, glasses: 0.04 to 0.12
inline constexpr double LOG_WALL = -2.7;
/// [log] its deviation; the same
inline constexpr double LOG_WALL_SIGMA = 0.5;
} // namespace vessel_problem

namespace fit_vessel {
/// [1] of a whole cloud's points on either side of a wall, at least; chosen
inline constexpr double BOTH_SIDES = 0.15;
/// [sigma] of the wall's thickness, that tell it from noise; Gauss: 3e-3
inline constexpr double RESOLVED = 3.0;
/// [size] how far things are off the best vessel, in the points' deviation; household
/// things
inline constexpr double MODEL_ERROR = 0.01;
/// [1] of the points, that a vessel with a handle explains; chosen
inline constexpr double EXPLAINED = 0.75;
/// [size] of points without noise, in their deviation; single precision
inline constexpr double MIN_SIGMA = 1e-3;
/// [1] of the points that a solid hides, from which on they are no outliers; twice
/// OUTLIER
inline constexpr double SEEN_BEHIND = 0.02;
/// [sigma] along the ray before a point is behind; Gauss: 6e-5
inline constexpr double BEHIND = 4.0;
/// [steps] of a fit; budget
inline constexpr int ITERATIONS = 30;
/// [starts] that are fitted, of all; budget
inline constexpr std::size_t ROUGH = 6;
/// [starts] of those that are refined; budget
inline constexpr std::size_t KEPT = 2;
} // namespace fit_vessel

namespace fit_lid {
/// [radius] deepest lid: deeper, the inside of the wall is seen as well; geometry
inline constexpr double DEEPEST = 0.25;
/// [radius] on the lid, clear of the rim; chosen
inline constexpr double WITHIN = 0.85;
/// [1] of the points, that are a lid: fewer may be a mug's inside; chosen
inline constexpr double LEAST_SHARE = 0.05;
/// [1] largest e1 of a rim, which is an edge; a box's
inline constexpr double EDGE = 0.2;
/// [rounds] of lid and body in turn; budget
inline constexpr int ROUNDS = 3;
/// [steps] of a fit; budget
inline constexpr int ITERATIONS = 12;
} // namespace fit_lid

} // namespace pcl_sq::detail::tuning

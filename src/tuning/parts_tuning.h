// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file What view_tuning.h says of the fits, for cuts, handles, parts and the verdict.
 */

#include "tuning/view_tuning.h"

#include <cstddef>

namespace pcl_sq::detail::tuning {

// Of parts with a view and without one alike.
namespace part {
/// [points] of a part; twice a superquadric's parameters
inline constexpr std::size_t MIN_POINTS = 24;
/// [-2 ln] of a quick fit over what the full one is to beat, from which on that is not
/// worth it; budget
inline constexpr double QUICK_SLACK = 60.0;
} // namespace part

namespace fit_handle {
/// [1] a handle than the box of its points: one side is hidden; geometry
inline constexpr double LARGER = 1.25;
/// [1] of a handle's points, at either end; strays
inline constexpr double STRAY = 0.05;
/// [-2 ln] odds of 400 to 1 that a handle is a bent rod and no disc: fingers go
/// through; odds
inline constexpr double ROD = 12.0;
} // namespace fit_handle

namespace fit_piece {
/// [starts] of a quick fit; budget
inline constexpr int QUICK_STARTS = 4;
/// [1] largest exponent of a part that a cut ends: a pinched one follows errors, and
/// its hidden side is too flat; composite things are made of cans, boxes, balls
inline constexpr double PART_EPSILON = 1.0;
/// [rounds] of holding the model off the free pixels; budget
inline constexpr int FREE_ROUNDS = 3;
/// [-2 ln] cost of covered free pixels that is worth another round; odds of 20 to 1
inline constexpr double WORTH_A_ROUND = 6.0;
} // namespace fit_piece

namespace free_space {
/// [size] how far parts stick out where the object is hollow; what is no superquadric
/// is not followed closer
inline constexpr double FREE_SIGMA = 0.03;
/// [px] of a piece that are looked at; budget
inline constexpr std::size_t INSIDE = 500;
/// [px] inside the outline, which may be either's; a sensor's rim
inline constexpr int MARGIN = 2;
/// [planes] that tell a body's outline; budget
inline constexpr int OUTLINE_PLANES = 24;
} // namespace free_space

namespace local_noise {
/// [points] at which noise is measured; it is known to a tenth
inline constexpr std::ptrdiff_t SAMPLES = 100;
/// [points] among which neighbours are sought; budget
inline constexpr std::ptrdiff_t MAX_POINTS = 3000;
/// [points] through which a plane goes, at least; known to a seventh
inline constexpr std::size_t FEWEST = 24;
/// [points] the same, at most; they bend beyond
inline constexpr std::size_t MOST = 96;
/// [points] of one error for which the fewest suffice; chosen
inline constexpr double SHARING = 5.0;
} // namespace local_noise

namespace piece {
/// [px] of an outline that are looked at; budget
inline constexpr std::size_t PIXEL_SAMPLE = 4000;
/// [size] how well a cut says where a part ends: parts overlap; chosen
inline constexpr double END_SIGMA = 0.25;
} // namespace piece

namespace piece_outline {
/// [size] from a cut where the outline may be the joint's or the other part's:
/// shoulders are round; chosen
inline constexpr double JOINT = 0.15;
} // namespace piece_outline

namespace propose_cuts {
/// [bins] at either end in which no cut makes sense; a twentieth
inline constexpr int MARGIN = 2;
/// [bins] on each side whose mean widths are compared; a twentieth
inline constexpr int WINDOW = 2;
/// [cuts] best jumps of one profile; budget
inline constexpr int PER_AXIS = 3;
/// [width] over the largest one; outlines err by so much
inline constexpr double SMALLEST_JUMP = 0.05;
/// [1] over the largest number of pixels; chosen
inline constexpr double SMALLEST_GAP = 0.25;
} // namespace propose_cuts

namespace stand_off {
/// [points] of a handle's other arm; a third of those
inline constexpr std::size_t MIN_CLUSTER = 8;
/// [1] cosine of 60 degrees around the axis; a handle is on one side
inline constexpr double SAME_SIDE = 0.5;
/// [radius] how far a handle sticks out, at least: fingers go through; hands
inline constexpr double STICKS_OUT = 0.2;
/// [1] how wide it is along the wall at most, over the same; hands
inline constexpr double NARROW = 1.0;
/// [size] distance of neighbours; chosen
inline constexpr double LINKED = 0.12;
/// [planes] of the body's outline; budget
inline constexpr int PLANES = 48;
/// [px] beside the body's outline: mixed pixels; sensors' rims
inline constexpr double EDGE = 2.0;
/// [px] beside the body's outline, where a handle may still begin; twice a sensor's rim
inline constexpr double JOINT = 6.0;
/// [points] that are looked at; budget
inline constexpr std::size_t MOST = 1000;
} // namespace stand_off

namespace fit_object {
/// [-2 ln] of the score, for one more part; odds of 150 to 1
inline constexpr double MIN_GAIN = 10.0;
/// [1] the same over the observations: the model's own error; chosen
inline constexpr double SMALL_GAIN = 0.02;
/// [1] of a vessel's points off it that are no handle: more are another part, a
/// bottle's neck; chosen
inline constexpr double MOST_UNEXPLAINED = 0.05;
/// [size] that a vessel's foot stands off its wall, over the sigmas that points off a
/// body are away; household things
inline constexpr double FOOT = 0.0125;
/// [1] of a vessel's points that may be its handle's; household things
inline constexpr double MOST_OF_HANDLE = 0.15;
/// [1] of a vessel's surface that has points: between a table's legs are none; chosen
inline constexpr double MOSTLY = 0.8;
/// [size] behind the object's back, that parts reach; chosen
inline constexpr double BACK_SLACK = 0.2;
/// [size] of the object's back; chosen
inline constexpr double BACK_SIGMA = 0.05;
/// [size] distance of things' surfaces to the best superquadric; things are no
/// superquadrics
inline constexpr double MODEL_ERROR = 0.005;
/// [size] detail of a whole cloud that is worth no part unless it is asked for: twice
/// MODEL_ERROR, or the parts of real things follow their dents, each cloud's others
inline constexpr double COARSE_ERROR = 0.01;
/// [1] of the score over the observations that another part is worth there, where all
/// of sigma is the model's error: a tenth of the points one sigma off; chosen
inline constexpr double COARSE_GAIN = 0.1;
/// [depth] what neighbours share and their scatter does not show: locking to whole
/// pixels, smoothing over the window; stereo and depth cameras
inline constexpr double SENSOR_ERROR = 7e-4;
/// [parts] looked for in one view where the options leave it open; budget
inline constexpr int MOST_IN_VIEW = 6;
/// [parts] the same in a whole cloud; budget
inline constexpr int MOST_ALL_ROUND = 16;
/// [px] by which measurements lie beside their pixels: a matching window's nearer side,
/// lateral noise; sensors
inline constexpr double SIDEWAYS = 0.5;
} // namespace fit_object

namespace outline_gaps {
/// [size] by which parts may miss the outline; what is no superquadric is not followed
/// closer
inline constexpr double TOLERANCE = 0.03;
/// [px] of the grid that is looked at; budget
inline constexpr int STEP = 2;
/// [px] beside the outline, which may be either's; a sensor's rim
inline constexpr int MARGIN = 2;
/// [width] of the first cut into a gap, over the gap's; chosen
inline constexpr double INSET = 0.2;
} // namespace outline_gaps

namespace stalk {
/// [-2 ln] odds of 10 to 1 against one: one place is looked at, the likeliest, not many
/// cuts; odds
inline constexpr double ODDS = 4.6;
/// [parameters] of a rod: two ends in the image, depth, slope, radius; geometry
inline constexpr int PARAMETERS = 7;
/// [points] that tell how far away it is by their median
inline constexpr std::size_t FEWEST = 8;
/// [1] length over width of what is a stump, whose longer axis says nothing; chosen
inline constexpr double STUMP = 1.5;
/// [1] tangent of the angle by which it leaves the body askew, a deviation; household
/// things
inline constexpr double ASKEW = 0.5;
/// [1] largest tangent of its slope to the image: 60 degrees; steeper it hides itself
inline constexpr double STEEPEST = 1.7;
/// [1] exponent of its rounded ends; that of the paper's boxes
inline constexpr double ROUNDED = 0.2;
} // namespace stalk

namespace split_view {
/// [1] cost per observation of a part that needs no cut; chosen; the noise's share is 1
inline constexpr double GOOD_FIT = 1.6;
/// [cuts] best ones, that are fitted in full; budget
inline constexpr std::size_t TRIED = 4;
/// [1] the same over the best cut's; budget
inline constexpr double QUICK_FACTOR = 1.5;
} // namespace split_view

namespace union_score {
/// [1] spacings to the nearest of points that are spread evenly; exp(-pi 2^2): 3e-6
inline constexpr double FARTHEST = 2.0;
/// [sigma] between surfaces that are one; chosen
inline constexpr double SIDE_BY_SIDE = 2.0;
/// [size] by which a body may leave the points' box before it is fitted again within
/// it; chosen
inline constexpr double SLACK = 0.02;
/// [size] by which it may then still leave it and be a part: beyond the points is
/// nothing; chosen
inline constexpr double BEYOND = 0.05;
/// [-2 ln] of a point, that a body beyond costs at least: as an outlier
inline constexpr double OUTSIDE = shared::MAX_COST;
/// [size] of the box's sides; chosen
inline constexpr double BOX_SIGMA = 0.005;
} // namespace union_score

namespace verdict {
/// [px] that are looked at; a share is known to a hundredth
inline constexpr double SAMPLE = 2000.0;
/// [size] how far things are off the best superquadrics, over half their size; a ball
/// fits a cube to .08 of its side
inline constexpr double MODEL_ERROR = 0.1;
/// [size] median distance to a model that is none; .05 for the ball that fits a cube
/// best
inline constexpr double MOST_OFF = 0.06;
/// [sigma] farther points are not the surface's; Gauss: 3e-3
inline constexpr double SIGMAS = 3.0;
/// [1] of the object's, that a model covers; odds: four to one
inline constexpr double LEAST_PIXELS = 0.8;
/// [1] confidence below which a model is none; as likely wrong as right
inline constexpr double EVEN = 0.5;
} // namespace verdict

namespace whole_search {
/// [cuts] of a part that are remembered; budget
inline constexpr std::size_t KEPT = 3;
/// [cuts] of a part that are scored, of those that quick fits describe best; budget
inline constexpr std::size_t SCREENED = 8;
/// [1] of a part's points that come or go before its cuts are looked for again; the
/// margin in which none is
inline constexpr double FEW = 0.05;
/// [cuts, joins] best of all parts, that are fitted in full; budget
inline constexpr std::size_t TRIED = 3;
/// [rounds] of assigning points and fitting again; budget
inline constexpr int ROUNDS = 8;
/// [sweeps] over all numbers of parts, to more and back to fewer; budget
inline constexpr int SWEEPS = 2;
/// [parts] beyond the best number, that are tried: one cut of a handle with two corners
/// helps little; budget
inline constexpr std::size_t PATIENCE = 3;
/// [price] of a part, by which fewer parts may be worse and yet lead to better ones;
/// budget
inline constexpr double FAR = 3.0;
/// [1] that another part brings along; an ellipsoid of revolution's
inline constexpr double FEWEST_PARAMETERS = 6.0;
/// [sigma] that a point lies off a body it is not of; Gauss: 6e-5
inline constexpr double OFF = 4.0;
} // namespace whole_search

} // namespace pcl_sq::detail::tuning

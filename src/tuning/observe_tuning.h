// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file What view_tuning.h says of the fits, for what is observed. */

#include <cstddef>

namespace pcl_sq::detail::tuning {

namespace observe_bare {
/// [points] fewer are no surface; a superquadric has 11 parameters
inline constexpr int MIN_POINTS = 12;
/// [1] each how manieth neighbour tells the spacing; the ring around a point of a
/// surface
inline constexpr std::size_t NEIGHBOUR = 6;
/// [1] median distances to that neighbour from which on a point is a stray; chosen
inline constexpr double LONELY = 2.5;
/// [points] looked at and fitted; budget
inline constexpr std::size_t MAX_POINTS = 3000;
} // namespace observe_bare

namespace observe_foot {
/// [1/n] share of the object's pixels that are its foot; budget
inline constexpr std::size_t LOWEST = 20;
/// [steps] from a low point down to the table; budget
inline constexpr int STEPS = 8;
/// [px] looked at beneath a low point; rims of depth cameras are 2 to 4
inline constexpr int BENEATH = 8;
/// [1] of the low points, below which the table is seen: it stands there; more than
/// half
inline constexpr double SEEN = 0.5;
} // namespace observe_foot

namespace observe_gap {
/// [px] a gap has: fewer are errors of the outline; outlines err by 1 to 2 pixels
inline constexpr int SMALLEST = 24;
/// [1] the same, over the object's pixels; chosen
inline constexpr double SMALLEST_SHARE = 0.003;
/// [1] of a gap's known depths that lie behind: it is a hole; chosen
inline constexpr double SEEN_THROUGH = 0.3;
} // namespace observe_gap

namespace observe_image {
/// [px] left out beside a mask's outline: mixed pixels; sensors: 1
inline constexpr int RIM_OF_MASK = 1;
/// [px] the same for the rim that stereo matching fattens; half of a 7 px window
inline constexpr int RIM_OF_DEPTH = 3;
/// [px] by which an outline from depth lies outside; half of RIM_OF_DEPTH
inline constexpr double FATTENING = 1.5;
/// [px] beside the outline, which may be either's; the rims' sum, rounded
inline constexpr int FREE_MARGIN = 2;
} // namespace observe_image

namespace observe_object {
/// [size] how well the edge of an occluder, or of the image, says where a thing ends,
/// all its lines together; most of it is seen, or nobody would have pointed at it
inline constexpr double HIDDEN_SIGMA = 0.05;
/// [px] from a line that touches the outline; SilhouetteLine's own
inline constexpr double TOUCHES = 1.5;
/// [points] dropped to the table; budget
inline constexpr std::ptrdiff_t FEET = 200;
/// [1] of the distance: nearer viewpoints are estimates of the same; chosen
inline constexpr double SAME = 0.1;
} // namespace observe_object

namespace observe_points {
/// [points] fitted; budget; neighbours share their errors anyway
inline constexpr std::size_t MAX_POINTS = 1500;
/// [px] around one with whose depths it is compared; a sensor's rim
inline constexpr int REACH = 3;
/// [depths] that say nothing; a tenth of the window
inline constexpr std::size_t FEW = 5;
} // namespace observe_points

namespace observe_surroundings {
/// [px] searched beyond the outline; two sensors' rims
inline constexpr int OCCLUDER_REACH = 6;
/// [depths] that say nothing, of the object's; a few hundredths of the window
inline constexpr std::size_t FEW_OWN = 5;
/// [depths] that say nothing, of others'; the same
inline constexpr std::size_t FEW_OTHERS = 8;
/// [px] between an outline and another thing's: they touch in the image; a rim
inline constexpr int BESIDE = 2;
/// [px] about so many are looked at around the object; budget
inline constexpr int FREE_SPACE = 500;
} // namespace observe_surroundings

namespace observe_table {
/// [planes] largest ones among which the table is; budget
inline constexpr int PLANES = 6;
/// [px] left out beside the outline, at most; observe_image.RIM_OF_DEPTH
inline constexpr double RIM = 3.0;
/// [1] least uprightness of a table's normal in the image: a wall before a level camera
/// has none; chosen
inline constexpr double UPRIGHT = 0.25;
/// [1] of the normal along the optical axis: the camera looks straight down; 25 degrees
inline constexpr double FROM_ABOVE = 0.9;
/// [points] of a side of the foot, that tell; a share is known to a tenth
inline constexpr std::size_t FEWEST = 20;
/// [depth] three sigma of unknown sensors; depth cameras, stereo at 1 m
inline constexpr double NOISE = 0.008;
/// [radius] height of a fiftieth of a disc's area at its lower edge; geometry
inline constexpr double FIFTIETH = 0.1;
/// [size] how far beyond the foot a table goes on, at least; chosen
inline constexpr double BESIDE = 0.5;
/// [points] in a direction from the foot, that tell; most of them
inline constexpr std::size_t FEWEST_OF_SECTOR = 3;
/// [1] of the directions that tell, in which the table goes on: a thing may stand at
/// its edge; geometry: a straight edge takes a third
inline constexpr double CARRIED = 2.0 / 3.0;
/// [rounds] of settling on the plane of most of its points; budget
inline constexpr int ROUNDS = 5;
/// [sigma] from which on a point is not that plane's; Gauss: 1e-2
inline constexpr double SIGMAS = 2.5;
} // namespace observe_table

namespace point_spread {
/// [points] at which the spread is looked at; budget
inline constexpr std::ptrdiff_t PATCHES = 400;
/// [points] fewer tell nothing of a camera; their scatter is known to a tenth
inline constexpr std::ptrdiff_t FEWEST = 100;
/// [points] whose reach is the density's measure; known to a quarter
inline constexpr std::size_t NEIGHBOURS = 12;
/// [points] that give the normal; chosen
inline constexpr std::size_t PLANE = 24;
/// [points] that tell on which side it bulges; four times PLANE: twice its reach
inline constexpr std::size_t AROUND_IT = 96;
/// [1] least cosine that counts: there noise is thicker; chosen
inline constexpr double GRAZING = 0.1;
/// [size] of a camera that is looked for, in half diagonals; beyond, rays are parallel
inline constexpr double FAR = 6.0;
/// [1] of a camera, that are tried; 0.14 rad apart
inline constexpr int DIRECTIONS = 200;
/// [1] the same about the best one; budget
inline constexpr int AROUND = 24;
/// [rad] half a step between those; of DIRECTIONS
inline constexpr double SPACING = 0.14;
/// [1] how much more uneven one place's image is than another's; a scatter of PATCHES
/// is known to 5 %, and this is four times the deviation of two
inline constexpr double MORE = 1.25;
/// [1] cosine between a patch's normal and the way from the middle to it, below which
/// nobody knows which side is outside; chosen
inline constexpr double ASIDE = 0.2;
/// [1] of the share that faces the camera; a tenth of a body's sides turned about
inline constexpr double TOGETHER = 0.2;
} // namespace point_spread

namespace sheets {
/// [points] in which two sheets of a wall are told apart; chosen
inline constexpr std::size_t NEIGHBOURS = 32;
/// [points] the first plane goes through; a plane has 3 parameters
inline constexpr std::size_t NEAREST = 8;
/// [rounds] of fitting a plane to the nearer half of the points; budget
inline constexpr int ROUNDS = 4;
/// [sigma] of another sheet from the own one; Gauss: 6e-5
inline constexpr double BEYOND = 4.0;
/// [points] of another sheet; a plane has 3 parameters
inline constexpr std::size_t FEWEST = 5;
/// [1] sine of two directions that span a plane; chosen
inline constexpr double SLIVER = 0.3;
/// [1] mean deviation of another sheet, over its distance; chosen
inline constexpr double EVEN = 0.25;
/// [radius] of its middle across the normal; chosen
inline constexpr double BESIDE = 0.5;
/// [1] of the surface that is smooth, at least: legs and edges bend within a
/// neighbourhood; chosen
inline constexpr double SMOOTH = 0.2;
/// [1] that quantile of scatters of NEIGHBOURS points of one noise, over their middle;
/// chi-squared
inline constexpr double OF_SMOOTH = 0.89;
/// [points] of which the scatter is taken; budget: noise is known to 7 %
inline constexpr std::ptrdiff_t LOOKED_AT = 200;
/// [points] of a whole cloud, in which a point's neighbours reach a thin wall's other
/// side; budget
inline constexpr std::ptrdiff_t WALL_POINTS = 5000;
/// [1] of doubled sheets from which on points are those of two sides: in one view they
/// are chance; chosen
inline constexpr double TWO_SIDES = 0.15;
} // namespace sheets

} // namespace pcl_sq::detail::tuning

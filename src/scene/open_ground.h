// SPDX-License-Identifier: BSD-3-Clause
// Private. Where the ground between things is surely not theirs.
#pragma once

#include "pcl_sq/cell_mask.h"

namespace pcl_sq::detail {

/** \brief The largest set of pixels that hang together around things: what they
 * enclose, such as the floor of a pan, is left out, and so is what is near them.
 * \param[in] above pixels of things */
[[nodiscard]] CellMask openGround(const CellMask& above);

/** \brief Pixels without depth about which there is nothing but some thing's: what a
 * sensor misses within it is no border of it. \param[in] pixels of things
 * \param[in] most that hang together: where more are missing two things may end */
[[nodiscard]] CellMask
gapsWithin(const CellMask& pixels, const CellMask& missing, std::size_t most);

} // namespace pcl_sq::detail

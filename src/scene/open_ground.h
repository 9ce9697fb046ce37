// SPDX-License-Identifier: BSD-3-Clause
// Private. Where the ground between things is surely not theirs.
#pragma once

#include "pcl_sq/cell_mask.h"

namespace pcl_sq::detail {

/** \brief The largest set of pixels that hang together around things: what they
 * enclose, such as the floor of a pan, is left out, and so is what is near them.
 * \param[in] above pixels of things */
[[nodiscard]] CellMask openGround(const CellMask& above);

} // namespace pcl_sq::detail

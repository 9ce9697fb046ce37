// SPDX-License-Identifier: BSD-3-Clause
// Private. Other descriptions of one body: where a search in one stalls, another leads
// on.
#pragma once

#include "pcl_sq/superquadric.h"

namespace pcl_sq::detail {

/** \brief Axis k becomes the body's (k + shift) mod 3; the exponents stay. */
Superquadric axesShifted(const Superquadric& body, int shift);

/** \brief Turned by 45 degrees about the own z axis. */
Superquadric eighthTurn(Superquadric body);

/** \brief About the same body with its axes in cyclic order so that axis \a k is z, the
 * exponents exchanged where z is another one: exact where both are equal. */
Superquadric withAxis(const Superquadric& body, int k);

/** \brief Cross-section turned by 45 degrees with e2 -> 2 - e2 (Liu et al. 2022): exact
 * between a square and a square on its corner, whose sizes differ by sqrt(2). */
Superquadric dual(const Superquadric& body);

} // namespace pcl_sq::detail

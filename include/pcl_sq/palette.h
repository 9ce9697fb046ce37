// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/exports.h"

#include <cstddef>
#include <cstdint>

namespace pcl_sq {

/** \brief An sRGB colour. */
struct Color {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Color& o) const { return r == o.r && g == o.g && b == o.b; }
  bool operator!=(const Color& o) const { return !(*this == o); }
};

/** \brief Colour of the part of that index in pictures and mesh files.
 *
 * The first seven follow Okabe & Ito 2008, "Color universal design", chosen to be told
 * apart with any colour vision; later ones repeat them darker, then lighter. */
PCL_SQ_EXPORTS Color partColor(std::size_t part);

/** \brief Blend of two colours: \a a at 0, \a b at 1. */
PCL_SQ_EXPORTS Color mix(Color a, Color b, double share);

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/palette.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_sq {

Color partColor(std::size_t part) {
  static constexpr std::array<Color, 7> okabe_ito = {{{0, 114, 178},
                                                      {213, 94, 0},
                                                      {0, 158, 115},
                                                      {204, 121, 167},
                                                      {230, 159, 0},
                                                      {86, 180, 233},
                                                      {240, 228, 66}}};
  const Color hue = okabe_ito[part % okabe_ito.size()];
  switch (part / okabe_ito.size() % 3) {
  case 0:
    return hue;
  case 1:
    return mix(hue, {0, 0, 0}, 0.45);
  default:
    return mix(hue, {255, 255, 255}, 0.5);
  }
}

Color mix(Color a, Color b, double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  const auto channel = [t](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround((1.0 - t) * from + t * to));
  };
  return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)};
}

} // namespace pcl_sq

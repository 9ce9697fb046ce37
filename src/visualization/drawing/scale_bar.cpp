// SPDX-License-Identifier: BSD-3-Clause
#include "visualization/drawing/scale_bar.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace pcl_sq {
namespace {

struct Unit {
  double meters;
  const char* name;
};

/// Names are UTF-8; the last one also serves everything smaller.
constexpr std::array<Unit, 5> UNITS = {
    {{1e3, "km"}, {1.0, "m"}, {1e-2, "cm"}, {1e-3, "mm"}, {1e-6, "\xC2\xB5m"}}};

} // namespace

ScaleBar roundScaleBar(double longest) {
  const double power = std::pow(10.0, std::floor(std::log10(longest)));
  ScaleBar bar;
  bar.length = power;
  for (const double factor : {2.0, 5.0, 10.0})
    if (factor * power <= longest * (1.0 + 1e-9))
      bar.length = factor * power;

  Unit unit = UNITS.back();
  for (const Unit& candidate : UNITS)
    if (bar.length >= candidate.meters * (1.0 - 1e-9)) {
      unit = candidate;
      break;
    }
  char text[32];
  std::snprintf(text, sizeof text, "%.6g %s", bar.length / unit.meters, unit.name);
  bar.label = text;
  return bar;
}

} // namespace pcl_sq

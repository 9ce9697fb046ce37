// SPDX-License-Identifier: BSD-3-Clause
#include "taper_step.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

constexpr double TRUST = 0.3; ///< largest step of a taper
constexpr double MOST = TaperedSuperquadric::MAX_TAPER;

} // namespace

TaperedSuperquadric moved(const TaperedSuperquadric& s,
                          const Vector13& step,
                          const LmOptions& o,
                          bool& limited) {
  Vector11 own = step.head<11>();
  limited = limitStep(own, s.shape);
  TaperedSuperquadric m;
  m.shape = moved(s.shape, own, o);
  m.kx = std::clamp(s.kx + std::clamp(step[11], -TRUST, TRUST), -MOST, MOST);
  m.ky = std::clamp(s.ky + std::clamp(step[12], -TRUST, TRUST), -MOST, MOST);
  limited = limited || step.tail<2>().cwiseAbs().maxCoeff() > TRUST;
  return m;
}

bool leadsOut(const TaperedSuperquadric& s,
              const Vector13& direction,
              const LmOptions& o) {
  return leadsOut(s.shape, Vector11(direction.head<11>()), o) ||
         (std::abs(s.kx) >= MOST && s.kx * direction[11] > 0.0) ||
         (std::abs(s.ky) >= MOST && s.ky * direction[12] > 0.0);
}

} // namespace pcl_sq::detail

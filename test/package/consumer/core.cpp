// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_sq/superquadric.h>

#include <cmath>
#include <cstdio>

// links and runs against the installed library: the ball's volume is 4/3 pi
int main() {
  const pcl_sq::Superquadric ball;
  std::printf("volume %.9f\n", ball.volume());
  return std::abs(ball.volume() - 4.0 / 3.0 * std::acos(-1.0)) < 1e-9 ? 0 : 1;
}

// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_sq/stereo/stereo_reprojector.h>
#include <pcl_sq/superquadric.h>
#include <pcl_sq/visualization/snapshot_renderer.h>

double volumeOfABall() {
  return pcl_sq::Superquadric().volume();
}

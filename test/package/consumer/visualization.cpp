// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_sq/exception.h>
#include <pcl_sq/visualization/snapshot_renderer.h>

#include <cstdio>

// links and runs against the installed library: a ball is in the middle of its picture,
// on a machine with or without a display, and the library's exceptions arrive here
int main() {
  pcl_sq::SnapshotOptions options;
  options.width = options.height = 64;
  pcl_sq::SnapshotRenderer renderer(options);
  try {
    renderer.render();
    return 1;
  } catch (const pcl_sq::Exception& empty) {
    std::printf("%s\n", empty.what());
  }
  pcl_sq::MultiSuperquadric ball;
  ball.parts.resize(1);
  renderer.addModel(ball);
  return renderer.render().at(32, 32) != options.background ? 0 : 1;
}

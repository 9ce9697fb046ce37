// SPDX-License-Identifier: BSD-3-Clause
// A picture and a mesh of a union of superquadrics, on any machine, with or without a
// display. Usage: example_06_picture picture.png mesh.ply
#include <pcl_sq/exception.h>
#include <pcl_sq/visualization/mesh_writer.h>
#include <pcl_sq/visualization/snapshot_renderer.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "Usage: " << argv[0] << " picture.png mesh.ply\n";
    return 2;
  }
  pcl_sq::MultiSuperquadric hammer;
  pcl_sq::Superquadric handle, head;
  handle.semi_axes = Eigen::Vector3d(0.012, 0.016, 0.15);
  handle.epsilon1 = 0.3;
  head.center.z() = 0.15;
  head.semi_axes = Eigen::Vector3d(0.055, 0.015, 0.015);
  head.epsilon1 = head.epsilon2 = 0.2;
  hammer.parts = {handle, head};

  try {
    pcl_sq::SnapshotRenderer renderer;
    renderer.addModel(hammer);
    renderer.save(argv[1]);
    pcl_sq::writeMesh(argv[2], hammer.meshUnion());
  } catch (const pcl_sq::Exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}

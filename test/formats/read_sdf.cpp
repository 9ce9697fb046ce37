// SPDX-License-Identifier: BSD-3-Clause
// Reads an SDF file as Gazebo does, and prints what it holds: read_sdf FILE.
#include <sdf/sdf.hh>

#include <iostream>

int main(int argc, char** argv) {
  sdf::Root root;
  const sdf::Errors errors = argc == 2 ? root.Load(argv[1]) : sdf::Errors{};
  for (const sdf::Error& error : errors)
    std::cerr << error.Message() << '\n';
  const sdf::Model* model = root.Model();
  if (!errors.empty() || !model)
    return 1;
  std::cout << "model " << model->Name() << " links " << model->LinkCount() << '\n';
  const auto pose = model->RawPose().Pos();
  std::cout << "at " << pose.X() << ' ' << pose.Y() << ' ' << pose.Z() << '\n';
  for (std::uint64_t i = 0; i < model->LinkCount(); ++i) {
    const sdf::Link& link = *model->LinkByIndex(i);
    const auto& inertia = link.Inertial().MassMatrix();
    std::cout << "mass " << inertia.Mass() << " valid "
              << link.Inertial().MassMatrix().IsValid() << " visuals "
              << link.VisualCount() << " collisions " << link.CollisionCount() << '\n';
    for (std::uint64_t k = 0; k < link.CollisionCount(); ++k) {
      const sdf::Geometry& geometry = *link.CollisionByIndex(k)->Geom();
      if (const sdf::Mesh* mesh = geometry.MeshShape())
        std::cout << "mesh " << mesh->Uri() << '\n';
      else if (geometry.BoxShape())
        std::cout << "box\n";
      else if (geometry.CylinderShape())
        std::cout << "cylinder\n";
      else if (geometry.SphereShape())
        std::cout << "sphere\n";
      else
        std::cout << "unknown\n";
    }
  }
  return 0;
}

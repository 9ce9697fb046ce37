// SPDX-License-Identifier: BSD-3-Clause
#include "export/robot_object.h"

#include "export/xml_text.h"
#include "util/option_check.h"

namespace pcl_sq {

bool RobotExportOptions::isValid(std::string* why) const {
  const auto fail = [why](const std::string& sentence) {
    if (why)
      *why = sentence;
    return false;
  };
  GraspitOptions names; // the same rules
  names.name = name;
  names.density = density;
  if (!names.isValid(why))
    return false;
  if (!(primitive_tolerance >= 0.0 && primitive_tolerance <= 1.0))
    return fail("primitive_tolerance is out of [0, 1]");
  return true;
}

std::vector<TextFile> robotFiles(const std::string& ending,
                                 const ModelFile& file,
                                 const RobotExportOptions& options) {
  if (ending == ".urdf")
    return urdfFiles(file, options);
  if (ending == ".sdf")
    return sdfFiles(file, options);
  if (ending == ".scene")
    return moveitFiles(file, options);
  if (ending == ".glb")
    return glbFiles(file, options);
  return {};
}

std::vector<TextFile> robotFiles(const std::string& ending,
                                 const SceneFile& scene,
                                 const RobotExportOptions& options) {
  if (ending == ".scene")
    return moveitFiles(scene, options);
  if (ending == ".glb")
    return glbFiles(scene, options);
  return {};
}

namespace detail {

std::string meshName(const RobotExportOptions& options, std::size_t number) {
  return options.name +
         (number == 0 ? "_visual" : "_collision" + std::to_string(number)) + ".stl";
}

bool robotObject(const ModelFile& file,
                 const RobotExportOptions& options,
                 RobotObject& object) {
  if (file.model.empty() || !options.isValid())
    return false;
  const MassProperties mass = massProperties(file.model);
  object.frame = file.frame.empty() ? "world" : file.frame;
  object.origin = mass.center;
  object.mass = options.density * mass.volume;
  object.inertia = options.density * mass.inertia;
  for (const Superquadric& part : file.model.parts)
    for (CollisionShape& shape : collisionShapes(part, options.primitive_tolerance))
      object.shapes.push_back(std::move(shape));
  constexpr int DIVISIONS = 12; // some 1,700 triangles a part are light to draw
  MultiSuperquadric centred = file.model;
  for (Superquadric& part : centred.parts)
    part.center -= object.origin;
  object.meshes.push_back(
      {meshName(options, 0), stlBytes(centred.meshParts(DIVISIONS))});
  for (std::size_t i = 0; i < object.shapes.size(); ++i)
    if (object.shapes[i].kind == CollisionShape::MESH)
      object.meshes.push_back(
          {meshName(options, i + 1), stlBytes(object.shapes[i].mesh)});
  return true;
}

} // namespace detail

} // namespace pcl_sq

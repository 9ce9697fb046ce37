// SPDX-License-Identifier: BSD-3-Clause
// URDF and SDF: the same object in two dialects of XML.
#include "export/robot_object.h"
#include "export/xml_text.h"

namespace pcl_sq {

namespace {

using detail::CollisionShape;
using detail::escaped;
using detail::numbersText;
using detail::RobotObject;

std::string urdfOrigin(const Eigen::Vector3d& xyz, const Eigen::Matrix3d& rotation) {
  return "<origin xyz=\"" + numbersText(xyz) + "\" rpy=\"" +
         numbersText(detail::rollPitchYaw(rotation)) + "\"/>";
}

std::string urdfShape(const CollisionShape& shape, const std::string& mesh) {
  const Eigen::Vector3d& h = shape.half_sizes;
  if (shape.kind == CollisionShape::BOX)
    return "<box size=\"" + numbersText(2.0 * h) + "\"/>";
  if (shape.kind == CollisionShape::CYLINDER)
    return "<cylinder radius=\"" + numbersText({h.x()}) + "\" length=\"" +
           numbersText({2.0 * h.z()}) + "\"/>";
  if (shape.kind == CollisionShape::SPHERE)
    return "<sphere radius=\"" + numbersText({h.x()}) + "\"/>";
  return "<mesh filename=\"" + escaped(mesh) + "\"/>";
}

std::string sdfShape(const CollisionShape& shape, const std::string& mesh) {
  const Eigen::Vector3d& h = shape.half_sizes;
  if (shape.kind == CollisionShape::BOX)
    return "<box><size>" + numbersText(2.0 * h) + "</size></box>";
  if (shape.kind == CollisionShape::CYLINDER)
    return "<cylinder><radius>" + numbersText({h.x()}) + "</radius><length>" +
           numbersText({2.0 * h.z()}) + "</length></cylinder>";
  if (shape.kind == CollisionShape::SPHERE)
    return "<sphere><radius>" + numbersText({h.x()}) + "</radius></sphere>";
  return "<mesh><uri>" + escaped(mesh) + "</uri></mesh>";
}

std::vector<TextFile> withMeshes(const std::string& name,
                                 const std::string& text,
                                 const RobotObject& object) {
  std::vector<TextFile> files = {{name, text}};
  files.insert(files.end(), object.meshes.begin(), object.meshes.end());
  return files;
}

} // namespace

std::vector<TextFile> urdfFiles(const ModelFile& file,
                                const RobotExportOptions& options) {
  RobotObject object;
  if (!detail::robotObject(file, options, object))
    return {};
  const Eigen::Matrix3d& i = object.inertia;
  const auto number = [](double n) { return numbersText({n}); };
  // a link and a joint may not have the same name as the root
  const std::string root =
      object.frame == options.name ? object.frame + "_frame" : object.frame;
  std::string text =
      "<?xml version=\"1.0\"?>\n<robot name=\"" + options.name +
      "\">\n  <link name=\"" + escaped(root) + "\"/>\n  <joint name=\"" + options.name +
      "_pose\" type=\"fixed\">\n    <parent link=\"" + escaped(root) +
      "\"/>\n    <child link=\"" + options.name + "\"/>\n    " +
      urdfOrigin(object.origin, Eigen::Matrix3d::Identity()) +
      "\n  </joint>\n  <link name=\"" + options.name +
      "\">\n    <inertial>\n      <mass value=\"" + number(object.mass) +
      "\"/>\n      <inertia ixx=\"" + number(i(0, 0)) + "\" ixy=\"" + number(i(0, 1)) +
      "\" ixz=\"" + number(i(0, 2)) + "\" iyy=\"" + number(i(1, 1)) + "\" iyz=\"" +
      number(i(1, 2)) + "\" izz=\"" + number(i(2, 2)) + "\"/>\n    </inertial>\n";
  text += "    <visual>\n      <geometry><mesh filename=\"" +
          escaped(options.mesh_prefix + detail::meshName(options, 0)) +
          "\"/></geometry>\n    </visual>\n";
  for (std::size_t k = 0; k < object.shapes.size(); ++k) {
    const CollisionShape& shape = object.shapes[k];
    text += "    <collision>\n      " +
            urdfOrigin(object.placeOf(shape), shape.rotation) + "\n      <geometry>" +
            urdfShape(shape, options.mesh_prefix + detail::meshName(options, k + 1)) +
            "</geometry>\n    </collision>\n";
  }
  text += "  </link>\n</robot>\n";
  return withMeshes(options.name + ".urdf", text, object);
}

std::vector<TextFile> sdfFiles(const ModelFile& file,
                               const RobotExportOptions& options) {
  RobotObject object;
  if (!detail::robotObject(file, options, object))
    return {};
  const Eigen::Matrix3d& i = object.inertia;
  const auto tag = [](const char* name, double n) {
    return std::string("<") + name + ">" + numbersText({n}) + "</" + name + ">";
  };
  std::string text =
      "<?xml version=\"1.0\"?>\n<sdf version=\"1.7\">\n  <model name=\"" +
      options.name + "\">\n    <pose>" + numbersText(object.origin) +
      " 0 0 0</pose>\n    <link name=\"" + options.name +
      "\">\n      <inertial>\n        " + tag("mass", object.mass) +
      "\n        <inertia>" + tag("ixx", i(0, 0)) + tag("ixy", i(0, 1)) +
      tag("ixz", i(0, 2)) + tag("iyy", i(1, 1)) + tag("iyz", i(1, 2)) +
      tag("izz", i(2, 2)) +
      "</inertia>\n      </inertial>\n      <visual name=\"surface\">\n        "
      "<geometry><mesh><uri>" +
      escaped(options.mesh_prefix + detail::meshName(options, 0)) +
      "</uri></mesh></geometry>\n      </visual>\n";
  for (std::size_t k = 0; k < object.shapes.size(); ++k) {
    const CollisionShape& shape = object.shapes[k];
    text += "      <collision name=\"shape" + std::to_string(k + 1) +
            "\">\n        <pose>" + numbersText(object.placeOf(shape)) + " " +
            numbersText(detail::rollPitchYaw(shape.rotation)) +
            "</pose>\n        <geometry>" +
            sdfShape(shape, options.mesh_prefix + detail::meshName(options, k + 1)) +
            "</geometry>\n      </collision>\n";
  }
  text += "    </link>\n  </model>\n</sdf>\n";
  return withMeshes(options.name + ".sdf", text, object);
}

} // namespace pcl_sq

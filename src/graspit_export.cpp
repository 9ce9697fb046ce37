// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/graspit_export.h"

#include "graspit_text.h"

#include <algorithm>

namespace pcl_sq {

namespace {

using detail::MILLIMETRES;
using detail::vectorText;

constexpr double GRAMS = 1000.0;         ///< in a kilogram
constexpr double TABLE_SIZE = 1.0;       ///< [m]
constexpr double TABLE_THICKNESS = 0.02; ///< [m]
constexpr double CAMERA_DISTANCE = 0.6;  ///< [m]
constexpr int PART_DIVISIONS = 16;       ///< of a part's mesh

/** \brief The model with \a origin as the origin of its frame. */
MultiSuperquadric about(const MultiSuperquadric& model, const Eigen::Vector3d& origin) {
  MultiSuperquadric moved = model;
  for (Superquadric& part : moved.parts)
    part.center -= origin;
  return moved;
}

std::string bodyXml(const GraspitOptions& options,
                    const MassProperties& mass,
                    const std::string& geometry) {
  // GraspIt! multiplies the inertia by the mass itself: it wants mm^2
  const Eigen::Matrix3d inertia =
      mass.inertia / mass.volume * (MILLIMETRES * MILLIMETRES);
  const Eigen::Vector3d rows[3] = {inertia.row(0).transpose(),
                                   inertia.row(1).transpose(),
                                   inertia.row(2).transpose()};
  return "<?xml version=\"1.0\" ?>\n<root>\n\t<material>" + options.material +
         "</material>\n\t<mass>" +
         detail::numberText(mass.volume * options.density * GRAMS) +
         "</mass>\n\t<cog>0 0 0</cog>\n\t<inertia_matrix>" + vectorText(rows[0]) + " " +
         vectorText(rows[1]) + " " + vectorText(rows[2]) +
         "</inertia_matrix>\n\t<geometryFile type=\"off\">" + geometry +
         "</geometryFile>\n</root>\n";
}

std::string elementXml(const std::string& kind,
                       const std::string& file,
                       const std::string& transform) {
  return "\t<" + kind + ">\n\t\t<filename>" + file +
         "</filename>\n\t\t<transform>\n\t\t\t<fullTransform>" + transform +
         "</fullTransform>\n\t\t</transform>\n\t</" + kind + ">\n";
}

/** \brief A frame whose z is the given direction. */
Eigen::Matrix3d frameAlong(const Eigen::Vector3d& z) {
  Eigen::Matrix3d frame;
  const Eigen::Vector3d x = z.unitOrthogonal();
  frame << x, z.cross(x), z;
  return frame;
}

std::string cameraXml(const Eigen::Vector3d& center, const Eigen::Vector3d& up) {
  // the camera looks along its -z; unlike a transform its quaternion ends with w
  const Eigen::Vector3d away = up.unitOrthogonal();
  Eigen::Matrix3d frame;
  frame << up.cross(away), up, away;
  const Eigen::Quaterniond q(frame);
  return "\t<camera>\n\t\t<position>" +
         vectorText(MILLIMETRES * (center + CAMERA_DISTANCE * away)) +
         "</position>\n\t\t<orientation>" + vectorText(q.vec()) + " " +
         detail::numberText(q.w()) + "</orientation>\n\t\t<focalDistance>" +
         detail::numberText(MILLIMETRES * CAMERA_DISTANCE) +
         "</focalDistance>\n\t</camera>\n";
}

std::string graspLines(const GraspitOptions& options) {
  std::string text;
  for (const Grasp& grasp : options.grasps) {
    const double palm =
        options.gripper.finger_length - 0.5 * options.gripper.pad_length;
    text += "[" + vectorText(MILLIMETRES * (grasp.position - palm * grasp.approach())) +
            "][" + vectorText(grasp.approach()) + "][" + vectorText(grasp.closing()) +
            "]" + (options.gripper.fingers == 3 ? "60" : "0") + "\n";
  }
  return text;
}

} // namespace

bool GraspitOptions::isValid(std::string* why) const {
  const auto fail = [why](const char* sentence) {
    if (why)
      *why = sentence;
    return false;
  };
  const auto plain = [](const std::string& word) {
    return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
             (c >= '0' && c <= '9') || c == '_' || c == '-';
    });
  };
  if (!plain(name) || !plain(material))
    return fail("name and material are words of letters, digits, _ and -");
  if (!(density >= 1.0 && density <= 30000.0))
    return fail("density is outside [1, 30000] kg/m^3");
  if (resolution < 8 || resolution > 512)
    return fail("resolution is outside [8, 512]");
  if (has_table &&
      !(std::abs(table_normal.norm() - 1.0) < 1e-3 && std::isfinite(table_offset)))
    return fail("the table's normal is not of unit length");
  return true;
}

std::string graspitTransform(const Eigen::Matrix3d& rotation,
                             const Eigen::Vector3d& translation) {
  Eigen::Quaterniond q(rotation);
  q.normalize();
  return "(" + detail::numberText(q.w()) + " " + vectorText(q.vec()) + ")[" +
         vectorText(MILLIMETRES * translation) + "]";
}

std::vector<TextFile> graspitFiles(const MultiSuperquadric& model,
                                   const GraspitOptions& options) {
  if (model.empty() || !options.isValid())
    return {};
  for (const Superquadric& part : model.parts)
    if (!part.isValid())
      return {};
  const std::string objects = "models/objects/", obstacles = "models/obstacles/";
  const MassProperties mass = massProperties(model);
  const MultiSuperquadric body = about(model, mass.center);
  const Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
  std::vector<TextFile> files;
  std::string world = "<?xml version=\"1.0\" ?>\n<world>\n";

  world += elementXml("graspableBody",
                      objects + options.name + ".xml",
                      graspitTransform(upright, mass.center));
  files.push_back(
      {objects + options.name + ".xml", bodyXml(options, mass, options.name + ".off")});
  files.push_back({objects + options.name + ".off",
                   detail::offText(body.meshUnion(options.resolution))});
  files.push_back(
      {objects + "primitives/" + options.name + ".iv", detail::primitivesText(body)});

  for (std::size_t k = 0; options.part_bodies && k < model.size(); ++k) {
    const Superquadric& part = model.parts[k];
    const std::string name = options.name + "_part" + std::to_string(k);
    MultiSuperquadric alone;
    alone.parts = {part};
    files.push_back({objects + name + ".xml",
                     bodyXml(options, massProperties(alone), name + ".off")});
    files.push_back(
        {objects + name + ".off",
         detail::offText(about(alone, part.center).meshParts(PART_DIVISIONS))});
  }

  if (options.has_table) {
    const std::string name = options.name + "_table";
    const Eigen::Vector3d& up = options.table_normal;
    OrientedBox plate; // its upper face in the body's x-y plane
    plate.half_sizes = 0.5 * Eigen::Vector3d(TABLE_SIZE, TABLE_SIZE, TABLE_THICKNESS);
    plate.center.z() = -plate.half_sizes.z();
    const Eigen::Vector3d below =
        mass.center - up * (up.dot(mass.center) + options.table_offset);
    world += elementXml(
        "obstacle", obstacles + name + ".xml", graspitTransform(frameAlong(up), below));
    files.push_back({obstacles + name + ".xml",
                     "<?xml version=\"1.0\" ?>\n<root>\n\t<material>wood</material>\n"
                     "\t<geometryFile type=\"off\">" +
                         name + ".off</geometryFile>\n</root>\n"});
    files.push_back({obstacles + name + ".off", detail::offText(meshBox(plate))});
  }

  world += cameraXml(mass.center,
                     options.has_table ? options.table_normal
                                       : Eigen::Vector3d(Eigen::Vector3d::UnitZ()));
  files.push_back({"worlds/" + options.name + ".xml", world + "</world>\n"});
  if (!options.grasps.empty())
    files.push_back({options.name + "_grasps.txt", graspLines(options)});
  return files;
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/graspit_export.h"

#include "io/graspit_text.h"
#include "mesh/union_mesh.h"

#include <algorithm>
#include <limits>

namespace pcl_sq {

namespace {

using detail::MILLIMETRES;
using detail::vectorText;

constexpr double GRAMS = 1000.0;         ///< in a kilogram
constexpr double TABLE_SIZE = 1.0;       ///< [m]
constexpr double TABLE_THICKNESS = 0.02; ///< [m]
constexpr double CAMERA_DISTANCE = 0.6;  ///< [m]
constexpr double TABLE_GAP = 3e-4;       ///< below the lowest vertex [m]
constexpr double HELD_UP = 0.1;   ///< of its longest side is more than a fit's error
constexpr double FINEST = 1e-3;   ///< tolerance over the longest side: no more
constexpr double COARSEST = 4e-4; ///< and no less than these

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
    const Eigen::Vector3d start =
        grasp.position - (palm + options.retreat) * grasp.approach();
    text += "[" + vectorText(MILLIMETRES * start) + "][" +
            vectorText(grasp.approach()) + "][" + vectorText(grasp.closing()) + "]" +
            (options.gripper.fingers == 3 ? "60" : "0") + "\n";
  }
  return text;
}

std::string worldXml(const std::string& elements) {
  return "<?xml version=\"1.0\" ?>\n<world>\n" + elements + "</world>\n";
}

TriangleMesh meshOf(const MultiSuperquadric& body, const GraspitOptions& options) {
  const double side = body.boundingBox().sizes().maxCoeff();
  return detail::remeshUnion(
      body, std::clamp(options.tolerance, COARSEST * side, FINEST * side));
}

double longestSide(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices)
    box.extend(v);
  return box.sizes().maxCoeff();
}

/** \brief Adds the files of a body that stays where it is; returns the world's element.
 */
std::string addObstacle(const std::string& name,
                        const TriangleMesh& mesh,
                        const std::string& transform,
                        std::vector<TextFile>& files) {
  const std::string folder = "models/obstacles/";
  files.push_back({folder + name + ".xml",
                   "<?xml version=\"1.0\" ?>\n<root>\n\t<material>wood</material>\n"
                   "\t<geometryFile type=\"off\">" +
                       name + ".off</geometryFile>\n</root>\n"});
  files.push_back({folder + name + ".off", detail::offText(mesh)});
  return elementXml("obstacle", folder + name + ".xml", transform);
}

/** \brief Adds the files of the table under a mesh about \a center; returns the world's
 * element. */
std::string addTable(const GraspitOptions& options,
                     const TriangleMesh& mesh,
                     const Eigen::Vector3d& center,
                     std::vector<TextFile>& files) {
  const Eigen::Vector3d& up = options.table_normal;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& v : mesh.vertices)
    lowest = std::min(lowest, up.dot(v));
  // a model that stands on its table only about touches it; one that is held up does
  // not
  double height = lowest - TABLE_GAP;
  const double seen = -options.table_offset - up.dot(center);
  if (lowest - seen > HELD_UP * longestSide(mesh))
    height = seen;
  OrientedBox plate; // its upper face in the body's x-y plane
  plate.half_sizes = 0.5 * Eigen::Vector3d(TABLE_SIZE, TABLE_SIZE, TABLE_THICKNESS);
  plate.center.z() = -plate.half_sizes.z();
  return addObstacle(options.name + "_table",
                     meshBox(plate),
                     graspitTransform(frameAlong(up), center + up * height),
                     files);
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
  if (!(tolerance >= 1e-6 && tolerance <= 0.1))
    return fail("tolerance is outside [1e-6, 0.1] m");
  if (!(retreat >= 0.0 && retreat <= 1.0))
    return fail("retreat is outside [0, 1] m");
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
  for (const MultiSuperquadric* bodies : {&model, &options.obstacles})
    for (const Superquadric& part : bodies->parts)
      if (!part.isValid())
        return {};
  const std::string objects = "models/objects/";
  const MassProperties mass = massProperties(model);
  const MultiSuperquadric body = about(model, mass.center);
  const TriangleMesh mesh = meshOf(body, options);
  const Eigen::Matrix3d upright = Eigen::Matrix3d::Identity();
  std::vector<TextFile> files;
  files.push_back(
      {objects + options.name + ".xml", bodyXml(options, mass, options.name + ".off")});
  files.push_back({objects + options.name + ".off", detail::offText(mesh)});
  files.push_back(
      {objects + "primitives/" + options.name + ".iv", detail::primitivesText(body)});
  const std::string around =
      (options.has_table ? addTable(options, mesh, mass.center, files) : "") +
      (options.obstacles.empty()
           ? ""
           : addObstacle(options.name + "_others",
                         meshOf(options.obstacles, options),
                         graspitTransform(upright, Eigen::Vector3d::Zero()),
                         files)) +
      cameraXml(mass.center,
                options.has_table ? options.table_normal
                                  : Eigen::Vector3d(Eigen::Vector3d::UnitZ()));
  files.push_back({"worlds/" + options.name + ".xml",
                   worldXml(elementXml("graspableBody",
                                       objects + options.name + ".xml",
                                       graspitTransform(upright, mass.center)) +
                            around)});
  if (options.part_bodies) {
    std::string bodies;
    for (std::size_t k = 0; k < model.size(); ++k) {
      const Superquadric& part = model.parts[k];
      const std::string name = options.name + "_part" + std::to_string(k);
      MultiSuperquadric alone;
      alone.parts = {part};
      files.push_back({objects + name + ".xml",
                       bodyXml(options, massProperties(alone), name + ".off")});
      files.push_back({objects + name + ".off",
                       detail::offText(meshOf(about(alone, part.center), options))});
      bodies += elementXml("graspableBody",
                           objects + name + ".xml",
                           graspitTransform(upright, part.center));
    }
    files.push_back(
        {"worlds/" + options.name + "_parts.xml", worldXml(bodies + around)});
  }
  if (!options.grasps.empty())
    files.push_back({options.name + "_grasps.txt", graspLines(options)});
  return files;
}

} // namespace pcl_sq

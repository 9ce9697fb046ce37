// SPDX-License-Identifier: BSD-3-Clause
// MoveIt's planning scene as text: what PlanningScene::loadGeometryFromStream() reads.
#include "export/robot_object.h"
#include "export/xml_text.h"
#include "union/shortest_turn.h"

namespace pcl_sq {

namespace {

using detail::CollisionShape;
using detail::numbersText;

std::string poseText(const Eigen::Vector3d& place, const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  return numbersText(place) + "\n" + numbersText({q.x(), q.y(), q.z(), q.w()}) + "\n";
}

std::string shapeText(const CollisionShape& shape) {
  const Eigen::Vector3d& h = shape.half_sizes;
  if (shape.kind == CollisionShape::BOX)
    return "box\n" + numbersText(2.0 * h) + "\n";
  if (shape.kind == CollisionShape::CYLINDER)
    return "cylinder\n" + numbersText({h.x(), 2.0 * h.z()}) + "\n";
  if (shape.kind == CollisionShape::SPHERE)
    return "sphere\n" + numbersText({h.x()}) + "\n";
  std::string text = "mesh\n" + std::to_string(shape.mesh.vertices.size()) + " " +
                     std::to_string(shape.mesh.triangles.size()) + "\n";
  for (const Eigen::Vector3d& v : shape.mesh.vertices)
    text += numbersText(v) + "\n";
  for (const auto& t : shape.mesh.triangles)
    text += std::to_string(t[0]) + " " + std::to_string(t[1]) + " " +
            std::to_string(t[2]) + "\n";
  return text;
}

/** \brief The table below an object, as a box whose upper face is its plane. */
std::string tableText(const std::array<double, 4>& table,
                      const Eigen::Vector3d& object,
                      const std::string& name) {
  constexpr double SIDE = 1.0, THICKNESS = 0.02;
  const Eigen::Vector3d normal(table[0], table[1], table[2]);
  const Eigen::Vector3d foot = object - (normal.dot(object) + table[3]) * normal;
  CollisionShape board;
  board.kind = CollisionShape::BOX;
  board.half_sizes = 0.5 * Eigen::Vector3d(SIDE, SIDE, THICKNESS);
  board.rotation = detail::shortestTurn(Eigen::Vector3d::UnitZ(), normal);
  return "* " + name + "\n" +
         poseText(foot - 0.5 * THICKNESS * normal, board.rotation) + "1\n" +
         shapeText(board) +
         poseText(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()) +
         "0.8 0.8 0.8 1\n0\n";
}

/** \brief The object's lines. \param[out] origin its place \return empty without parts
 */
std::string objectText(const ModelFile& file,
                       const RobotExportOptions& options,
                       Eigen::Vector3d& origin) {
  detail::RobotObject object;
  if (!detail::robotObject(file, options, object))
    return "";
  origin = object.origin;
  std::string text = "* " + options.name + "\n" +
                     poseText(object.origin, Eigen::Matrix3d::Identity()) +
                     std::to_string(object.shapes.size()) + "\n";
  for (const CollisionShape& shape : object.shapes)
    text += shapeText(shape) + poseText(object.placeOf(shape), shape.rotation) +
            "0.35 0.55 0.8 1\n";
  return text + "0\n"; // no subframes
}

} // namespace

std::vector<TextFile> moveitFiles(const ModelFile& file,
                                  const RobotExportOptions& options) {
  Eigen::Vector3d origin;
  std::string text = objectText(file, options, origin);
  if (text.empty())
    return {};
  if (file.table)
    text += tableText(*file.table, origin, options.name + "_table");
  return {{options.name + ".scene", options.name + "\n" + text + ".\n"}};
}

std::vector<TextFile> moveitFiles(const SceneFile& scene,
                                  const RobotExportOptions& options) {
  std::string text;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < scene.objects.size(); ++k) {
    RobotExportOptions own = options;
    own.name += "_" + std::to_string(k + 1);
    Eigen::Vector3d origin;
    const std::string thing = objectText(scene.objects[k].file, own, origin);
    if (thing.empty())
      return {};
    text += thing;
    sum += origin;
  }
  if (text.empty())
    return {};
  if (scene.table) // below the middle of all
    text += tableText(
        *scene.table, sum / double(scene.objects.size()), options.name + "_table");
  return {{options.name + ".scene", options.name + "\n" + text + ".\n"}};
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#include "io/graspit_text.h"

#include <locale>
#include <sstream>

namespace pcl_sq::detail {

namespace {

constexpr int CELLS = 20; ///< along each axis where primitives are compared

/** \brief A shape of GraspIt!'s primitive planner in a part's own frame. */
struct Primitive {
  enum Kind { BOX, CYLINDER, SPHERE } kind = BOX;
  int axis = 2;               ///< of the cylinder
  Eigen::Vector3d half_sizes; ///< of the box around it [m]

  bool contains(const Eigen::Vector3d& p) const {
    const Eigen::Array3d q = (p.array() / half_sizes.array()).abs();
    if (kind == SPHERE)
      return q.square().sum() <= 1.0;
    if (kind == BOX)
      return q.maxCoeff() <= 1.0;
    const double u = q[(axis + 1) % 3], v = q[(axis + 2) % 3];
    return q[axis] <= 1.0 && u * u + v * v <= 1.0;
  }
};

std::vector<Primitive> candidates(const Eigen::Vector3d& a) {
  std::vector<Primitive> all(5);
  all[0].half_sizes = a;
  for (int k = 0; k < 3; ++k) {
    Primitive& cylinder = all[std::size_t(k) + 1];
    cylinder.kind = Primitive::CYLINDER;
    cylinder.axis = k;
    cylinder.half_sizes.setConstant(std::sqrt(a[(k + 1) % 3] * a[(k + 2) % 3]));
    cylinder.half_sizes[k] = a[k];
  }
  all[4].kind = Primitive::SPHERE;
  all[4].half_sizes.setConstant(std::cbrt(a.prod()));
  return all;
}

Primitive closestPrimitive(const Superquadric& part) {
  const std::vector<Primitive> all = candidates(part.semi_axes);
  Eigen::Vector3d reach = part.halfSizes();
  for (const Primitive& p : all)
    reach = reach.cwiseMax(p.half_sizes);
  std::vector<int> both(all.size()), either(all.size());
  // all shapes are symmetric, but a tapered part, or one with a rim, across z, and a
  // bent one along its bend: an eighth of the box is enough, a quarter, or all of it
  const int across = part.isBent() ? 2 * CELLS : CELLS;
  const int layers = part.isPlain() ? CELLS : 2 * CELLS;
  for (int i = 0; i < across * across * layers; ++i) {
    const Eigen::Vector3d cell =
        Eigen::Vector3i(i % across, i / across % across, i / across / across)
            .cast<double>();
    Eigen::Vector3d p = ((cell.array() + 0.5) / CELLS).matrix().cwiseProduct(reach);
    for (int k = 0; k < 3; ++k)
      if (p[k] > reach[k])
        p[k] = reach[k] - p[k];
    const bool in_part = part.gauge(part.toWorld(p)) <= 1.0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      both[k] += in_part && all[k].contains(p);
      either[k] += in_part || all[k].contains(p);
    }
  }
  std::size_t best = 0;
  for (std::size_t k = 1; k < all.size(); ++k)
    if (double(both[k]) * either[best] > double(both[best]) * either[k])
      best = k;
  return all[best];
}

std::string shapeText(const Primitive& primitive) {
  const Eigen::Vector3d size = 2.0 * MILLIMETRES * primitive.half_sizes;
  switch (primitive.kind) {
  case Primitive::SPHERE:
    return "Sphere { radius " + numberText(0.5 * size[0]) + " }";
  case Primitive::CYLINDER:
    return "Cylinder { radius " + numberText(0.5 * size[(primitive.axis + 1) % 3]) +
           " height " + numberText(size[primitive.axis]) + " }";
  case Primitive::BOX:
    break;
  }
  return "Cube { width " + numberText(size[0]) + " height " + numberText(size[1]) +
         " depth " + numberText(size[2]) + " }";
}

} // namespace

std::string numberText(double number) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);
  text << (std::abs(number) < 1e-9 ? 0.0 : number); // no 1e-17, no -0
  return text.str();
}

std::string vectorText(const Eigen::Vector3d& vector) {
  return numberText(vector.x()) + " " + numberText(vector.y()) + " " +
         numberText(vector.z());
}

std::string offText(const TriangleMesh& mesh) {
  std::string text = "OFF\n" + std::to_string(mesh.vertices.size()) + " " +
                     std::to_string(mesh.triangles.size()) + " 0\n";
  for (const Eigen::Vector3d& v : mesh.vertices)
    text += vectorText(MILLIMETRES * v) + "\n";
  for (const auto& t : mesh.triangles)
    text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " +
            std::to_string(t[2]) + "\n";
  return text;
}

std::string primitivesText(const MultiSuperquadric& model) {
  std::string text = "#Inventor V2.1 ascii\nSeparator {\n";
  for (const Superquadric& part : model.parts) {
    const Primitive primitive = closestPrimitive(part);
    Eigen::Matrix3d frame = part.rotation;
    if (primitive.kind == Primitive::CYLINDER) { // Inventor's cylinder stands on y
      const int k = primitive.axis;
      frame << part.rotation.col((k + 2) % 3), part.rotation.col(k),
          part.rotation.col((k + 1) % 3);
    }
    const Eigen::AngleAxisd turn(frame);
    text += "  Separator {\n    Transform { translation " +
            vectorText(MILLIMETRES * part.center) + " rotation " +
            vectorText(turn.axis()) + " " + numberText(turn.angle()) + " }\n    " +
            shapeText(primitive) + "\n  }\n";
  }
  return text + "}\n";
}

} // namespace pcl_sq::detail

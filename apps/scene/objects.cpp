// SPDX-License-Identifier: BSD-3-Clause
#include "scene/objects.h"

#include <cmath>

namespace pcl_sq::app {
namespace {

constexpr double PI = 3.14159265358979323846;
constexpr int SEGMENTS = 192; // 3 um from the true circle at a radius of 26.5 mm

using Profile = std::vector<Eigen::Vector2d>; // (radius, height)

/** \brief Quarter of an ellipse from \a from to \a to, leaving along the tangent
 * \a direction. */
void addArc(Profile& profile,
            const Eigen::Vector2d& from,
            const Eigen::Vector2d& to,
            bool vertical_first,
            int steps = 16) {
  for (int i = 1; i <= steps; ++i) {
    const double a = 0.5 * PI * i / steps;
    const double fast = std::sin(a), slow = 1.0 - std::cos(a);
    const Eigen::Vector2d s =
        vertical_first ? Eigen::Vector2d(slow, fast) : Eigen::Vector2d(fast, slow);
    profile.push_back(from + s.cwiseProduct(to - from));
  }
}

/** \brief Closed surface of revolution; the profile runs from the axis at the bottom,
 * outside upwards, to the axis again. */
TriangleMesh revolve(const Profile& profile) {
  TriangleMesh mesh;
  const auto rings = static_cast<std::uint32_t>(profile.size());
  const auto vertex = [](std::uint32_t ring, std::uint32_t segment) {
    return 1 + (ring - 1) * SEGMENTS + segment % SEGMENTS;
  };
  mesh.vertices.emplace_back(0.0, 0.0, profile.front().y());
  for (std::uint32_t r = 1; r + 1 < rings; ++r)
    for (int s = 0; s < SEGMENTS; ++s) {
      const double a = 2.0 * PI * s / SEGMENTS;
      mesh.vertices.emplace_back(
          profile[r].x() * std::cos(a), profile[r].x() * std::sin(a), profile[r].y());
    }
  mesh.vertices.emplace_back(0.0, 0.0, profile.back().y());
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  for (std::uint32_t s = 0; s < SEGMENTS; ++s) {
    mesh.triangles.push_back({0, vertex(1, s + 1), vertex(1, s)});
    for (std::uint32_t r = 1; r + 2 < rings; ++r) {
      mesh.triangles.push_back({vertex(r, s), vertex(r, s + 1), vertex(r + 1, s + 1)});
      mesh.triangles.push_back({vertex(r, s), vertex(r + 1, s + 1), vertex(r + 1, s)});
    }
    mesh.triangles.push_back({vertex(rings - 2, s), vertex(rings - 2, s + 1), last});
  }
  return mesh;
}

/** \brief Closed tube of elliptic section along a path in the x-z plane. */
TriangleMesh
tube(const std::vector<Eigen::Vector2d>& path, double in_plane, double across) {
  constexpr std::uint32_t SIDES = 32;
  TriangleMesh mesh;
  const auto count = static_cast<std::uint32_t>(path.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    const Eigen::Vector2d t =
        (path[std::min(i + 1, count - 1)] - path[i > 0 ? i - 1 : 0]).normalized();
    for (std::uint32_t s = 0; s < SIDES; ++s) {
      const double a = 2.0 * PI * s / SIDES;
      const Eigen::Vector2d p =
          path[i] + in_plane * std::cos(a) * Eigen::Vector2d(t.y(), -t.x());
      mesh.vertices.emplace_back(p.x(), across * std::sin(a), p.y());
    }
  }
  const auto at = [](std::uint32_t i, std::uint32_t s) {
    return i * SIDES + s % SIDES;
  };
  for (std::uint32_t s = 0; s < SIDES; ++s)
    for (std::uint32_t i = 0; i + 1 < count; ++i) {
      mesh.triangles.push_back({at(i, s), at(i, s + 1), at(i + 1, s + 1)});
      mesh.triangles.push_back({at(i, s), at(i + 1, s + 1), at(i + 1, s)});
    }
  for (const std::uint32_t end : {0u, count - 1}) {
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back(path[end].x(), 0.0, path[end].y());
    for (std::uint32_t s = 0; s < SIDES; ++s)
      if (end == 0)
        mesh.triangles.push_back({middle, at(end, s + 1), at(end, s)});
      else
        mesh.triangles.push_back({middle, at(end, s), at(end, s + 1)});
  }
  return mesh;
}

void append(TriangleMesh& mesh, const TriangleMesh& part) {
  const auto offset = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& t : part.triangles)
    mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
}

void center(TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices)
    box.extend(v);
  const Eigen::Vector3d middle = box.center();
  for (Eigen::Vector3d& v : mesh.vertices)
    v -= middle;
}

SceneObject fromProfile(const Profile& profile) {
  SceneObject object;
  object.mesh = revolve(profile);
  object.symmetry = Symmetry::REVOLUTION;
  center(object.mesh);
  return object;
}

SceneObject fromSuperquadric(const Eigen::Vector3d& sizes,
                             double epsilon1,
                             double epsilon2,
                             Symmetry symmetry) {
  Superquadric s;
  s.semi_axes = 0.5 * sizes;
  s.epsilon1 = epsilon1;
  s.epsilon2 = epsilon2;
  SceneObject object;
  object.superquadrics.parts = {s};
  object.mesh = meshSuperquadric(s, 96);
  object.symmetry = symmetry;
  return object;
}

/** \brief The bottle of the paper's Table I: 53 mm wide, 350 mm high. */
SceneObject bottle() {
  Profile p{{0.0, 0.0}, {0.0225, 0.0}};
  addArc(p, {0.0225, 0.0}, {0.0265, 0.004}, false);
  for (int i = 1; i <= 40; ++i)
    p.emplace_back(0.0265, 0.004 + (0.225 - 0.004) * i / 40);
  addArc(p, {0.0265, 0.225}, {0.0125, 0.25}, true, 24);
  for (int i = 1; i <= 20; ++i)
    p.emplace_back(0.0125, 0.25 + (0.332 - 0.25) * i / 20);
  p.emplace_back(0.0145, 0.333);
  p.emplace_back(0.0145, 0.348);
  p.emplace_back(0.0125, 0.35);
  p.emplace_back(0.0, 0.35);
  SceneObject object = fromProfile(p);
  object.color = {0.30, 0.55, 0.22};
  object.distance = 1.134;
  return object;
}

SceneObject cup() {
  Profile p{{0.0, 0.0}, {0.035, 0.0}};
  addArc(p, {0.035, 0.0}, {0.04, 0.005}, false);
  for (int i = 1; i <= 24; ++i)
    p.emplace_back(0.04, 0.005 + (0.094 - 0.005) * i / 24);
  p.emplace_back(0.0395, 0.095);
  p.emplace_back(0.0365, 0.095);
  p.emplace_back(0.036, 0.094);
  for (int i = 1; i <= 24; ++i)
    p.emplace_back(0.036, 0.094 - (0.094 - 0.008) * i / 24);
  p.emplace_back(0.033, 0.005);
  p.emplace_back(0.0, 0.005);
  SceneObject object;
  object.mesh = revolve(p);
  std::vector<Eigen::Vector2d> path; // both ends lie within the wall
  for (int i = 0; i <= 48; ++i) {
    const double a = PI * (-0.5 + i / 48.0);
    path.emplace_back(0.038 + 0.028 * std::cos(a), 0.049 + 0.026 * std::sin(a));
  }
  append(object.mesh, tube(path, 0.0045, 0.006));
  center(object.mesh);
  object.color = {0.62, 0.20, 0.16};
  object.distance = 0.8;
  object.yaw = -0.35;
  return object;
}

SceneObject bowl() {
  Profile p{{0.0, 0.0}, {0.03, 0.0}};
  for (int i = 1; i <= 40; ++i) {
    const double a = 0.5 * PI * i / 40;
    p.emplace_back(0.03 + 0.045 * std::sin(a), 0.06 * (1.0 - std::cos(a)));
  }
  p.emplace_back(0.0745, 0.061);
  p.emplace_back(0.0715, 0.061);
  for (int i = 39; i >= 0; --i) {
    const double a = 0.5 * PI * i / 40;
    p.emplace_back(0.028 + 0.043 * std::sin(a), 0.004 + 0.056 * (1.0 - std::cos(a)));
  }
  p.emplace_back(0.0, 0.004);
  SceneObject object = fromProfile(p);
  object.color = {0.16, 0.42, 0.50};
  object.distance = 0.8;
  return object;
}

} // namespace

const char* toString(Symmetry symmetry) {
  switch (symmetry) {
  case Symmetry::BOX:
    return "box";
  case Symmetry::REVOLUTION:
    return "revolution";
  case Symmetry::SPHERE:
    return "sphere";
  case Symmetry::NONE:
    break;
  }
  return "none";
}

bool symmetryFromString(const std::string& name, Symmetry* symmetry) {
  for (const Symmetry s :
       {Symmetry::NONE, Symmetry::BOX, Symmetry::REVOLUTION, Symmetry::SPHERE})
    if (name == toString(s)) {
      *symmetry = s;
      return true;
    }
  return false;
}

Eigen::AlignedBox3d SceneObject::box() const {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& v : mesh.vertices)
    box.extend(v);
  return box;
}

const std::vector<std::string>& objectNames() {
  static const std::vector<std::string> names{
      "bottle", "cup", "book", "box", "can", "tomato", "bowl"};
  return names;
}

SceneObject makeObject(const std::string& name) {
  if (name == "bottle")
    return bottle();
  if (name == "cup")
    return cup();
  if (name == "bowl")
    return bowl();
  SceneObject object;
  if (name == "book") { // the paper's, standing
    object = fromSuperquadric({0.22, 0.015, 0.30}, 0.06, 0.06, Symmetry::BOX);
    object.color = {0.55, 0.16, 0.18};
    object.distance = 1.1;
    object.yaw = 0.3;
  } else if (name == "box") {
    object = fromSuperquadric({0.16, 0.06, 0.21}, 0.1, 0.1, Symmetry::BOX);
    object.color = {0.70, 0.50, 0.10};
    object.distance = 1.1;
    object.yaw = 0.5;
  } else if (name == "can") {
    object = fromSuperquadric({0.066, 0.066, 0.115}, 0.1, 1.0, Symmetry::REVOLUTION);
    object.color = {0.18, 0.30, 0.62};
    object.distance = 0.8;
  } else { // tomato
    object = fromSuperquadric({0.075, 0.075, 0.062}, 0.9, 1.0, Symmetry::REVOLUTION);
    object.color = {0.70, 0.13, 0.08};
    object.distance = 0.7;
  }
  return object;
}

SceneObject makeObject(TriangleMesh mesh, char up, double unit) {
  for (Eigen::Vector3d& v : mesh.vertices) {
    // cyclic changes of the axes, so that left stays left
    if (up == 'y')
      v = Eigen::Vector3d(v.z(), v.x(), v.y());
    else if (up == 'x')
      v = Eigen::Vector3d(v.y(), v.z(), v.x());
    v *= unit;
  }
  center(mesh);
  SceneObject object;
  object.mesh = std::move(mesh);
  object.color = {0.55, 0.50, 0.15};
  return object;
}

} // namespace pcl_sq::app

// SPDX-License-Identifier: BSD-3-Clause
#include "export/collision_shapes.h"

#include "geometry/bend.h"
#include "quality/convex_hull.h"

#include "pcl_sq/sides.h"

#include <map>

namespace pcl_sq::detail {

namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr int SECTORS = 16; ///< of a hollow body's wall: chords 2 % of its radius off

/** \brief The largest distance of a primitive's surface from the part. The primitive
 * has the part's extents, so that it stands off most at its corners, its edges, or
 * between the axes. */
double standOff(const CollisionShape& shape, const Superquadric& part) {
  const Eigen::Vector3d& h = shape.half_sizes;
  Points places;
  const double diagonal = std::sqrt(0.5), third = std::sqrt(1.0 / 3.0);
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d sign(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    if (shape.kind == CollisionShape::BOX)
      places.push_back(sign.cwiseProduct(h));
    else if (shape.kind == CollisionShape::CYLINDER)
      places.push_back(sign.cwiseProduct(
          Eigen::Vector3d(diagonal * h.x(), diagonal * h.y(), h.z())));
    else {
      places.push_back(third * sign.cwiseProduct(h));
      for (int axis = 0; axis < 3; ++axis) {
        Eigen::Vector3d p = diagonal * sign.cwiseProduct(h);
        p[axis] = 0.0;
        places.push_back(p);
      }
    }
  }
  if (shape.kind == CollisionShape::CYLINDER)
    for (int i = 0; i < 4; ++i)
      places.emplace_back(i % 2 == 0 ? h.x() * (1 - i) : 0.0,
                          i % 2 == 1 ? h.y() * (2 - i) : 0.0,
                          h.z());
  double largest = 0.0;
  for (const Eigen::Vector3d& p : places)
    largest = std::max(
        largest, std::abs(part.euclideanDistance(shape.center + shape.rotation * p)));
  return largest;
}

/** \brief The primitive that stands off least, if it does little. */
bool findPrimitive(const Superquadric& part, double tolerance, CollisionShape& best) {
  if (!part.isPlain())
    return false;
  const OrientedBox box = boxAround(part);
  const double half_diagonal = box.half_sizes.norm();
  double least = tolerance * half_diagonal;
  bool found = false;
  const auto consider = [&](CollisionShape::Kind kind,
                            const Eigen::Matrix3d& rotation,
                            const Eigen::Vector3d& half_sizes) {
    CollisionShape shape;
    shape.kind = kind;
    shape.center = part.center;
    shape.rotation = rotation;
    shape.half_sizes = half_sizes;
    const double off = standOff(shape, part);
    if (off <= least) {
      least = off;
      best = shape;
      found = true;
    }
  };
  const Eigen::Vector3d& a = part.semi_axes;
  consider(CollisionShape::SPHERE,
           part.rotation,
           Eigen::Vector3d::Constant(std::cbrt(a.prod())));
  for (int axis = 0; axis < 3; ++axis) {
    // the axis becomes the third, the others follow in their order
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    Eigen::Matrix3d rotation;
    rotation << part.rotation.col(u), part.rotation.col(v), part.rotation.col(axis);
    const double radius = std::sqrt(a[u] * a[v]);
    consider(CollisionShape::CYLINDER, rotation, {radius, radius, a[axis]});
  }
  consider(CollisionShape::BOX, box.rotation, box.half_sizes);
  return found;
}

CollisionShape meshShape(const Points& points) {
  CollisionShape shape;
  shape.mesh = hullMesh(points);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : shape.mesh.vertices)
    box.extend(p);
  if (!shape.mesh.vertices.empty())
    shape.center = box.center();
  for (Eigen::Vector3d& p : shape.mesh.vertices)
    p -= shape.center;
  return shape;
}

/** \brief Heights over a3 between which a wall is nearly straight: the middle of each
 * stretch bulges by less than half the wall. */
std::vector<double> wallHeights(const Superquadric& s) {
  const double low = floorHeight(s), high = s.rimHeight();
  const auto radius = [&](double height) { return sectionAt(s, height).a; };
  for (int stretches = 1;; stretches *= 2) {
    std::vector<double> heights;
    for (int i = 0; i <= stretches; ++i)
      heights.push_back(low + (high - low) * i / stretches);
    bool straight = true;
    for (int i = 0; i < stretches; ++i) {
      const double a = heights[std::size_t(i)], b = heights[std::size_t(i) + 1];
      straight = straight &&
                 radius(0.5 * (a + b)) - 0.5 * (radius(a) + radius(b)) < 0.5 * s.wall;
    }
    if (straight || stretches >= 8)
      return heights;
  }
}

/** \brief The floor as one piece, the wall as convex blocks. */
std::vector<CollisionShape> hollowShapes(const Superquadric& s) {
  std::vector<CollisionShape> shapes;
  const auto place = [&](double height, double inset, int sector) {
    const Ring ring = {sectionAt(s, height, inset), height * s.semi_axes.z()};
    return s.toWorld(ring.section.empty()
                         ? Eigen::Vector3d(0.0, 0.0, ring.z)
                         : onRing(ring, s.epsilon2, 2.0 * M_PI * sector / SECTORS));
  };
  const auto add = [&](const Points& points) {
    CollisionShape shape = meshShape(points);
    if (!shape.mesh.triangles.empty())
      shapes.push_back(std::move(shape));
  };
  const std::vector<double> heights = wallHeights(s);
  Points floor;
  for (int sector = 0; sector < SECTORS; ++sector)
    for (const double share : {0.0, 0.3, 0.6, 1.0})
      floor.push_back(place(-1.0 + share * (heights.front() + 1.0), 0.0, sector));
  add(floor);
  for (std::size_t i = 0; i + 1 < heights.size(); ++i)
    for (int sector = 0; sector < SECTORS; ++sector) {
      Points block;
      for (const double height : {heights[i], heights[i + 1]})
        for (const double inset : {0.0, s.wall})
          for (const int side : {sector, sector + 1})
            block.push_back(place(height, inset, side));
      add(block);
    }
  return shapes;
}

/** \brief A bent body stretch by stretch, so that its hole stays open. */
std::vector<CollisionShape> bentShapes(const Superquadric& s) {
  constexpr int RINGS = 4;
  const int pieces = convexPieces(s);
  std::vector<CollisionShape> shapes;
  for (int i = 0; i < pieces; ++i) {
    Points points;
    for (int k = 0; k <= RINGS; ++k) {
      const double height = -1.0 + 2.0 * (i + double(k) / RINGS) / pieces;
      const Ring ring = {sectionAt(s, height), height * s.semi_axes.z()};
      for (int sector = 0; sector < SECTORS; ++sector)
        points.push_back(s.toWorld(
            bent(s,
                 ring.section.empty()
                     ? Eigen::Vector3d(0.0, 0.0, ring.z)
                     : onRing(ring, s.epsilon2, 2.0 * M_PI * sector / SECTORS))));
    }
    CollisionShape shape = meshShape(points);
    if (!shape.mesh.triangles.empty())
      shapes.push_back(std::move(shape));
  }
  return shapes;
}

} // namespace

TriangleMesh hullMesh(const std::vector<Eigen::Vector3d>& points) {
  TriangleMesh mesh;
  Eigen::MatrixXd columns(3, Eigen::Index(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    columns.col(Eigen::Index(i)) = points[i];
  std::vector<HullFacet> facets;
  std::vector<std::vector<int>> corners;
  if (!convexHull(columns, facets, nullptr, &corners))
    return mesh;
  std::map<int, std::uint32_t> number; // of a column among the vertices
  for (std::size_t f = 0; f < facets.size(); ++f) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, is_new] = number.emplace(
          corners[f][k], static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new)
        mesh.vertices.push_back(points[std::size_t(corners[f][k])]);
      triangle[k] = at->second;
    }
    const Eigen::Vector3d u = mesh.vertices[triangle[1]] - mesh.vertices[triangle[0]];
    const Eigen::Vector3d v = mesh.vertices[triangle[2]] - mesh.vertices[triangle[0]];
    if (u.cross(v).dot(facets[f].normal) < 0.0)
      std::swap(triangle[1], triangle[2]);
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

std::vector<CollisionShape> collisionShapes(const Superquadric& part,
                                            double tolerance) {
  if (part.isBent())
    return bentShapes(part);
  CollisionShape primitive;
  if (findPrimitive(part, tolerance, primitive))
    return {primitive};
  if (part.isHollow())
    return hollowShapes(part);
  constexpr int DIVISIONS = 6; // some 200 vertices, as physics engines like them
  return {meshShape(meshSuperquadric(part, DIVISIONS).vertices)};
}

} // namespace pcl_sq::detail

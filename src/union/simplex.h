// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>

namespace pcl_sq::detail {

/** \brief Up to four points whose hull is searched for the point nearest the origin;
 * the points that do not carry it are dropped (Ericson 2005, "Real-Time Collision
 * Detection", 5.1). */
class Simplex {
public:
  Simplex() { points_.fill(Eigen::Vector3d::Zero()); }
  int size() const { return size_; }
  void add(const Eigen::Vector3d& point) { points_[std::size_t(size_++)] = point; }
  bool contains(const Eigen::Vector3d& point) const {
    for (int i = 0; i < size_; ++i)
      if ((points_[std::size_t(i)] - point).squaredNorm() <= 1e-28)
        return true;
    return false;
  }

  /** \brief Nearest point; keeps four points exactly if they enclose the origin. */
  Eigen::Vector3d closestToOrigin() {
    switch (size_) {
    case 1:
      return points_[0];
    case 2:
      return onSegment();
    case 3:
      return onTriangle();
    default:
      return onTetrahedron();
    }
  }

private:
  void keep(std::initializer_list<Eigen::Vector3d> points) {
    size_ = 0;
    for (const Eigen::Vector3d& p : points)
      points_[std::size_t(size_++)] = p;
  }

  Eigen::Vector3d onSegment() {
    const Eigen::Vector3d a = points_[0], b = points_[1], ab = b - a;
    const double t = -a.dot(ab), full = ab.squaredNorm();
    if (t <= 0.0)
      return keep({a}), a;
    if (t >= full)
      return keep({b}), b;
    return a + t / full * ab;
  }

  Eigen::Vector3d onTriangle() {
    const Eigen::Vector3d a = points_[0], b = points_[1], c = points_[2];
    const Eigen::Vector3d ab = b - a, ac = c - a;
    const double d1 = -ab.dot(a), d2 = -ac.dot(a);
    if (d1 <= 0.0 && d2 <= 0.0)
      return keep({a}), a;
    const double d3 = -ab.dot(b), d4 = -ac.dot(b);
    if (d3 >= 0.0 && d4 <= d3)
      return keep({b}), b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
      return keep({a, b}), a + d1 / (d1 - d3) * ab;
    const double d5 = -ab.dot(c), d6 = -ac.dot(c);
    if (d6 >= 0.0 && d5 <= d6)
      return keep({c}), c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
      return keep({a, c}), a + d2 / (d2 - d6) * ac;
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
      return keep({b, c}), b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    const double sum = va + vb + vc;
    return a + ab * (vb / sum) + ac * (vc / sum);
  }

  Eigen::Vector3d onTetrahedron() {
    static constexpr int FACES[4][4] = {
        {0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
    const std::array<Eigen::Vector3d, 4> p = points_;
    Simplex best;
    Eigen::Vector3d nearest = Eigen::Vector3d::Zero();
    double smallest = -1.0;
    for (const auto& f : FACES) {
      const Eigen::Vector3d& a = p[std::size_t(f[0])];
      const Eigen::Vector3d normal =
          (p[std::size_t(f[1])] - a).cross(p[std::size_t(f[2])] - a);
      const double inner = normal.dot(p[std::size_t(f[3])] - a);
      const double origin = -normal.dot(a);
      // a flat tetrahedron has no inside: every face is a candidate then
      const bool flat = std::abs(inner) <= 1e-14 * normal.norm();
      if (!flat && inner * origin >= 0.0)
        continue;
      Simplex face;
      face.keep({p[std::size_t(f[0])], p[std::size_t(f[1])], p[std::size_t(f[2])]});
      const Eigen::Vector3d q = face.onTriangle();
      if (smallest < 0.0 || q.squaredNorm() < smallest) {
        smallest = q.squaredNorm();
        nearest = q;
        best = face;
      }
    }
    if (smallest >= 0.0)
      *this = best;
    return nearest;
  }

  std::array<Eigen::Vector3d, 4> points_;
  int size_ = 0;
};

} // namespace pcl_sq::detail

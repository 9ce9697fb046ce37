// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/edit_mesh.h"

#include <algorithm>

namespace pcl_sq::detail {

EditMesh::EditMesh(const PartMesh& mesh)
    : vertices_(mesh.mesh.vertices), triangles_(mesh.mesh.triangles), part_(mesh.part),
      around_(mesh.mesh.vertices.size()), triangle_count_(mesh.mesh.triangles.size()) {
  for (Index t = 0; t < triangles_.size(); ++t)
    attach(t);
}

void EditMesh::attach(Index triangle) {
  for (const Index v : triangles_[triangle])
    around_[v].push_back(triangle);
}

void EditMesh::detach(Index triangle, Index vertex) {
  std::vector<Index>& list = around_[vertex];
  list.erase(std::find(list.begin(), list.end(), triangle));
}

std::vector<EditMesh::Index> EditMesh::neighbours(Index v) const {
  std::vector<Index> all;
  for (const Index t : around_[v])
    for (const Index w : triangles_[t])
      if (w != v)
        all.push_back(w);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::vector<std::pair<EditMesh::Index, EditMesh::Index>> EditMesh::edges() const {
  std::vector<std::pair<Index, Index>> all;
  for (Index v = 0; v < vertices_.size(); ++v)
    for (const Index w : neighbours(v))
      if (v < w)
        all.emplace_back(v, w);
  return all;
}

bool EditMesh::beside(Index a, Index b, std::array<Index, 2>& triangles) const {
  bool found[2] = {false, false};
  for (const Index t : around_[a]) {
    const Triangle& corners = triangles_[t];
    for (int i = 0; i < 3; ++i)
      if (corners[i] == a) {
        if (corners[(i + 1) % 3] == b) {
          triangles[0] = t;
          found[0] = true;
        } else if (corners[(i + 2) % 3] == b) {
          triangles[1] = t;
          found[1] = true;
        }
      }
  }
  return found[0] && found[1];
}

EditMesh::Index EditMesh::opposite(Index triangle, Index a, Index b) const {
  for (const Index v : triangles_[triangle])
    if (v != a && v != b)
      return v;
  return a;
}

EditMesh::Index EditMesh::split(Index a, Index b, const Eigen::Vector3d& position) {
  std::array<Index, 2> sides{};
  beside(a, b, sides);
  const Index added = Index(vertices_.size());
  vertices_.push_back(position);
  around_.emplace_back();
  for (const Index t : sides) {
    // t keeps a, its copy takes b
    Triangle copy = triangles_[t];
    std::replace(copy.begin(), copy.end(), a, added);
    std::replace(triangles_[t].begin(), triangles_[t].end(), b, added);
    detach(t, b);
    around_[added].push_back(t);
    triangles_.push_back(copy);
    part_.push_back(part_[t]);
    attach(Index(triangles_.size() - 1));
    ++triangle_count_;
  }
  return added;
}

bool EditMesh::canCollapse(Index from, Index to) const {
  std::array<Index, 2> sides{};
  if (!beside(from, to, sides))
    return false;
  const Index c = opposite(sides[0], from, to), d = opposite(sides[1], from, to);
  if (around_[c].size() <= 3 || around_[d].size() <= 3)
    return false;
  // a third vertex beside both would become the tip of two triangles back to back
  const std::vector<Index> mine = neighbours(from), other = neighbours(to);
  std::vector<Index> both;
  std::set_intersection(
      mine.begin(), mine.end(), other.begin(), other.end(), std::back_inserter(both));
  return both.size() == 2;
}

void EditMesh::collapse(Index from, Index to) {
  const std::vector<Index> list = around_[from];
  for (const Index t : list) {
    Triangle& corners = triangles_[t];
    if (std::find(corners.begin(), corners.end(), to) != corners.end()) {
      for (const Index v : corners)
        if (v != from)
          detach(t, v);
      corners = {0, 0, 0};
      --triangle_count_;
    } else {
      std::replace(corners.begin(), corners.end(), from, to);
      around_[to].push_back(t);
    }
  }
  around_[from].clear();
}

bool EditMesh::canFlip(Index a, Index b) const {
  std::array<Index, 2> sides{}, other{};
  if (!beside(a, b, sides) || around_[a].size() <= 3 || around_[b].size() <= 3)
    return false;
  const Index c = opposite(sides[0], a, b), d = opposite(sides[1], a, b);
  return c != d && !beside(c, d, other);
}

void EditMesh::flip(Index a, Index b) {
  std::array<Index, 2> sides{};
  beside(a, b, sides);
  const Index c = opposite(sides[0], a, b), d = opposite(sides[1], a, b);
  // a b c and b a d become d b c and c a d
  detach(sides[0], a);
  std::replace(triangles_[sides[0]].begin(), triangles_[sides[0]].end(), a, d);
  around_[d].push_back(sides[0]);
  detach(sides[1], b);
  std::replace(triangles_[sides[1]].begin(), triangles_[sides[1]].end(), b, c);
  around_[c].push_back(sides[1]);
}

PartMesh EditMesh::compact() const {
  PartMesh result;
  std::vector<Index> renamed(vertices_.size());
  for (Index v = 0; v < vertices_.size(); ++v)
    if (!around_[v].empty()) {
      renamed[v] = Index(result.mesh.vertices.size());
      result.mesh.vertices.push_back(vertices_[v]);
    }
  for (Index t = 0; t < triangles_.size(); ++t) {
    const Triangle& c = triangles_[t];
    if (c[0] == c[1]) // gone
      continue;
    result.mesh.triangles.push_back({renamed[c[0]], renamed[c[1]], renamed[c[2]]});
    result.part.push_back(part_[t]);
  }
  return result;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "observe_parts.h"

#include <cmath>

namespace pcl_sq {

namespace {

constexpr int MIN_PIXELS = 100;
constexpr double JUMP =
    0.025; ///< of the depth: neighbours further apart are two things
constexpr std::size_t VOTERS = 6000; ///< points in which the table is looked for

struct Region {
  std::vector<int> pixels;
  bool cut = false; ///< by the image border
};

/** \brief Regions of pixels that are set, connected without a jump in depth. */
class Regions {
public:
  Regions(const CloudPoints& points, CellMask above)
      : points_(points), left_(std::move(above)) {}

  /** \brief The next region; empty when there is none left. */
  Region next() {
    Region region;
    while (at_ < left_.cells.size() && !left_.cells[at_])
      ++at_;
    if (at_ == left_.cells.size())
      return region;
    visit(static_cast<int>(at_), region);
    for (std::size_t i = 0; i < region.pixels.size(); ++i)
      grow(region.pixels[i], region);
    return region;
  }

private:
  void visit(int c, Region& region) {
    left_.cells[std::size_t(c)] = 0;
    region.pixels.push_back(c);
  }
  void grow(int c, Region& region) {
    const int x = c % left_.width, y = c / left_.width;
    region.cut =
        region.cut || x == 0 || y == 0 || x == left_.width - 1 || y == left_.height - 1;
    const float depth = points_(2, c);
    // two pixels far, across missing ones
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) {
        if (!left_(x + dx, y + dy))
          continue;
        const int d = c + dy * left_.width + dx;
        if (std::abs(points_(2, d) - depth) < JUMP * std::abs(depth))
          visit(d, region);
      }
  }

  const CloudPoints& points_;
  CellMask left_;
  std::size_t at_ = 0;
};

} // namespace

bool findStandingObject(const CloudPoints& points,
                        int width,
                        int height,
                        std::optional<TableModel>& table,
                        CellMask& object) {
  object = CellMask(width, height);
  const auto total = static_cast<std::size_t>(points.cols());
  std::vector<Eigen::Vector3d> voters;
  double depth = 0.0;
  for (std::size_t i = 0; i < total; i += std::max<std::size_t>(1, total / VOTERS))
    if (points.col(Eigen::Index(i)).allFinite()) {
      voters.push_back(points.col(Eigen::Index(i)).cast<double>());
      depth += voters.back().z();
    }
  if (voters.size() < 100)
    return false;
  depth = std::abs(depth) / double(voters.size());
  // the largest plane may be a wall: nothing stands on one but its own noise
  for (int attempt = 0; attempt < 3; ++attempt) {
    TableModel plane;
    if (table)
      plane = *table;
    else if (!findPlane(voters, Eigen::Vector3d::Zero(), 0.008 * depth, plane))
      return false;
    CellMask above(width, height);
    for (std::size_t i = 0; i < total; ++i) {
      const Eigen::Vector3f p = points.col(Eigen::Index(i));
      const auto standing =
          static_cast<float>(detail::standingHeight(plane, double(p.z())));
      above.cells[i] =
          plane.normal.cast<float>().dot(p) + float(plane.offset) > standing;
    }
    Regions regions(points, above);
    Region best;
    for (Region r = regions.next(); !r.pixels.empty(); r = regions.next()) {
      const bool better = r.cut == best.cut ? r.pixels.size() > best.pixels.size()
                                            : best.cut || best.pixels.empty();
      if (r.pixels.size() >= std::size_t(MIN_PIXELS) && better)
        best = std::move(r);
    }
    if (!best.pixels.empty() && !best.cut) {
      table = plane;
      for (const int c : best.pixels)
        object.cells[std::size_t(c)] = 1;
      return true;
    }
    if (table)
      return false;
    std::vector<Eigen::Vector3d> rest;
    for (const Eigen::Vector3d& p : voters)
      if (std::abs(plane.height(p)) > 0.016 * depth)
        rest.push_back(p);
    voters.swap(rest);
  }
  return false;
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/silhouette.h"

#include "observe/observe_parts.h"
#include "util/outer_points.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq {

namespace {

double
cross(const Eigen::Vector2d& o, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
}

} // namespace

std::vector<ContourPoint> contourOf(const CellMask& mask,
                                    const std::function<bool(int x, int y)>& foreign) {
  std::vector<ContourPoint> contour;
  const CellRect box = boundingRect(mask); // small in most images
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) {
      if (!mask.cells[mask.indexOf(x, y)] ||
          (mask(x - 1, y) && mask(x + 1, y) && mask(x, y - 1) && mask(x, y + 1)))
        continue;
      ContourPoint point;
      point.pixel = {double(x), double(y)};
      const bool border =
          x == 0 || y == 0 || x == mask.width - 1 || y == mask.height - 1;
      point.own = !border && !(foreign && foreign(x, y));
      contour.push_back(point);
    }
  return contour;
}

std::vector<ContourPoint> convexHull(const std::vector<ContourPoint>& contour) {
  std::vector<ContourPoint> sorted = contour;
  detail::keepOuter(sorted, [](const ContourPoint& p) { return p.pixel; });
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.pixel.x() != b.pixel.x() ? a.pixel.x() < b.pixel.x()
                                      : a.pixel.y() < b.pixel.y();
  });
  if (sorted.size() < 3)
    return sorted;
  std::vector<ContourPoint> hull;
  // Andrew's monotone chain: lower hull forwards, upper hull backwards
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t first = hull.size();
    for (const ContourPoint& p : sorted) {
      while (hull.size() >= first + 2 &&
             cross(hull[hull.size() - 2].pixel, hull.back().pixel, p.pixel) <= 0.0)
        hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(sorted.begin(), sorted.end());
  }
  return hull;
}

bool detail::TouchingLines::knows(const SilhouetteLine& line) const {
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (known[i] && lines[i].direction == line.direction)
      return true;
  return false;
}

detail::TouchingLines detail::touchingLines(const std::vector<ContourPoint>& contour,
                                            int count,
                                            double tolerance) {
  TouchingLines all;
  const std::vector<ContourPoint> hull = convexHull(contour);
  if (hull.size() < 3)
    return all;
  std::vector<ContourPoint> foreign, own;
  for (const ContourPoint& p : contour)
    (p.own ? own : foreign).push_back(p);
  // along a straight side the tolerance is used up after so many pixels by a line that
  // is turned by three quarters of a step: nearer own points say nothing of a line
  const double reach = tolerance / std::sin(0.75 * 2.0 * M_PI / std::max(8, count));
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * M_PI * k / count;
    SilhouetteLine line;
    line.direction = {std::cos(angle), std::sin(angle)};
    line.offset = -1e300;
    for (const ContourPoint& p : hull)
      if (line.direction.dot(p.pixel) > line.offset) {
        line.offset = line.direction.dot(p.pixel);
        line.contact = p.pixel;
      }
    const auto touched = [&](const ContourPoint& p) {
      return line.direction.dot(p.pixel) >= line.offset - tolerance;
    };
    std::vector<Eigen::Vector2d> unknown;
    for (const ContourPoint& p : foreign)
      if (touched(p))
        unknown.push_back(p.pixel);
    const auto apart = [&](const ContourPoint& p) {
      return touched(p) &&
             std::all_of(unknown.begin(), unknown.end(), [&](const Eigen::Vector2d& q) {
               return (p.pixel - q).squaredNorm() >= reach * reach;
             });
    };
    // a straight side is tangent all along, wherever the outline is lost beyond its end
    all.known.push_back(unknown.empty() || std::any_of(own.begin(), own.end(), apart));
    all.lines.push_back(line);
  }
  return all;
}

std::vector<SilhouetteLine>
silhouetteLines(const std::vector<ContourPoint>& contour, int count, double tolerance) {
  const detail::TouchingLines all = detail::touchingLines(contour, count, tolerance);
  std::vector<SilhouetteLine> lines;
  for (std::size_t i = 0; i < all.lines.size(); ++i)
    if (all.known[i])
      lines.push_back(all.lines[i]);
  return lines;
}

TangentPlane tangentPlane(const PinholeCamera& camera,
                          const SilhouetteLine& line,
                          double sigma,
                          double depth) {
  // the line (mx, my, -c) maps to the plane K^T l through the camera's centre
  const Eigen::Vector3d plane(camera.fx * line.direction.x(),
                              camera.fy * line.direction.y(),
                              line.direction.x() * camera.cx +
                                  line.direction.y() * camera.cy - line.offset);
  TangentPlane support;
  support.normal = camera.rotation * plane.normalized();
  support.offset = support.normal.dot(camera.center);
  support.sigma = sigma * depth / std::sqrt(camera.fx * camera.fy);
  return support;
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#include "view_canvas.h"

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_sq::app {
namespace {

constexpr float FAR = std::numeric_limits<float>::infinity();

Eigen::Vector3d cornerOf(const RoiBox& box, int i) {
  return {i & 1 ? box.max.x() : box.min.x(),
          i & 2 ? box.max.y() : box.min.y(),
          i & 4 ? box.max.z() : box.min.z()};
}

} // namespace

TriangleMesh meshBox(const RoiBox& box) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(cornerOf(box, i));
  mesh.triangles = {{0, 2, 1},
                    {1, 2, 3},
                    {4, 5, 6},
                    {5, 7, 6},
                    {0, 1, 4},
                    {1, 5, 4},
                    {2, 6, 3},
                    {3, 6, 7},
                    {0, 4, 2},
                    {2, 4, 6},
                    {1, 3, 5},
                    {3, 7, 5}};
  return mesh;
}

ViewCanvas::ViewCanvas(const cv::Size& size,
                       const RoiBox& focus,
                       double turn,
                       double tilt)
    : picture_(size, CV_8UC3, cv::Scalar(248, 246, 244)), depth_(size, CV_32F, FAR),
      center_(focus.center()) {
  rotation_ = (Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()) *
               Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY()))
                  .toRotationMatrix();
  const double diagonal = focus.sizes().norm();
  distance_ = 3.5 * diagonal;
  // the turned box, with a little air, fills the picture
  double right = 1e-6, up = 1e-6;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d p = rotation_ * (cornerOf(focus, i) - center_);
    right = std::max(right, std::abs(p.x()) / (p.z() + distance_));
    up = std::max(up, std::abs(p.y()) / (p.z() + distance_));
  }
  scale_ = 0.44 * std::min(size.width / right, size.height / up);
}

Eigen::Vector3d ViewCanvas::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d p = rotation_ * (point - center_);
  const double z = p.z() + distance_;
  return {scale_ * p.x() / z + 0.5 * picture_.cols,
          scale_ * p.y() / z + 0.5 * picture_.rows,
          z};
}

void ViewCanvas::addPoints(const std::vector<Eigen::Vector3d>& points,
                           const std::vector<cv::Vec3b>& colors,
                           int dot) {
  const cv::Rect all(0, 0, picture_.cols, picture_.rows);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = project(points[i]);
    if (p.z() <= 0.0 || std::abs(p.x()) > 1e6 || std::abs(p.y()) > 1e6)
      continue;
    const cv::Rect square = cv::Rect(static_cast<int>(p.x()) - dot / 2,
                                     static_cast<int>(p.y()) - dot / 2,
                                     dot,
                                     dot) &
                            all;
    for (int v = square.y; v < square.y + square.height; ++v)
      for (int u = square.x; u < square.x + square.width; ++u)
        if (float& z = depth_.at<float>(v, u); p.z() < z) {
          z = static_cast<float>(p.z());
          picture_.at<cv::Vec3b>(v, u) = colors[i];
        }
  }
}

void ViewCanvas::fillTriangle(const Eigen::Vector3d* c,
                              const cv::Vec3b& color,
                              cv::Mat& layer,
                              cv::Mat& depth) const {
  const Eigen::Vector2d a = c[0].head<2>(), ab = c[1].head<2>() - a,
                        ac = c[2].head<2>() - a;
  const double area = ab.x() * ac.y() - ab.y() * ac.x();
  if (std::abs(area) < 1e-9)
    return;
  const auto low = [&](int k) {
    return std::max(0.0, std::floor(std::min({c[0][k], c[1][k], c[2][k]})));
  };
  const double right = std::max({c[0].x(), c[1].x(), c[2].x()});
  const double bottom = std::max({c[0].y(), c[1].y(), c[2].y()});
  for (int v = static_cast<int>(low(1)); v <= bottom && v < layer.rows; ++v)
    for (int u = static_cast<int>(low(0)); u <= right && u < layer.cols; ++u) {
      const Eigen::Vector2d p = Eigen::Vector2d(u, v) - a;
      const double s = (p.x() * ac.y() - p.y() * ac.x()) / area;
      const double t = (ab.x() * p.y() - ab.y() * p.x()) / area;
      if (s < 0.0 || t < 0.0 || s + t > 1.0)
        continue;
      const double z = c[0].z() + s * (c[1].z() - c[0].z()) + t * (c[2].z() - c[0].z());
      if (float& old = depth.at<float>(v, u); z < old) {
        old = static_cast<float>(z);
        layer.at<cv::Vec3b>(v, u) = color;
      }
    }
}

void ViewCanvas::blend(const cv::Mat& layer, const cv::Mat& depth, double opacity) {
  for (int v = 0; v < picture_.rows; ++v)
    for (int u = 0; u < picture_.cols; ++u) {
      if (depth.at<float>(v, u) == FAR)
        continue;
      // what lies behind measured points still shines through a little
      const bool hidden = depth.at<float>(v, u) > depth_.at<float>(v, u);
      const double w = hidden ? 0.35 * opacity : opacity;
      auto& out = picture_.at<cv::Vec3b>(v, u);
      const auto& in = layer.at<cv::Vec3b>(v, u);
      for (int k = 0; k < 3; ++k)
        out[k] = cv::saturate_cast<std::uint8_t>(w * in[k] + (1.0 - w) * out[k]);
    }
}

void ViewCanvas::addMesh(const TriangleMesh& mesh,
                         const cv::Vec3b& color,
                         double opacity) {
  cv::Mat layer(picture_.size(), CV_8UC3), depth(picture_.size(), CV_32F, FAR);
  const Eigen::Vector3d light = Eigen::Vector3d(-0.4, -0.7, -0.6).normalized();
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    const Eigen::Vector3d normal =
        rotation_ *
        (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).normalized();
    const double shade = 0.45 + 0.55 * std::max(0.0, normal.dot(light));
    cv::Vec3b shaded;
    for (int k = 0; k < 3; ++k)
      shaded[k] = cv::saturate_cast<std::uint8_t>(shade * color[k]);
    const Eigen::Vector3d corners[] = {
        project(a), project(mesh.vertices[t[1]]), project(mesh.vertices[t[2]])};
    fillTriangle(corners, shaded, layer, depth);
  }
  blend(layer, depth, opacity);
}

void ViewCanvas::addSolidBox(const RoiBox& box,
                             const cv::Vec3b& color,
                             double opacity) {
  addMesh(meshBox(box), color, opacity);
  addWireBox(box, color * 0.8, 1);
}

void ViewCanvas::addWireBox(const RoiBox& box, const cv::Vec3b& color, int width) {
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4})
      if ((i & bit) == 0) {
        const Eigen::Vector3d a = project(cornerOf(box, i));
        const Eigen::Vector3d b = project(cornerOf(box, i | bit));
        cv::line(picture_,
                 cv::Point2d(a.x(), a.y()),
                 cv::Point2d(b.x(), b.y()),
                 cv::Scalar(color),
                 width,
                 cv::LINE_AA);
      }
}

} // namespace pcl_sq::app

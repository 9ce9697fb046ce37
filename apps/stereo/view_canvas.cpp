// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/view_canvas.h"

#include "pcl_sq/oriented_box.h"
#include "pcl_sq/visibility.h"

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace pcl_sq::app {
namespace {

constexpr float FAR = std::numeric_limits<float>::infinity();
const cv::Vec3b CANVAS_PAPER(248, 246, 244);
const cv::Vec3b TINTS[] = {{60, 110, 235},
                           {200, 140, 50},
                           {90, 170, 60},
                           {170, 80, 170},
                           {60, 190, 220},
                           {180, 170, 60}};

/** \brief \a a at 0, \a b at 1. */
cv::Vec3b mixed(const cv::Vec3b& a, const cv::Vec3b& b, double share) {
  cv::Vec3b result;
  for (int k = 0; k < 3; ++k)
    result[k] = cv::saturate_cast<std::uint8_t>((1.0 - share) * a[k] + share * b[k]);
  return result;
}

Eigen::Vector3d cornerOf(const RoiBox& box, int i) {
  return {i & 1 ? box.max.x() : box.min.x(),
          i & 2 ? box.max.y() : box.min.y(),
          i & 4 ? box.max.z() : box.min.z()};
}

} // namespace

cv::Vec3b partTint(std::size_t part) {
  return TINTS[part % std::size(TINTS)];
}

ViewCanvas::ViewCanvas(const cv::Size& size,
                       const RoiBox& focus,
                       double turn,
                       double tilt)
    : picture_(size, CV_8UC3, cv::Scalar(CANVAS_PAPER)), depth_(size, CV_32F, FAR) {
  const Eigen::Matrix3d to_camera = (Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitX()) *
                                     Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY()))
                                        .toRotationMatrix();
  camera_.rotation = to_camera.transpose();
  const double distance = 3.5 * focus.sizes().norm();
  camera_.center = focus.center() - distance * camera_.rotation.col(2);
  // the turned box, with a little air, fills the picture
  double right = 1e-6, up = 1e-6;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d p = to_camera * (cornerOf(focus, i) - focus.center());
    right = std::max(right, std::abs(p.x()) / (p.z() + distance));
    up = std::max(up, std::abs(p.y()) / (p.z() + distance));
  }
  camera_.fx = camera_.fy = 0.44 * std::min(size.width / right, size.height / up);
  camera_.cx = 0.5 * size.width;
  camera_.cy = 0.5 * size.height;
}

ViewCanvas::ViewCanvas(const cv::Mat& image, const PinholeCamera& camera)
    : picture_(image.clone()), depth_(image.size(), CV_32F, FAR), camera_(camera) {}

Eigen::Vector3d ViewCanvas::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector2d pixel = camera_.project(point);
  return {pixel.x(), pixel.y(), camera_.depthOf(point)};
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

template <typename ColorOf>
void ViewCanvas::drawMesh(const TriangleMesh& mesh,
                          const ColorOf& color_of,
                          double opacity) {
  cv::Mat layer(picture_.size(), CV_8UC3), depth(picture_.size(), CV_32F, FAR);
  const Eigen::Vector3d light = Eigen::Vector3d(-0.4, -0.7, -0.6).normalized();
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d& a = mesh.vertices[t[0]];
    const Eigen::Vector3d normal =
        camera_.rotation.transpose() *
        (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).normalized();
    const double shade = 0.45 + 0.55 * std::max(0.0, normal.dot(light));
    const Eigen::Vector3d corners[] = {
        project(a), project(mesh.vertices[t[1]]), project(mesh.vertices[t[2]])};
    if (std::min({corners[0].z(), corners[1].z(), corners[2].z()}) <= 0.0)
      continue; // behind the camera
    fillTriangle(corners, mixed({0, 0, 0}, color_of(t), shade), layer, depth);
  }
  blend(layer, depth, opacity);
}

void ViewCanvas::addMesh(const TriangleMesh& mesh,
                         const cv::Vec3b& color,
                         double opacity) {
  drawMesh(
      mesh, [&](const std::array<std::uint32_t, 3>&) { return color; }, opacity);
}

void ViewCanvas::addModel(const MultiSuperquadric& model,
                          const Eigen::Vector3d& eye,
                          double opacity) {
  for (std::size_t k = 0; k < model.size(); ++k) {
    const TriangleMesh mesh = meshSuperquadric(model.parts[k]);
    const double slack = 1e-2 * model.parts[k].semi_axes.minCoeff();
    std::vector<int> hidden;
    for (const Eigen::Vector3d& v : mesh.vertices)
      hidden.push_back(isHidden(model, v, eye, slack) ? 1 : 0);
    const cv::Vec3b color = partTint(k), pale = mixed(color, CANVAS_PAPER, 0.62);
    drawMesh(
        mesh,
        [&](const std::array<std::uint32_t, 3>& t) {
          return mixed(color, pale, (hidden[t[0]] + hidden[t[1]] + hidden[t[2]]) / 3.0);
        },
        opacity);
  }
}

void ViewCanvas::addOutlines(const MultiSuperquadric& model) {
  for (std::size_t k = 0; k < model.size(); ++k) {
    const TriangleMesh mesh = meshSuperquadric(model.parts[k], 48);
    std::vector<cv::Point2f> pixels;
    for (const Eigen::Vector3d& v : mesh.vertices)
      if (const Eigen::Vector3d p = project(v); p.z() > 0.0)
        pixels.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
    if (pixels.size() < mesh.vertices.size())
      continue; // reaches behind the camera
    // the outline of a convex body is the hull of its points
    std::vector<int> hull;
    cv::convexHull(pixels, hull);
    const double slack = 0.1 * model.parts[k].semi_axes.minCoeff();
    const cv::Vec3b color = mixed(partTint(k), {0, 0, 0}, 0.15);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const auto a = static_cast<std::size_t>(hull[i]);
      const auto b = static_cast<std::size_t>(hull[(i + 1) % hull.size()]);
      const bool hidden = isHidden(model, mesh.vertices[a], camera_.center, slack) ||
                          isHidden(model, mesh.vertices[b], camera_.center, slack);
      cv::line(picture_,
               pixels[a],
               pixels[b],
               hidden ? mixed(color, CANVAS_PAPER, 0.55) : color,
               hidden ? 1 : 2,
               cv::LINE_AA);
    }
  }
}

void ViewCanvas::addSolidBox(const RoiBox& box,
                             const cv::Vec3b& color,
                             double opacity) {
  addMesh(meshBox(OrientedBox{
              box.center(), Eigen::Matrix3d::Identity(), 0.5 * box.sizes()}),
          color,
          opacity);
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

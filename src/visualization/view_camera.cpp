// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/visualization/view_camera.h"

#include "pcl_sq/exception.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_sq {
namespace {

constexpr std::array<const char*, 5> VIEW_NAMES = {
    "front", "side", "top", "iso", "camera"};
/// Of the ISO view: enough to see a third side and the lid, and still the front most.
constexpr double ISO_AZIMUTH = 35.0 * M_PI / 180.0, ISO_ELEVATION = 22.0 * M_PI / 180.0;

/** \brief Axes of the FRONT view: right, up, forward. For a camera frame these are the
 * camera's own; to the right is +x whichever way is up. */
Eigen::Matrix3d frontAxes(const Eigen::Vector3d& up) {
  Eigen::Matrix3d axes;
  axes.col(1) = up.normalized();
  const Eigen::Vector3d right =
      std::abs(axes(0, 1)) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  axes.col(0) = (right - right.dot(axes.col(1)) * axes.col(1)).normalized();
  axes.col(2) = axes.col(1).cross(axes.col(0));
  return axes;
}

/** \brief Axes that look along \a forward with \a up in the picture's upper half. */
Eigen::Matrix3d lookAlong(const Eigen::Vector3d& forward, const Eigen::Vector3d& up) {
  Eigen::Matrix3d axes;
  axes.col(2) = forward.normalized();
  axes.col(0) = forward.cross(up).normalized();
  axes.col(1) = axes.col(0).cross(axes.col(2));
  return axes;
}

Eigen::AlignedBox3d boxOf(const Eigen::Ref<const Eigen::Matrix3Xd>& points) {
  return {points.rowwise().minCoeff().eval(), points.rowwise().maxCoeff().eval()};
}

/** \brief Extents that can be divided by: a single point gets a centimetre. */
Eigen::Vector2d usable(const Eigen::Vector2d& extent, double magnitude) {
  const double least = 1e-12 * magnitude;
  return extent.maxCoeff() > least ? extent.cwiseMax(1e-6 * extent.maxCoeff())
                                   : Eigen::Vector2d(0.01, 0.01);
}

} // namespace

const char* toString(View view) {
  return VIEW_NAMES.at(static_cast<std::size_t>(view));
}

bool viewFromString(const std::string& name, View* view) {
  const auto found = std::find(VIEW_NAMES.begin(), VIEW_NAMES.end(), name);
  if (found == VIEW_NAMES.end())
    return false;
  *view = static_cast<View>(found - VIEW_NAMES.begin());
  return true;
}

ViewCamera::ViewCamera(const Eigen::Ref<const Eigen::Matrix3Xd>& focus,
                       View view,
                       const Eigen::Vector3d& up,
                       int width,
                       int height,
                       const FrameMargins& margins)
    : ViewCamera(width, height) {
  setAxes(view, up);
  if (view == View::CAMERA)
    framePinhole(focus, margins);
  else
    frameParallel(boxOf(axes_.transpose() * focus), margins);
}

ViewCamera ViewCamera::turntable(const Eigen::Ref<const Eigen::Matrix3Xd>& focus,
                                 View view,
                                 const Eigen::Vector3d& up,
                                 int width,
                                 int height,
                                 const FrameMargins& margins,
                                 double azimuth) {
  // the cylinder around the turning axis that holds the object, as seen from the side
  const Eigen::Matrix3d front = frontAxes(up);
  const Eigen::Matrix3Xd local = front.transpose() * focus;
  const Eigen::AlignedBox3d box = boxOf(local);
  Eigen::Vector3d half = 0.5 * box.sizes();
  const auto offsets = local.colwise() - box.center();
  half.x() = half.z() =
      (offsets.row(0).array().square() + offsets.row(2).array().square()).maxCoeff();
  half.x() = half.z() = std::sqrt(half.x());

  ViewCamera camera(width, height);
  camera.setAxes(view == View::CAMERA ? View::FRONT : view, up);
  // seen from an elevation, the cylinder's rims add to its height
  const double tilt = std::abs(camera.forward().dot(front.col(1)));
  const double level = std::sqrt(std::max(0.0, 1.0 - tilt * tilt));
  const Eigen::Vector3d size(
      half.x(), level * half.y() + tilt * half.x(), level * half.x() + tilt * half.y());
  camera.axes_ = Eigen::AngleAxisd(azimuth, front.col(1)) * camera.axes_;
  const Eigen::Vector3d middle = camera.axes_.transpose() * (front * box.center());
  camera.frameParallel({middle - size, middle + size}, margins);
  return camera;
}

void ViewCamera::setAxes(View view, const Eigen::Vector3d& up) {
  const Eigen::Matrix3d front = frontAxes(up);
  switch (view) {
  case View::FRONT:
    axes_ = front;
    break;
  case View::SIDE:
    axes_ = lookAlong(-front.col(0), front.col(1));
    break;
  case View::TOP:
    axes_ = lookAlong(-front.col(1), front.col(2));
    break;
  case View::ISO:
    axes_ = lookAlong(std::cos(ISO_ELEVATION) * (std::cos(ISO_AZIMUTH) * front.col(2) -
                                                 std::sin(ISO_AZIMUTH) * front.col(0)) -
                          std::sin(ISO_ELEVATION) * front.col(1),
                      front.col(1));
    break;
  case View::CAMERA:
    axes_ = frontAxes(-Eigen::Vector3d::UnitY());
    break;
  }
}

void ViewCamera::frameParallel(const Eigen::AlignedBox3d& box,
                               const FrameMargins& margins) {
  const Eigen::Vector2d extent =
      usable(box.sizes().head<2>(),
             box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff());
  const double room_x = 1.0 - margins.left - margins.right;
  const double room_y = 1.0 - margins.top - margins.bottom;
  pixels_per_meter_ =
      std::min(width_ * room_x / extent.x(), height_ * room_y / extent.y());
  principal_ = {0.5 * width_, 0.5 * height_};
  Eigen::Vector3d eye = box.center();
  eye.x() += 0.5 * width_ * (margins.right - margins.left) / pixels_per_meter_;
  eye.y() += 0.5 * height_ * (margins.top - margins.bottom) / pixels_per_meter_;
  eye.z() -= 2.0 * box.sizes().norm() + extent.maxCoeff();
  position_ = axes_ * eye;
}

void ViewCamera::framePinhole(const Eigen::Ref<const Eigen::Matrix3Xd>& focus,
                              const FrameMargins& margins) {
  if (!(focus.row(2).minCoeff() > 0.0))
    throw Exception("[pcl_sq::ViewCamera] the object is not in front of the camera (z "
                    "> 0), so it has no view 'camera'; choose front, side, top or "
                    "iso.");
  perspective_ = true;
  const Eigen::ArrayXd x = focus.row(0).array() / focus.row(2).array();
  const Eigen::ArrayXd y = focus.row(1).array() / focus.row(2).array();
  const Eigen::Vector2d extent =
      usable({x.maxCoeff() - x.minCoeff(), y.maxCoeff() - y.minCoeff()}, 1.0);
  const double room_x = 1.0 - margins.left - margins.right;
  const double room_y = 1.0 - margins.top - margins.bottom;
  focal_length_ = std::min(width_ * room_x / extent.x(), height_ * room_y / extent.y());
  principal_.x() = width_ * (margins.left + 0.5 * room_x) -
                   focal_length_ * 0.5 * (x.maxCoeff() + x.minCoeff());
  principal_.y() = height_ * (margins.top + 0.5 * room_y) -
                   focal_length_ * 0.5 * (y.maxCoeff() + y.minCoeff());
  pixels_per_meter_ =
      focal_length_ / (0.5 * (focus.row(2).minCoeff() + focus.row(2).maxCoeff()));
}

Eigen::Vector3d ViewCamera::project(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d p = axes_.transpose() * (point - position_);
  const double scale = perspective_ ? focal_length_ / p.z() : pixels_per_meter_;
  return {principal_.x() + scale * p.x(), principal_.y() - scale * p.y(), p.z()};
}

Eigen::Vector3d ViewCamera::toEye(const Eigen::Vector3d& point) const {
  return perspective_ ? Eigen::Vector3d(position_ - point)
                      : Eigen::Vector3d(-axes_.col(2));
}

} // namespace pcl_sq

// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_renderer.h"

#include "scene/noise.h"
#include "scene/threads.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::app {
namespace {

enum class Surface { NOTHING, OBJECT, TABLE, WALL };

struct Sight {
  double t = std::numeric_limits<double>::infinity(); ///< along the ray
  Surface surface = Surface::NOTHING;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< in the rig's frame
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< in the rig's frame
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< where the texture is read
};

/** \brief The scene with what all rays share worked out. */
class Caster {
public:
  Caster(const Scene& scene, const MeshBvh& object) : scene_(scene), object_(object) {
    up_ = scene.table_normal;
    // the table's axes: away from the camera, and across
    away_ = (Eigen::Vector3d::UnitZ() - up_.z() * up_).normalized();
    across_ = away_.cross(up_);
    wall_ = away_.dot(scene.translation) + scene.wall_distance;
    light_ = scene.translation + 1.2 * up_ - 0.6 * away_ - 0.7 * across_;
  }

  Sight look(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) const {
    Sight s;
    const double falling = -up_.dot(ray);
    const double height = up_.dot(origin) + scene_.table_offset;
    if (falling > 0.0) {
      s.t = height / falling;
      s.surface = Surface::TABLE;
      s.normal = up_;
    }
    const double approaching = away_.dot(ray);
    if (const double t = (wall_ - away_.dot(origin)) / approaching;
        approaching > 0.0 && t < s.t) {
      s.t = t;
      s.surface = Surface::WALL;
      s.normal = -away_;
    }
    const Eigen::Vector3d o =
        scene_.rotation.transpose() * (origin - scene_.translation);
    const Eigen::Vector3d d = scene_.rotation.transpose() * ray;
    if (const RayHit hit = object_.intersect(o, d, s.t); hit.found()) {
      s.t = hit.t;
      s.surface = Surface::OBJECT;
      s.normal = scene_.rotation * object_.normal(hit.triangle);
      s.place = o + hit.t * d;
    }
    if (s.surface == Surface::NOTHING)
      return s;
    s.point = origin + s.t * ray;
    if (s.surface != Surface::OBJECT) {
      const Eigen::Vector3d p = s.point - scene_.translation;
      s.place = {across_.dot(p), away_.dot(p), up_.dot(p)};
    }
    return s;
  }

  /** \brief Light that comes back along the ray, red green blue in [0, 1]. */
  Eigen::Vector3d shade(const Sight& s,
                        const Eigen::Vector3d& ray,
                        double pixel_angle,
                        const Eigen::Vector3d& light_jitter) const {
    if (s.surface == Surface::NOTHING)
      return {0.05, 0.05, 0.06};
    const double grazing = std::max(0.1, -s.normal.dot(ray) / ray.norm());
    const double footprint = s.t * pixel_angle / std::sqrt(grazing);
    const Eigen::Vector3d to_light = light_ + light_jitter - s.point;
    double lit = std::max(0.0, s.normal.dot(to_light.normalized()));
    if (lit > 0.0 && s.surface != Surface::WALL && shadowed(s, to_light))
      lit *= 0.25;
    return albedo(s, footprint) * (0.42 + 0.68 * lit);
  }

private:
  bool shadowed(const Sight& s, const Eigen::Vector3d& to_light) const {
    const Eigen::Vector3d from = s.point + 2e-4 * s.normal;
    return object_.occluded(scene_.rotation.transpose() * (from - scene_.translation),
                            scene_.rotation.transpose() * to_light,
                            1.0);
  }

  Eigen::Vector3d albedo(const Sight& s, double footprint) const {
    const double c = scene_.contrast;
    switch (s.surface) {
    case Surface::OBJECT: {
      const double n = solidNoise(s.place, 0.032, 0.0012, footprint, scene_.seed * 64);
      return scene_.color * std::max(0.1, 1.0 + 0.50 * c * n);
    }
    case Surface::TABLE: {
      // wood: long along x, short across
      const Eigen::Vector3d stretched(0.25 * s.place.x(), s.place.y(), s.place.z());
      const double grain =
          solidNoise(stretched, 0.06, 0.004, footprint, scene_.seed * 64 + 16);
      const double speckle =
          solidNoise(s.place, 0.02, 0.0015, footprint, scene_.seed * 64 + 32);
      return Eigen::Vector3d(0.52, 0.40, 0.28) *
             std::max(0.1, 1.0 + c * (0.22 * grain + 0.30 * speckle));
    }
    default: {
      const double n =
          solidNoise(s.place, 0.12, 0.003, footprint, scene_.seed * 64 + 48);
      return Eigen::Vector3d(0.42, 0.43, 0.43) * std::max(0.1, 1.0 + 0.24 * c * n);
    }
    }
  }

  const Scene& scene_;
  const MeshBvh& object_;
  Eigen::Vector3d up_, away_, across_, light_;
  double wall_ = 0.0;
};

std::uint8_t quantise(double linear, double noise) {
  const double grey = 255.0 * std::pow(std::clamp(linear, 0.0, 1.0), 1.0 / 2.2) + noise;
  return static_cast<std::uint8_t>(std::lround(std::clamp(grey, 0.0, 255.0)));
}

} // namespace

Scene placeOnTable(const Eigen::AlignedBox3d& box,
                   const Eigen::Vector3d& center,
                   double yaw,
                   double pitch) {
  Scene scene;
  scene.table_normal = {0.0, -std::cos(pitch), -std::sin(pitch)};
  const Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Matrix3d upright; // columns: right, away, up
  upright << right, scene.table_normal.cross(right), scene.table_normal;
  scene.rotation =
      upright * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  scene.translation = center - scene.rotation * box.center();
  scene.table_offset = -scene.table_normal.dot(scene.translation) - box.min().z();
  return scene;
}

RenderedImage render(const Scene& scene,
                     const MeshBvh& object,
                     const SceneCamera& camera,
                     std::uint64_t view,
                     unsigned int threads) {
  const Caster caster(scene, object);
  const int n = std::max(1, scene.supersampling);
  const double pixel_angle = 1.0 / camera.fx / n;
  RenderedImage image;
  image.width = camera.width;
  image.height = camera.height;
  image.bgr.resize(3 * static_cast<std::size_t>(camera.width) *
                   static_cast<std::size_t>(camera.height));
#pragma omp parallel for schedule(dynamic, 4) num_threads(threadCount(threads))
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const auto pixel = static_cast<std::uint64_t>(v) * camera.width + u;
      const std::uint64_t key = mixBits(scene.seed * 1024 + view) + 16 * pixel;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int sample = 0; sample < n * n; ++sample) {
        const int row = sample / n, column = sample % n;
        const double du = (column + 0.5) / n - 0.5, dv = (row + 0.5) / n - 0.5;
        const Eigen::Vector3d ray = camera.ray(u + du, v + dv);
        // a lamp of 6 cm: soft shadows
        const Eigen::Vector3d jitter =
            0.06 * Eigen::Vector3d(uniformOf(mixBits(key + 8) + sample) - 0.5,
                                   uniformOf(mixBits(key + 9) + sample) - 0.5,
                                   uniformOf(mixBits(key + 10) + sample) - 0.5);
        sum +=
            caster.shade(caster.look(camera.position, ray), ray, pixel_angle, jitter);
      }
      sum /= n * n;
      for (int c = 0; c < 3; ++c)
        image.bgr[3 * pixel + static_cast<std::uint64_t>(c)] =
            quantise(sum[2 - c], scene.noise_sigma * normalOf(key + c));
    }
  return image;
}

RenderedTruth renderTruth(const Scene& scene,
                          const MeshBvh& object,
                          const SceneCamera& camera,
                          unsigned int threads) {
  const Caster caster(scene, object);
  RenderedTruth truth;
  truth.width = camera.width;
  truth.height = camera.height;
  const auto count =
      static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  truth.depth.resize(count);
  truth.mask.resize(count);
#pragma omp parallel for schedule(dynamic, 4) num_threads(threadCount(threads))
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const auto pixel =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width) +
          static_cast<std::size_t>(u);
      const Sight s = caster.look(camera.position, camera.ray(u, v));
      truth.depth[pixel] = static_cast<float>(s.t); // rays have z = 1
      truth.mask[pixel] = s.surface == Surface::OBJECT ? 255 : 0;
    }
  int left = camera.width, right = -1, top = camera.height, bottom = -1;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u)
      if (truth.mask[static_cast<std::size_t>(v) *
                         static_cast<std::size_t>(camera.width) +
                     static_cast<std::size_t>(u)] != 0) {
        ++truth.visible_pixels;
        left = std::min(left, u);
        right = std::max(right, u);
        top = std::min(top, v);
        bottom = std::max(bottom, v);
      }
  if (truth.visible_pixels > 0)
    truth.roi = {left, top, right - left + 1, bottom - top + 1};
  return truth;
}

} // namespace pcl_sq::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/stereo/stereo_reprojector.h"
#include "scene/objects.h"
#include "scene/scene_renderer.h"

#include <opencv2/core.hpp>

#include <cmath>
#include <fstream>
#include <string>

namespace pcl_sq::test {

/** \brief A small rendered scene with its truth. */
struct StereoScene {
  app::SceneObject object;
  app::Scene scene;
  app::StereoRig rig;
  cv::Mat left, right; ///< BGR
  cv::Mat disparity;   ///< exact, CV_32F [px]
  cv::Mat mask;        ///< exact, 255 = object
  CellRect roi;
  StereoIntrinsics intrinsics;
};

inline cv::Mat toMat(app::RenderedImage image) {
  return cv::Mat(image.height, image.width, CV_8UC3, image.bgr.data()).clone();
}

/** \param[in] seed of the textures and the noise */
inline StereoScene renderScene(const std::string& name,
                               double noise = 1.0,
                               std::uint64_t seed = 1,
                               int scale = 1) {
  StereoScene s;
  s.object = app::makeObject(name);
  s.rig = app::makeRig(320 * scale, 240 * scale, 405.8 * scale, 0.12);
  const Eigen::Vector3d center(0.0, 0.0, s.object.distance);
  s.scene = app::placeOnTable(s.object.box(), center, s.object.yaw, 0.17);
  s.scene.color = s.object.color;
  s.scene.noise_sigma = noise;
  s.scene.seed = seed;
  const app::MeshBvh mesh(s.object.mesh);
  s.left = toMat(app::render(s.scene, mesh, s.rig.left, 0));
  s.right = toMat(app::render(s.scene, mesh, s.rig.right, 1));
  const app::RenderedTruth truth = app::renderTruth(s.scene, mesh, s.rig.left);
  s.roi = truth.roi;
  s.disparity.create(truth.height, truth.width, CV_32F);
  s.mask.create(truth.height, truth.width, CV_8U);
  s.intrinsics.width = truth.width;
  s.intrinsics.height = truth.height;
  s.intrinsics.fx = s.intrinsics.fy = s.rig.left.fx;
  s.intrinsics.cx = s.rig.left.cx;
  s.intrinsics.cy = s.rig.left.cy;
  s.intrinsics.baseline = s.rig.baseline;
  for (int i = 0; i < truth.width * truth.height; ++i) {
    const auto k = static_cast<std::size_t>(i);
    s.disparity.ptr<float>()[i] =
        static_cast<float>(s.intrinsics.disparity(truth.depth[k]));
    s.mask.ptr<std::uint8_t>()[i] = truth.mask[k];
  }
  return s;
}

/** \brief Little-endian one-channel PFM, rows from the bottom. */
inline cv::Mat readPfm(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string magic;
  int width = 0, height = 0;
  double scale = 0.0;
  in >> magic >> width >> height >> scale;
  in.get();
  cv::Mat m(height, width, CV_32F);
  for (int v = height - 1; v >= 0; --v)
    in.read(reinterpret_cast<char*>(m.ptr(v)), 4 * static_cast<std::streamsize>(width));
  return m;
}

/** \brief Intersection over union of two boxes. */
inline double overlap(const CellRect& a, const CellRect& b) {
  const cv::Rect p(a.x, a.y, a.width, a.height), q(b.x, b.y, b.width, b.height);
  const double both = (p & q).area();
  return both / (p.area() + q.area() - both);
}

/** \brief Pixels (255) whose match lies in the right image and behind nothing that the
 * left image shows: the usual definition of "not occluded", from the left truth alone.
 */
inline cv::Mat visibleInRight(const cv::Mat& truth) {
  cv::Mat visible = cv::Mat::zeros(truth.size(), CV_8U);
  std::vector<float> nearest;
  for (int v = 0; v < truth.rows; ++v) {
    nearest.assign(static_cast<std::size_t>(truth.cols) + 1, 0.0f);
    const auto match = [&](int u) {
      return static_cast<float>(u) - truth.at<float>(v, u);
    };
    const auto known = [&](int u) {
      return std::isfinite(truth.at<float>(v, u)) && truth.at<float>(v, u) > 0.0f &&
             match(u) >= 0.0f;
    };
    for (int u = 0; u < truth.cols; ++u)
      if (known(u))
        for (const float x : {std::floor(match(u)), std::floor(match(u)) + 1.0f}) {
          float& d = nearest[static_cast<std::size_t>(x)];
          d = std::max(d, truth.at<float>(v, u));
        }
    for (int u = 0; u < truth.cols; ++u) // a slant may change by a pixel
      if (known(u) &&
          truth.at<float>(v, u) >
              nearest[static_cast<std::size_t>(std::lround(match(u)))] - 1.0f)
        visible.at<std::uint8_t>(v, u) = 255;
  }
  return visible;
}

/** \brief Median error and share of matched pixels, where \a truth is known. */
struct DisparityError {
  double median = 0.0, coverage = 0.0;
};
inline DisparityError
compareDisparity(const cv::Mat& disparity, const cv::Mat& truth, const cv::Mat& mask) {
  std::vector<float> errors;
  std::size_t known = 0;
  for (int v = 0; v < truth.rows; ++v)
    for (int u = 0; u < truth.cols; ++u) {
      const float t = truth.at<float>(v, u), d = disparity.at<float>(v, u);
      if (!std::isfinite(t) || t <= 0.0f || mask.at<std::uint8_t>(v, u) != 255)
        continue;
      ++known;
      if (!std::isnan(d))
        errors.push_back(std::abs(d - t));
    }
  DisparityError e;
  if (errors.empty())
    return e;
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  e.median = *middle;
  e.coverage = static_cast<double>(errors.size()) / static_cast<double>(known);
  return e;
}

} // namespace pcl_sq::test

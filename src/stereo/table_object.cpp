// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/table_object.h"

#include <opencv2/imgproc.hpp>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_perpendicular_plane.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_sq::detail {
namespace {

using Plane = Eigen::Vector4f; // n.p + d = 0, the camera on the positive side
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** \brief Every step-th pixel of an organized cloud. */
struct Grid {
  int step = 1, width = 0, height = 0;
  Cloud::Ptr points{new Cloud}; ///< width x height, NaN where there is none
  pcl::Indices finite;
};

Grid thinned(const pcl::PointCloud<pcl::PointXYZRGB>& cloud) {
  constexpr double MOST_POINTS = 60000.0; // enough to find an object
  Grid g;
  g.step = std::max(
      1, static_cast<int>(std::ceil(std::sqrt(double(cloud.size()) / MOST_POINTS))));
  g.width = static_cast<int>(cloud.width) / g.step;
  g.height = static_cast<int>(cloud.height) / g.step;
  for (int v = 0; v < g.height; ++v)
    for (int u = 0; u < g.width; ++u) {
      const pcl::PointXYZRGB& p = cloud.at(u * g.step, v * g.step);
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
        g.finite.push_back(static_cast<pcl::index_t>(g.points->size()));
      g.points->emplace_back(p.x, p.y, p.z);
    }
  return g;
}

float medianDepth(const Grid& g) {
  std::vector<float> depths;
  for (const pcl::index_t i : g.finite)
    depths.push_back((*g.points)[static_cast<std::size_t>(i)].z);
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

/** \brief Largest plane whose normal is within \a angle of the camera's up. */
bool findPlane(const Grid& g, double tolerance, double angle, Plane& plane) {
  using Model = pcl::SampleConsensusModelPerpendicularPlane<pcl::PointXYZ>;
  const Model::Ptr model(new Model(g.points, g.finite));
  model->setAxis(-Eigen::Vector3f::UnitY());
  model->setEpsAngle(angle);
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, tolerance);
  ransac.setMaxIterations(500);
  ransac.setProbability(0.999);
  if (!ransac.computeModel())
    return false;
  pcl::Indices inliers;
  Eigen::VectorXf coefficients, refined;
  ransac.getInliers(inliers);
  ransac.getModelCoefficients(coefficients);
  model->optimizeModelCoefficients(inliers, coefficients, refined);
  plane = refined[3] < 0.0f ? Plane(-refined) : Plane(refined);
  return inliers.size() >= g.finite.size() / 20;
}

/** \brief Patches of points above the plane, cut at depth jumps; 0 = none. */
cv::Mat labelPatches(const Grid& g, const Plane& plane, float tolerance, int* count) {
  constexpr float HIGHEST = 0.8f; // above the table [m]
  constexpr float JUMP = 0.025f;  // of the depth, between neighbours
  constexpr int REACH = 2;        // bridges a missing pixel
  cv::Mat labels = cv::Mat::zeros(g.height, g.width, CV_32S);
  const auto above = [&](int u, int v) {
    const auto& p = (*g.points)[static_cast<std::size_t>(v * g.width + u)];
    const float h = plane.head<3>().dot(p.getVector3fMap()) + plane[3];
    return h > tolerance && h < HIGHEST; // false for NaN
  };
  *count = 0;
  std::vector<cv::Point> stack;
  for (const pcl::index_t i : g.finite) {
    const cv::Point seed(i % g.width, i / g.width);
    if (labels.at<int>(seed) != 0 || !above(seed.x, seed.y))
      continue;
    labels.at<int>(seed) = ++*count;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const cv::Point at = stack.back();
      stack.pop_back();
      const float z = (*g.points)[static_cast<std::size_t>(at.y * g.width + at.x)].z;
      for (int v = std::max(0, at.y - REACH); v <= std::min(g.height - 1, at.y + REACH);
           ++v)
        for (int u = std::max(0, at.x - REACH);
             u <= std::min(g.width - 1, at.x + REACH);
             ++u) {
          int& label = labels.at<int>(v, u);
          if (label != 0 || !above(u, v))
            continue;
          const float other = (*g.points)[static_cast<std::size_t>(v * g.width + u)].z;
          if (std::abs(other - z) > JUMP * z)
            continue;
          label = *count;
          stack.emplace_back(u, v);
        }
    }
  }
  return labels;
}

/** \brief What speaks for a patch: its size, if it keeps off the image's border. */
int bestPatch(const cv::Mat& labels, int count) {
  std::vector<int> size(static_cast<std::size_t>(count) + 1, 0), rim = size;
  for (int v = 0; v < labels.rows; ++v)
    for (int u = 0; u < labels.cols; ++u) {
      const auto label = static_cast<std::size_t>(labels.at<int>(v, u));
      ++size[label];
      const bool border =
          u <= 1 || v <= 1 || u >= labels.cols - 2 || v >= labels.rows - 2;
      rim[label] += border ? 1 : 0;
    }
  const int least = std::max(20, labels.rows * labels.cols / 2000);
  int best = 0, best_size = 0;
  for (const bool inner_only : {true, false}) {
    for (int k = 1; k <= count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (size[i] >= least && size[i] > best_size && (!inner_only || rim[i] == 0)) {
        best = k;
        best_size = size[i];
      }
    }
    if (best != 0)
      return best;
  }
  return best;
}

} // namespace

bool findTableObject(const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                     cv::Mat& mask,
                     std::string& why) {
  constexpr double STEEP = 50.0 * M_PI / 180.0;
  const Grid g = thinned(cloud);
  if (g.finite.size() < 100) {
    why = "the cloud has hardly any point; check the stereo images";
    return false;
  }
  const float tolerance = 0.008f * medianDepth(g);
  Plane plane;
  if (!findPlane(g, tolerance, STEEP, plane) &&
      !findPlane(g, tolerance, 0.5 * M_PI, plane)) {
    why = "there is no table, that is no large plane; give a hint where the object is";
    return false;
  }
  int count = 0;
  const cv::Mat labels = labelPatches(g, plane, tolerance, &count);
  const int best = bestPatch(labels, count);
  if (best == 0) {
    why = "nothing stands on the largest plane; give a hint where the object is";
    return false;
  }
  const cv::Mat small = labels == best;
  cv::resize(small, mask, {}, g.step, g.step, cv::INTER_NEAREST);
  cv::copyMakeBorder(mask,
                     mask,
                     0,
                     static_cast<int>(cloud.height) - mask.rows,
                     0,
                     static_cast<int>(cloud.width) - mask.cols,
                     cv::BORDER_CONSTANT);
  const cv::Mat square =
      cv::getStructuringElement(cv::MORPH_RECT, {2 * g.step + 1, 2 * g.step + 1});
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, square);
  return true;
}

} // namespace pcl_sq::detail

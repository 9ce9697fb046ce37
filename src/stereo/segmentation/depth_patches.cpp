// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/segmentation/depth_patches.h"

#include <opencv2/imgproc.hpp>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_perpendicular_plane.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_sq::detail {

DepthGrid::DepthGrid(const pcl::PointCloud<pcl::PointXYZRGB>& cloud,
                     const cv::Rect& window_in)
    : window(window_in), points(new pcl::PointCloud<pcl::PointXYZ>) {
  constexpr double MOST_CELLS = 60000.0;
  step = std::max(
      1, static_cast<int>(std::ceil(std::sqrt(double(window.area()) / MOST_CELLS))));
  width = window.width / step;
  height = window.height / step;
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const pcl::PointXYZRGB& p = cloud.at(window.x + u * step, window.y + v * step);
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
        finite.push_back(static_cast<pcl::index_t>(points->size()));
      points->emplace_back(p.x, p.y, p.z);
    }
}

float DepthGrid::medianDepth() const {
  std::vector<float> depths;
  for (const pcl::index_t i : finite)
    depths.push_back((*points)[static_cast<std::size_t>(i)].z);
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return *middle;
}

cv::Mat DepthGrid::toPixels(const cv::Mat& cells) const {
  cv::Mat mask;
  cv::resize(cells, mask, {}, step, step, cv::INTER_NEAREST);
  cv::copyMakeBorder(mask,
                     mask,
                     0,
                     window.height - mask.rows,
                     0,
                     window.width - mask.cols,
                     cv::BORDER_CONSTANT);
  const cv::Mat square =
      cv::getStructuringElement(cv::MORPH_RECT, {2 * step + 1, 2 * step + 1});
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, square);
  return mask;
}

bool findPlane(const DepthGrid& grid,
               const pcl::Indices& cells,
               double tolerance,
               double angle,
               double least,
               DepthPlane& plane) {
  if (cells.size() < 10)
    return false;
  using Model = pcl::SampleConsensusModelPerpendicularPlane<pcl::PointXYZ>;
  const Model::Ptr model(new Model(grid.points, cells));
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
  plane = refined[3] < 0.0f ? DepthPlane(-refined) : DepthPlane(refined);
  return static_cast<double>(inliers.size()) >=
         least * static_cast<double>(cells.size());
}

cv::Mat labelPatches(const DepthGrid& grid,
                     const std::vector<DepthPlane>& planes,
                     float tolerance,
                     int* count) {
  constexpr float JUMP = 0.025f; // of the depth, between neighbours
  constexpr int REACH = 2;       // bridges a missing pixel
  cv::Mat labels = cv::Mat::zeros(grid.height, grid.width, CV_32S);
  const auto counts = [&](int u, int v) {
    const auto& p = grid.at(u, v);
    return std::isfinite(p.z) &&
           std::all_of(planes.begin(), planes.end(), [&](const DepthPlane& plane) {
             return plane.head<3>().dot(p.getVector3fMap()) + plane[3] > tolerance;
           });
  };
  *count = 0;
  std::vector<cv::Point> stack;
  for (const pcl::index_t i : grid.finite) {
    const cv::Point seed(i % grid.width, i / grid.width);
    if (labels.at<int>(seed) != 0 || !counts(seed.x, seed.y))
      continue;
    labels.at<int>(seed) = ++*count;
    stack.assign(1, seed);
    while (!stack.empty()) {
      const cv::Point at = stack.back();
      stack.pop_back();
      const float z = grid.at(at.x, at.y).z;
      const int right = std::min(grid.width - 1, at.x + REACH);
      const int bottom = std::min(grid.height - 1, at.y + REACH);
      for (int v = std::max(0, at.y - REACH); v <= bottom; ++v)
        for (int u = std::max(0, at.x - REACH); u <= right; ++u) {
          int& label = labels.at<int>(v, u);
          if (label != 0 || !counts(u, v) || std::abs(grid.at(u, v).z - z) > JUMP * z)
            continue;
          label = *count;
          stack.emplace_back(u, v);
        }
    }
  }
  return labels;
}

} // namespace pcl_sq::detail

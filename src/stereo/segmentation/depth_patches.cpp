// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/segmentation/depth_patches.h"

#include <opencv2/imgproc.hpp>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_normal_parallel_plane.h>

#include <algorithm>
#include <cmath>
#include <iterator>
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
  findNormals();
  findSteps();
  findFolds();
}

// Inverse depths of a plane are linear over the rays x/z, y/z: of the line through
// those of a matcher's window the slopes and the height are the normal.
void DepthGrid::findNormals() {
  constexpr int SIDE = 9; // of the window that disparities are refined in [px]
  enum { ONE, X, Y, W, XX, XY, YY, XW, YW, SUMS };
  const int side = side_ = 2 * std::max(1, (SIDE / 2 + step / 2) / step) + 1;
  std::vector<cv::Mat> sums;
  for (int k = 0; k < SUMS; ++k)
    sums.emplace_back(cv::Mat::zeros(height, width, CV_64F));
  for (const pcl::index_t i : finite) {
    const pcl::PointXYZ& p = (*points)[static_cast<std::size_t>(i)];
    const double w = 1.0 / double(p.z), x = double(p.x) * w, y = double(p.y) * w;
    const double values[SUMS] = {1.0, x, y, w, x * x, x * y, y * y, x * w, y * w};
    for (int k = 0; k < SUMS; ++k)
      sums[std::size_t(k)].ptr<double>()[i] = values[k];
  }
  for (cv::Mat& s : sums)
    cv::boxFilter(s, s, CV_64F, {side, side}, {-1, -1}, false, cv::BORDER_CONSTANT);
  normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>(
      static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height));
  for (const pcl::index_t i : finite) {
    const auto sum = [&](int k) { return sums[std::size_t(k)].ptr<double>()[i]; };
    const double n = sum(ONE);
    if (n < 0.5 * side * side) // of half a window one knows nothing across it
      continue;
    const Eigen::Vector2d mean(sum(X) / n, sum(Y) / n);
    Eigen::Matrix2d square;
    square << sum(XX), sum(XY), sum(XY), sum(YY);
    square -= n * mean * mean.transpose();
    const double w = sum(W) / n;
    const Eigen::Vector2d slope =
        square.ldlt().solve(Eigen::Vector2d(sum(XW), sum(YW)) - n * w * mean);
    const Eigen::Vector3d normal =
        -Eigen::Vector3d(slope.x(), slope.y(), w - slope.dot(mean)).normalized();
    if (normal.allFinite())
      (*normals)[std::size_t(i)].getNormalVector3fMap() = normal.cast<float>();
  }
}

void DepthGrid::findSteps() {
  // of a ball's outline nothing but the outermost 6 % of its radius is steeper
  const auto steepest = float(std::cos(70.0 * M_PI / 180.0));
  steps_ = cv::Mat::zeros(height, width, CV_8U);
  for (const pcl::index_t i : finite) {
    const auto n = (*normals)[std::size_t(i)].getNormalVector3fMap();
    const auto p = (*points)[std::size_t(i)].getVector3fMap();
    if (!n.isZero() && -n.dot(p.normalized()) < steepest)
      steps_.ptr<std::uint8_t>()[i] = 255;
  }
}

float DepthGrid::medianDepth() const {
  return medianDepths(cv::Mat::zeros(height, width, CV_32S), 0).front();
}

std::vector<float> DepthGrid::medianDepths(const cv::Mat& labels, int count) const {
  std::vector<std::vector<float>> depths(static_cast<std::size_t>(count) + 1);
  for (const pcl::index_t i : finite)
    depths[static_cast<std::size_t>(labels.ptr<int>()[i])].push_back(
        (*points)[static_cast<std::size_t>(i)].z);
  std::vector<float> medians;
  for (std::vector<float>& d : depths) {
    const auto middle = d.begin() + static_cast<std::ptrdiff_t>(d.size() / 2);
    std::nth_element(d.begin(), middle, d.end());
    medians.push_back(d.empty() ? 0.0F : *middle);
  }
  return medians;
}

cv::Mat DepthGrid::hiddenToTheLeft(const cv::Mat& object, double scale) const {
  cv::Mat hidden = cv::Mat::zeros(height, width, CV_8U);
  for (int v = 0; v < height; ++v)
    for (int u = 1; u < width; ++u) {
      if (object.at<std::uint8_t>(v, u) == 0 || std::isfinite(at(u - 1, v).z))
        continue;
      int left = u - 1;
      while (left >= 0 && !std::isfinite(at(left, v).z))
        --left;
      if (left < 0)
        continue;
      const double reach =
          scale * (1.0 / double(at(u, v).z) - 1.0 / double(at(left, v).z)) / step;
      const int first = std::max(left + 1, u - static_cast<int>(std::max(0.0, reach)));
      hidden(cv::Range(v, v + 1), cv::Range(first, u)).setTo(255);
    }
  return hidden;
}

float DepthGrid::angle() const {
  const auto row = [this](pcl::index_t i) { return i / width; };
  const pcl::index_t first = finite.front(), last = finite.back();
  const pcl::PointXYZ& a = (*points)[std::size_t(first)];
  const pcl::PointXYZ& b = (*points)[std::size_t(last)];
  return (b.y / b.z - a.y / a.z) / float(std::max(1, row(last) - row(first)));
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

float DepthGrid::foldAt(int u, int v) const {
  const auto cell = [this](int x, int y) {
    return std::size_t(y) * std::size_t(width) + std::size_t(x);
  };
  const int r = side_ / 2 + 1; // windows to both sides have nothing in common
  float likeness = 1.0F;       // of the normals that differ most
  for (const cv::Point d : {cv::Point(r, 0), {0, r}, {r, r}, {r, -r}}) {
    const int u1 = u - d.x, v1 = v - d.y, u2 = u + d.x, v2 = v + d.y;
    if (std::min({u1, v1, u2, v2}) < 0 || std::max(u1, u2) >= width ||
        std::max(v1, v2) >= height)
      continue;
    const auto n1 = (*normals)[cell(u1, v1)].getNormalVector3fMap();
    const auto n2 = (*normals)[cell(u2, v2)].getNormalVector3fMap();
    if (n1.isZero() || n2.isZero() || isStep(u1, v1) || isStep(u2, v2))
      continue;
    const Eigen::Vector3f apart =
        at(u2, v2).getVector3fMap() - at(u1, v1).getVector3fMap();
    if ((n2 - n1).dot(apart) < 0.0F)
      likeness = std::min(likeness, n1.dot(n2));
  }
  return std::acos(std::max(-1.0F, likeness));
}

void DepthGrid::findFolds() {
  constexpr float ANGLE = 0.35F; // that parts things in scenes too (M25) [rad]
  folds_ = cv::Mat::zeros(height, width, CV_32F);
  std::vector<float> angles;
  for (const pcl::index_t i : finite) {
    const float fold = foldAt(i % width, i / width);
    folds_.ptr<float>()[i] = fold;
    angles.push_back(fold);
  }
  least_fold_ = ANGLE;
  if (angles.empty())
    return;
  const auto middle = angles.begin() + std::ptrdiff_t(angles.size() / 2);
  std::nth_element(angles.begin(), middle, angles.end());
  least_fold_ = std::max(ANGLE, 3.0F * *middle);
}

bool findPlane(const DepthGrid& grid,
               const pcl::Indices& cells,
               double tolerance,
               double angle,
               double least,
               DepthPlane& plane) {
  const auto fewest = std::max(10.0, least * static_cast<double>(cells.size()));
  pcl::Indices level;
  std::copy_if(
      cells.begin(), cells.end(), std::back_inserter(level), [&](pcl::index_t i) {
        const float up = (*grid.normals)[static_cast<std::size_t>(i)].normal_y;
        return std::abs(up) >= static_cast<float>(std::cos(angle));
      });
  if (static_cast<double>(level.size()) < fewest)
    return false;
  // of three faces that meet at right angles each is farther than this from the others
  constexpr double ALIKE = 30.0 * M_PI / 180.0;
  using Model =
      pcl::SampleConsensusModelNormalParallelPlane<pcl::PointXYZ, pcl::Normal>;
  const Model::Ptr model(new Model(grid.points, level));
  model->setInputNormals(grid.normals);
  model->setNormalDistanceWeight(tolerance / ALIKE);
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
  return static_cast<double>(inliers.size()) >= fewest;
}

cv::Mat labelPatches(const DepthGrid& grid,
                     const std::vector<DepthPlane>& planes,
                     float tolerance,
                     int* count) {
  constexpr float JUMP = 0.025f; // of the depth, between neighbours
  constexpr int REACH = 1;       // neighbours: what is farther lies beyond a step
  cv::Mat labels = cv::Mat::zeros(grid.height, grid.width, CV_32S);
  cv::Mat counts = cv::Mat::zeros(grid.height, grid.width, CV_8U);
  for (const pcl::index_t i : grid.finite) {
    const int u = i % grid.width, v = i / grid.width;
    const auto p = grid.at(u, v).getVector3fMap();
    if (!grid.isStep(u, v) && !grid.isFold(u, v) &&
        std::all_of(planes.begin(), planes.end(), [&](const DepthPlane& plane) {
          return plane.head<3>().dot(p) + plane[3] > tolerance;
        }))
      counts.ptr<std::uint8_t>()[i] = 255;
  }
  *count = 0;
  std::vector<cv::Point> stack;
  for (const pcl::index_t i : grid.finite) {
    const cv::Point seed(i % grid.width, i / grid.width);
    if (labels.at<int>(seed) != 0 || counts.at<std::uint8_t>(seed) == 0)
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
          if (label != 0 || counts.at<std::uint8_t>(v, u) == 0 ||
              std::abs(grid.at(u, v).z - z) > JUMP * z)
            continue;
          label = *count;
          stack.emplace_back(u, v);
        }
    }
  }
  return labels;
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "scene/one_body.h"

#include "pcl_sq/view_fit.h"
#include "scene/superpixels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t MOST_POINTS = 150; ///< of a body; neighbours share their errors
constexpr double CORRELATION = 7.0;      ///< side of the square that shares them [px]
/** \brief Things are no superquadrics: see fit_object.cpp. */
constexpr double MODEL_ERROR = 0.01;
constexpr int STARTS = 3;

/** \brief Some of the pixels, evenly. */
Eigen::Matrix3Xd sample(const SceneView& view, const std::vector<int>& pixels) {
  const std::size_t step = std::max<std::size_t>(1, pixels.size() / MOST_POINTS);
  std::vector<int> chosen;
  for (std::size_t i = 0; i < pixels.size(); i += step)
    chosen.push_back(pixels[i]);
  Eigen::Matrix3Xd points(3, Eigen::Index(chosen.size()));
  for (std::size_t i = 0; i < chosen.size(); ++i)
    points.col(Eigen::Index(i)) = view.at(chosen[i]);
  return points;
}

double halfDiagonal(const Eigen::Matrix3Xd& points) {
  return 0.5 * (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

} // namespace

double gainOfOneBody(const SceneView& view,
                     const std::vector<int>& first,
                     const std::vector<int>& second) {
  std::vector<int> both = first;
  both.insert(both.end(), second.begin(), second.end());
  const std::array<Eigen::Matrix3Xd, 3> points = {
      sample(view, first), sample(view, second), sample(view, both)};
  const std::array<std::size_t, 3> pixels = {first.size(), second.size(), both.size()};
  const double z = points[2].row(2).mean();
  const double size = halfDiagonal(points[2]);
  const double noise = std::hypot(depthNoise(view) * z * z, MODEL_ERROR * size);
  const double price =
      std::log(1.0 + double(both.size()) / (CORRELATION * CORRELATION));
  ViewEvidence evidence;
  evidence.viewpoint = Eigen::Vector3d::Zero();
  evidence.up = view.table.normal;
  TangentPlane below;
  below.normal = -view.table.normal;
  below.offset = view.table.offset;
  below.sigma = std::max(view.table.sigma, 1e-3);
  evidence.limits.push_back(below);
  std::array<double, 3> scores{};
  for (std::size_t k = 0; k < 3; ++k) {
    ViewFitOptions options;
    options.noise = noise;
    options.effective_points =
        std::max(12.0, double(pixels[k]) / (CORRELATION * CORRELATION));
    options.max_semi_axis = 1.5 * halfDiagonal(points[k]);
    options.starts = STARTS;
    options.taper = false;
    options.bend = false; // too dear for a question that points alone decide
    const ViewFit fit = fitView(points[k], evidence, options);
    // too few points for a body are too few to be a thing
    if (!fit.fit.ok())
      return k == 2 ? -1e9 : 1e9;
    scores[k] = fit.chosen.cost + price * fit.chosen.parameters;
  }
  return scores[0] + scores[1] - scores[2];
}

} // namespace pcl_sq::detail

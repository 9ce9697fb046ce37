// SPDX-License-Identifier: BSD-3-Clause
#include "patches/one_body.h"

#include "patches/superpixels.h"
#include "pcl_sq/view_fit.h"

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr std::size_t MOST_POINTS = 150; ///< of a body; neighbours share their errors
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

BodyScore scoreOfBody(const SceneView& view, const std::vector<int>& pixels) {
  const Eigen::Matrix3Xd points = sample(view, pixels);
  const double z = points.row(2).mean();
  const double size = halfDiagonal(points);
  BodyScore score;
  score.noise = std::hypot(depthNoise(view) * z * z, MODEL_ERROR * size);
  score.count = std::max(12.0, double(pixels.size()) / (CORRELATION * CORRELATION));
  ViewEvidence evidence;
  evidence.viewpoint = Eigen::Vector3d::Zero();
  evidence.up = view.table.normal;
  TangentPlane below;
  below.normal = -view.table.normal;
  below.offset = view.table.offset;
  below.sigma = std::max(view.table.sigma, 1e-3);
  evidence.limits.push_back(below);
  ViewFitOptions options;
  options.noise = score.noise;
  options.effective_points = score.count;
  options.max_semi_axis = 1.5 * size;
  options.starts = STARTS;
  options.taper = false;
  options.bend = false; // too dear for a question that points alone decide
  const ViewFit fit = fitView(points, evidence, options);
  score.fits = fit.fit.ok();
  score.squares = fit.chosen.cost * score.noise * score.noise;
  score.parameters = fit.chosen.parameters;
  score.is_vessel = fit.chosen.shape == ShapeClass::VESSEL;
  return score;
}

double
gainOfOneBody(const BodyScore& first, const BodyScore& second, const BodyScore& both) {
  // too few points for a body are too few to be a thing
  if (!both.fits)
    return -1e9;
  if (!first.fits || !second.fits)
    return 1e9;
  const double count = first.count + second.count;
  const double apart = first.squares + second.squares;
  // what not even a body for each explains is no evidence for either (M15)
  const double square = std::max(both.noise * both.noise, apart / count);
  return (apart - both.squares) / square +
         std::log(1.0 + count) *
             (first.parameters + second.parameters - both.parameters);
}

} // namespace pcl_sq::detail

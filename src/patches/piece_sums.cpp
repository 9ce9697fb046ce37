// SPDX-License-Identifier: BSD-3-Clause
// What the pixels of a piece are in the mean, and what is seen where two meet.
#include "patches/superpixels.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr double CHROMA_STEP = 0.03; ///< shares of red, green, blue that are told apart
constexpr double LIGHT_STEP = 0.7;   ///< logarithm: light and shade of one colour

} // namespace

Eigen::Vector4f shadeOf(const Eigen::Vector3d& color) {
  const double sum = color.sum() + 3.0; // black has no colour
  Eigen::Vector4f shade;
  shade.head<3>() = (color / (sum * CHROMA_STEP)).cast<float>();
  shade[3] = float(std::log(sum) / LIGHT_STEP);
  return shade;
}

void PieceSums::add(const PieceSums& other) {
  count += other.count;
  point += other.point;
  square += other.square;
  color += other.color;
}

void Border::add(const Border& other) {
  pairs += other.pairs;
  jumps += other.jumps;
  fold += other.fold;
}

Eigen::Vector3d PieceSums::normal() const {
  const Eigen::Vector3d middle = mean();
  const Eigen::Matrix3d spread = square / count - middle * middle.transpose();
  const Eigen::Vector3d n =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  return n.dot(middle) > 0.0 ? Eigen::Vector3d(-n) : n;
}

double colorDistance(const PieceSums& a, const PieceSums& b) {
  const Eigen::Vector4f off = shadeOf(a.color / a.count) - shadeOf(b.color / b.count);
  return double(off.norm());
}

double depthNoise(const SceneView& view) {
  // where the ray through the image's middle meets the table
  const double towards = -view.table.normal.z();
  const double there = towards > 0.2 ? view.table.offset / towards : 1.0;
  return view.table.noise / std::max(towards, 0.2) / std::max(there * there, 1e-6);
}

} // namespace pcl_sq::detail

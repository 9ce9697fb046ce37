// SPDX-License-Identifier: BSD-3-Clause
#include "observe/point_spread.h"

#include "sensor/local_quadric.h"
#include "tuning/observe_tuning.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

using namespace tuning::point_spread;

/** \brief Mean distance of the logarithms to their median: a small face of a box counts
 * as well, which the median distance would not see. */
double deviation(const std::vector<double>& values) {
  constexpr std::size_t AT_ONCE = 4; // ratios whose product stays a number
  const double middle = median(values);
  double sum = 0.0, product = 1.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double ratio = values[i] / middle;
    product *= std::max(ratio, 1.0 / ratio);
    if (i % AT_ONCE == AT_ONCE - 1 || i + 1 == values.size()) {
      sum += std::log(product);
      product = 1.0;
    }
  }
  return sum / double(values.size());
}

/** \brief A direction, how uneven the points' number per pixel is from there, and how
 * far the points face it together or turn away from it together [0, 1]. */
struct Look {
  Eigen::Vector3d direction;
  double uneven;
  double facing;
};

double leastOf(const std::vector<Look>& looks) {
  double least = 1e300;
  for (const Look& look : looks)
    least = std::min(least, look.uneven);
  return least;
}

/** \brief The mean of directions by their odds, opposite ones taken as one. Of errors
 * that fall off exponentially, of unknown size, the odds are a power of the unevenness:
 * where several directions are nearly as even, the best of them is chance. A box's
 * three sides are spread alike for four of them, as the cosines have no sign: of such
 * only those count that the sides face together. */
Eigen::Vector3d likelyAxis(const std::vector<Look>& looks, double independent) {
  const double least = leastOf(looks);
  double facing = 0.0;
  for (const Look& look : looks)
    if (look.uneven < MORE * least)
      facing = std::max(facing, look.facing);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Look& look : looks)
    if (look.facing > facing - TOGETHER)
      sum += std::pow(least / look.uneven, independent) * look.direction *
             look.direction.transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(2);
}

} // namespace

PointSpread::PointSpread(const Eigen::Matrix3Xd& points) {
  const Eigen::Index n = points.cols();
  if (n < tuning::point_spread::FEWEST)
    return;
  Neighbourhood neighbourhood(points);
  const Eigen::Index step = std::max<Eigen::Index>(1, n / PATCHES);
  Eigen::AlignedBox3d box;
  std::vector<double> densities;
  for (Eigen::Index i = 0; i < n; i += step)
    if (const std::optional<Patch> patch =
            patchOf(points, i, neighbourhood.of(i, AROUND_IT))) {
      patches_.push_back(*patch);
      densities.push_back(patch->density);
      box.extend(patch->place);
    }
  if (Eigen::Index(patches_.size()) < tuning::point_spread::FEWEST)
    return;
  const double distance = FAR * 0.5 * box.diagonal().norm();
  middle_.setZero();
  for (const Patch& patch : patches_)
    middle_ += patch.place / double(patches_.size());
  std::vector<Look> looks;
  const auto look = [&](const Eigen::Vector3d& direction) {
    // the opposite one is as even
    const Eigen::Vector3d place = box.center() + distance * direction;
    looks.push_back({direction, unevenness(place), facing(place)});
  };
  for (int i = 0; i < DIRECTIONS; ++i) {
    // Fibonacci's spiral: about equally many everywhere on the sphere
    const double z = 1.0 - (2.0 * i + 1.0) / DIRECTIONS;
    const double turn = i * 2.399963229728653; // the golden angle
    const double r = std::sqrt(1.0 - z * z);
    look({r * std::cos(turn), r * std::sin(turn), z});
  }
  const double independent = std::min(
      double(patches_.size()), double(n) / double(tuning::point_spread::NEIGHBOURS));
  const Eigen::Vector3d rough = likelyAxis(looks, independent);
  const Eigen::Vector3d across = rough.unitOrthogonal();
  least_ = leastOf(looks);
  looks.clear();
  for (int i = 0; i < AROUND; ++i) {
    const double turn = i * 2.399963229728653;
    const double away = SPACING * std::sqrt((i + 0.5) / AROUND);
    look((rough +
          away * (std::cos(turn) * across + std::sin(turn) * rough.cross(across)))
             .normalized());
  }
  least_ = std::min(least_, leastOf(looks));
  if (!(least_ < deviation(densities)))
    return;
  const Eigen::Vector3d best = likelyAxis(looks, independent);
  std::vector<double> bulges;
  for (const Patch& patch : patches_)
    bulges.push_back(patch.normal.dot(best) > 0.0 ? patch.bulge : -patch.bulge);
  direction_ = median(std::move(bulges)) > 0.0 ? best : -best;
}

std::optional<PointSpread::Patch>
PointSpread::patchOf(const Eigen::Matrix3Xd& points,
                     Eigen::Index middle,
                     const std::vector<Eigen::Index>& near) {
  const auto meanOf = [&](std::size_t begin, std::size_t end) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (std::size_t k = begin; k < end; ++k)
      mean += points.col(near[k]) / double(end - begin);
    return mean;
  };
  const Eigen::Vector3d mean = meanOf(0, PLANE);
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < PLANE; ++k) {
    const Eigen::Vector3d d = points.col(near[k]) - mean;
    square += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(square);
  const double reach =
      (points.col(near[tuning::point_spread::NEIGHBOURS]) - points.col(middle))
          .squaredNorm();
  if (!(reach > 0.0) || eigen.info() != Eigen::Success)
    return std::nullopt;
  const Eigen::Vector3d normal = eigen.eigenvectors().col(0);
  return Patch{points.col(middle),
               normal,
               1.0 / reach,
               normal.dot(mean - meanOf(PLANE, near.size()))};
}

double PointSpread::unevenness(const Eigen::Vector3d& place) const {
  std::vector<double> in_image;
  in_image.reserve(patches_.size());
  for (const Patch& patch : patches_) {
    const Eigen::Vector3d ray = patch.place - place;
    const double square = std::max(ray.squaredNorm(), 1e-18);
    const double cosine = std::abs(patch.normal.dot(ray)) / std::sqrt(square);
    in_image.push_back(patch.density * square / std::max(cosine, GRAZING));
  }
  return deviation(in_image);
}

double PointSpread::facing(const Eigen::Vector3d& place) const {
  double sum = 0.0, known = 0.0;
  for (const Patch& patch : patches_) {
    const double outside = patch.normal.dot(patch.place - middle_);
    if (std::abs(outside) < ASIDE * (patch.place - middle_).norm())
      continue; // of a flat thing nobody knows which side is outside
    known += 1.0;
    sum += outside * patch.normal.dot(place - patch.place) > 0.0 ? 1.0 : -1.0;
  }
  return known > 0.0 ? std::abs(sum) / known : 1.0;
}

bool PointSpread::allows(const Eigen::Vector3d& place) const {
  return !direction_ || unevenness(place) < MORE * least_;
}

} // namespace pcl_sq::detail

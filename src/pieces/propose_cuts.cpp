// SPDX-License-Identifier: BSD-3-Clause
// M18: where an object may consist of two parts: where its width changes at once.
#include "pieces/piece.h"
#include "tuning/parts_tuning.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl_sq::detail {

namespace {

constexpr int BINS = 40;
using namespace tuning::propose_cuts;

/** \brief One point on its way along an axis. */
struct Station {
  double along, across;
};

/** \brief A profile along an axis: one value per bin. */
using Profile = std::vector<double>;

/** \brief Widths of the bins; a bin with hardly a point has its neighbour's. */
Profile widths(const std::vector<std::vector<double>>& across) {
  Profile width(BINS, 0.0);
  for (int b = 0; b < BINS; ++b) {
    std::vector<double> v = across[std::size_t(b)];
    if (v.size() < 3) {
      width[b] = b > 0 ? width[b - 1] : 0.0;
      continue;
    }
    std::sort(v.begin(), v.end());
    const std::size_t cut = v.size() / 20;
    width[b] = v[v.size() - 1 - cut] - v[cut];
  }
  return width;
}

/** \brief Points in the bins: a hole shows here, not in the width. */
Profile counts(const std::vector<std::vector<double>>& across) {
  Profile count;
  for (const std::vector<double>& v : across)
    count.push_back(double(v.size()));
  return count;
}

/** \brief Adds the bins at whose lower end a profile jumps most. */
void addJumps(const Profile& profile, double smallest, std::vector<int>& taken) {
  std::vector<std::pair<double, int>> strength;
  for (int b = tuning::propose_cuts::MARGIN; b <= BINS - tuning::propose_cuts::MARGIN;
       ++b) {
    double before = 0.0, after = 0.0;
    int n = 0, m = 0;
    for (int k = 1; k <= WINDOW; ++k) {
      if (b - k >= 0)
        before += profile[b - k], ++n;
      if (b + k - 1 < BINS)
        after += profile[b + k - 1], ++m;
    }
    strength.emplace_back(std::abs(before / n - after / m), b);
  }
  std::sort(strength.rbegin(), strength.rend());
  const double limit = smallest * *std::max_element(profile.begin(), profile.end());
  int added = 0;
  for (const auto& [value, b] : strength) {
    if (added == PER_AXIS || value < limit)
      break;
    if (std::all_of(taken.begin(), taken.end(), [b = b](int t) {
          return std::abs(t - b) > WINDOW;
        })) {
      taken.push_back(b);
      ++added;
    }
  }
}

/** \brief Positions of the largest relative jumps of the width and, for an outline, of
 * the number of pixels. */
std::vector<double> jumps(const std::vector<Station>& stations, bool outline) {
  std::vector<double> positions;
  double low = 1e300, high = -1e300;
  for (const Station& s : stations) {
    low = std::min(low, s.along);
    high = std::max(high, s.along);
  }
  if (!(high > low))
    return positions;
  std::vector<std::vector<double>> across(BINS);
  for (const Station& s : stations)
    across[std::min(BINS - 1, int(BINS * (s.along - low) / (high - low)))].push_back(
        s.across);
  std::vector<int> taken;
  addJumps(widths(across), SMALLEST_JUMP, taken);
  if (outline)
    addJumps(counts(across), SMALLEST_GAP, taken);
  for (const int b : taken)
    positions.push_back(low + (high - low) * b / BINS);
  return positions;
}

/** \brief Cuts along lines of the image. */
std::vector<Cut> imageCuts(const PieceContext& context, const Piece& piece) {
  const PinholeCamera& camera = context.observed.camera;
  std::vector<Cut> cuts;
  if (piece.pixels.size() < 20)
    return cuts;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector2d& p : piece.pixels)
    mean += p / double(piece.pixels.size());
  for (const Eigen::Vector2d& p : piece.pixels)
    square += (p - mean) * (p - mean).transpose();
  const Eigen::Matrix2d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(square).eigenvectors();
  std::vector<Eigen::Vector2d> axes;
  const auto add = [&axes](const Eigen::Vector2d& axis) {
    for (const Eigen::Vector2d& other : axes)
      if (std::abs(other.dot(axis)) > 0.996)
        return;
    axes.push_back(axis);
  };
  if (context.observed.table) {
    const Eigen::Vector3d at =
        camera.center + context.observed.depth * camera.ray(mean);
    const Eigen::Vector2d up =
        (camera.project(at + 0.01 * context.observed.depth *
                                 context.observed.table->normal) -
         camera.project(at));
    if (up.norm() > 1e-6) {
      add(up.normalized());
      add(Eigen::Vector2d(-up.y(), up.x()).normalized());
    }
  }
  add(principal.col(1));
  add(principal.col(0));
  std::vector<Station> stations(piece.pixels.size());
  for (const Eigen::Vector2d& axis : axes) {
    const Eigen::Vector2d across(-axis.y(), axis.x());
    for (std::size_t i = 0; i < stations.size(); ++i)
      stations[i] = {axis.dot(piece.pixels[i]), across.dot(piece.pixels[i])};
    for (const double position : jumps(stations, true)) {
      SilhouetteLine line;
      line.direction = axis;
      line.offset = position;
      const TangentPlane plane = tangentPlane(camera, line, 1.0, 1.0);
      cuts.push_back({plane.normal, plane.offset});
    }
  }
  return cuts;
}

/** \brief Cuts across axes in space. */
std::vector<Cut> spaceCuts(const PieceContext& context, const Piece& piece) {
  const auto& points = context.observed.points;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  for (const int i : piece.points)
    mean += points.col(i) / double(piece.points.size());
  for (const int i : piece.points)
    square += (points.col(i) - mean) * (points.col(i) - mean).transpose();
  const Eigen::Matrix3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(square).eigenvectors();
  std::vector<Cut> cuts;
  std::vector<Eigen::Vector3d> axes;
  std::vector<Eigen::Matrix3d> frames = {principal};
  if (piece.fit.fit.ok())
    frames.push_back(piece.fit.fit.model.rotation);
  std::vector<Station> stations(piece.points.size());
  for (const Eigen::Matrix3d& frame : frames)
    for (int k = 2; k >= 0; --k) {
      const Eigen::Vector3d axis = frame.col(k);
      bool known = false;
      for (const Eigen::Vector3d& other : axes)
        known = known || std::abs(other.dot(axis)) > 0.99;
      if (known)
        continue;
      axes.push_back(axis);
      std::vector<double> positions;
      for (int j = 1; j <= 2; ++j) {
        const Eigen::Vector3d across = frame.col((k + j) % 3);
        for (std::size_t i = 0; i < stations.size(); ++i) {
          const Eigen::Vector3d p = points.col(piece.points[i]) - mean;
          stations[i] = {axis.dot(p), across.dot(p)};
        }
        for (const double position : jumps(stations, false))
          positions.push_back(position);
      }
      std::sort(positions.begin(), positions.end());
      double last = -1e300;
      for (const double position : positions) {
        if (position - last > 0.03 * context.observed.extent)
          cuts.push_back({axis, position + axis.dot(mean)});
        last = position;
      }
    }
  return cuts;
}

} // namespace

std::vector<Cut> proposeCuts(const PieceContext& context, const Piece& piece) {
  return context.observed.hasCamera() ? imageCuts(context, piece)
                                      : spaceCuts(context, piece);
}

} // namespace pcl_sq::detail

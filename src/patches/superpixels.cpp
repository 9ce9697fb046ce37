// SPDX-License-Identifier: BSD-3-Clause
// Superpixels as Achanta et al. (SLIC, PAMI 2012) make them, with depth beside colour.
#include "patches/superpixels.h"

#include "patches/pixel_normals.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace pcl_sq::detail {

namespace {

constexpr int SEED_STEP = 9; ///< pixels between the seeds
constexpr int ROUNDS = 4;    ///< of assignment; more change little
constexpr int REACH = 2;     ///< pixels across which pieces touch: missing ones between
constexpr double SIGMAS = 3.0; ///< of the depth's noise: more is a jump

constexpr float TURN = 0.35F; ///< of a normal: a fold that may part things [rad]

/** \brief A colour in steps that tell colours apart. */
using Shade = Eigen::Vector4f;

struct Seed {
  Eigen::Vector3f at = Eigen::Vector3f::Zero(); ///< pixel and depth
  Shade shade = Shade::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero(); ///< zero: not known
  float count = 0.0F;
};

/** \brief The assignment of pixels to seeds on a grid. */
class Divider {
public:
  Divider(const SceneView& view, const CellMask& pixels)
      : view_(view), pixels_(pixels), noise_(depthNoise(view)),
        columns_((view.width + SEED_STEP - 1) / SEED_STEP),
        rows_((view.height + SEED_STEP - 1) / SEED_STEP) {
    seeds_.resize(std::size_t(columns_) * std::size_t(rows_));
    for (std::size_t i = 0; i < pixels.cells.size(); ++i)
      if (pixels.cells[i])
        set_.push_back(int(i));
    of_pixel_.assign(pixels.cells.size(), -1);
    shades_.resize(pixels.cells.size(), Shade::Zero());
    normals_ = pixelNormals(view, pixels, SIGMAS * noise_);
    for (const int c : set_) {
      of_pixel_[std::size_t(c)] = cellOf(c);
      shades_[std::size_t(c)] = shadeOf(view.colors.col(c).cast<double>());
    }
  }

  std::vector<int> run() {
    update();
    for (int round = 0; round < ROUNDS; ++round) {
      for (const int c : set_)
        assign(c);
      update();
    }
    return connected();
  }

private:
  int cellOf(int c) const {
    return (c / view_.width) / SEED_STEP * columns_ + (c % view_.width) / SEED_STEP;
  }
  void update() {
    for (Seed& s : seeds_)
      s = {};
    for (std::size_t i = 0; i < set_.size(); ++i) {
      const int c = set_[i];
      const int x = c % view_.width, y = c / view_.width;
      Seed& s = seeds_[std::size_t(of_pixel_[std::size_t(c)])];
      s.at += Eigen::Vector3f(float(x), float(y), view_.points(2, c));
      s.shade += shades_[std::size_t(c)];
      s.normal += normals_.col(c);
      s.count += 1.0F;
    }
    for (Seed& s : seeds_)
      if (s.count > 0.0F) {
        s.at /= s.count;
        s.shade /= s.count;
        s.normal.normalize();
      }
  }
  void assign(int c) {
    const int x = c % view_.width, y = c / view_.width;
    const float z = view_.points(2, c);
    const Eigen::Vector3f at{float(x), float(y), z};
    const auto along = 1.0F / float(2.0 * SEED_STEP * z / view_.camera.fx +
                                    2.0 * noise_ * double(z) * double(z));
    const Eigen::Vector3f scale{1.0F / SEED_STEP, 1.0F / SEED_STEP, along};
    float best = 1e30F;
    for (int j = std::max(0, y / SEED_STEP - 1);
         j <= std::min(rows_ - 1, y / SEED_STEP + 1);
         ++j)
      for (int i = std::max(0, x / SEED_STEP - 1);
           i <= std::min(columns_ - 1, x / SEED_STEP + 1);
           ++i) {
        const Seed& s = seeds_[std::size_t(j) * std::size_t(columns_) + std::size_t(i)];
        if (s.count == 0.0F)
          continue;
        float d = (at - s.at).cwiseProduct(scale).squaredNorm() +
                  0.25F * (shades_[std::size_t(c)] - s.shade).squaredNorm();
        if (!normals_.col(c).isZero())
          d += (normals_.col(c) - s.normal).squaredNorm() / (TURN * TURN);
        if (d < best) {
          best = d;
          of_pixel_[std::size_t(c)] = j * columns_ + i;
        }
      }
  }
  /** \brief Each connected set of pixels of one seed as a piece; scraps go to the piece
   * that they touch most. */
  std::vector<int> connected() const {
    std::vector<int> piece(of_pixel_.size(), -1), size;
    std::vector<int> queue;
    for (const int start : set_) {
      if (piece[std::size_t(start)] >= 0)
        continue;
      const int number = int(size.size());
      queue.assign(1, start);
      piece[std::size_t(start)] = number;
      for (std::size_t i = 0; i < queue.size(); ++i)
        forNeighbours(queue[i], [&](int d) {
          if (piece[std::size_t(d)] < 0 &&
              of_pixel_[std::size_t(d)] == of_pixel_[std::size_t(start)]) {
            piece[std::size_t(d)] = number;
            queue.push_back(d);
          }
        });
      size.push_back(int(queue.size()));
    }
    constexpr int SCRAP = SEED_STEP * SEED_STEP / 6;
    for (int pass = 0; pass < 2; ++pass)
      for (const int c : set_) {
        if (size[std::size_t(piece[std::size_t(c)])] >= SCRAP)
          continue;
        int best = -1;
        double least = 1e300;
        forNeighbours(c, [&](int d) {
          const int other = piece[std::size_t(d)];
          if (size[std::size_t(other)] < SCRAP)
            return;
          const double off =
              double(
                  (shades_[std::size_t(c)] - shades_[std::size_t(d)]).squaredNorm()) +
              std::pow(double(view_.points(2, c) - view_.points(2, d)) /
                           (SIGMAS * noise_ * std::pow(double(view_.points(2, c)), 2)),
                       2);
          if (off < least) {
            least = off;
            best = other;
          }
        });
        if (best >= 0)
          piece[std::size_t(c)] = best;
      }
    return piece;
  }
  template <typename Use>
  void forNeighbours(int c, const Use& use) const {
    const int x = c % view_.width, y = c / view_.width;
    if (pixels_(x - 1, y))
      use(c - 1);
    if (pixels_(x + 1, y))
      use(c + 1);
    if (pixels_(x, y - 1))
      use(c - view_.width);
    if (pixels_(x, y + 1))
      use(c + view_.width);
  }

  const SceneView& view_;
  const CellMask& pixels_;
  const double noise_;
  const int columns_, rows_;
  std::vector<int> set_;
  std::vector<int> of_pixel_;
  std::vector<Shade> shades_; ///< of each pixel
  Eigen::Matrix3Xf normals_;
  std::vector<Seed> seeds_;
};

} // namespace

Superpixels divide(const SceneView& view, const CellMask& pixels) {
  Superpixels result;
  result.of_pixel = Divider(view, pixels).run();
  const double noise = depthNoise(view);
  int count = 0;
  std::vector<int> number; // without those that lost all their pixels
  for (int& piece : result.of_pixel) {
    if (piece < 0)
      continue;
    if (piece >= int(number.size()))
      number.resize(std::size_t(piece) + 1, -1);
    int& n = number[std::size_t(piece)];
    if (n < 0)
      n = count++;
    piece = n;
  }
  result.pieces.resize(std::size_t(count));
  for (int c = 0; c < int(result.of_pixel.size()); ++c) {
    const int piece = result.of_pixel[std::size_t(c)];
    if (piece < 0)
      continue;
    PieceSums& sums = result.pieces[std::size_t(piece)];
    const Eigen::Vector3d p = view.at(c);
    sums.count += 1.0;
    sums.point += p;
    sums.square += p * p.transpose();
    sums.color += view.colors.col(c).cast<double>();
  }
  std::vector<Eigen::Vector3d> normals;
  for (const PieceSums& piece : result.pieces)
    normals.push_back(piece.normal());
  std::map<std::pair<int, int>, Border> borders;
  for (int c = 0; c < int(result.of_pixel.size()); ++c) {
    const int piece = result.of_pixel[std::size_t(c)];
    if (piece < 0)
      continue;
    const Eigen::Vector3d p = view.at(c);
    const int x = c % view.width, y = c / view.width;
    for (int far = 1; far <= REACH; ++far)
      for (const int step : {1, view.width}) {
        if ((step == 1 ? x : y) + far >= (step == 1 ? view.width : view.height))
          continue;
        const int d = c + far * step;
        const int other = result.of_pixel[std::size_t(d)];
        // a nearer neighbour says it better
        if (other < 0 || other == piece ||
            (far == 2 && result.of_pixel[std::size_t(c) + std::size_t(step)] >= 0))
          continue;
        Border& border = borders[std::minmax(piece, other)];
        const double z = std::min(p.z(), double(view.points(2, d)));
        const double slope = STEEPEST * far * z / view.camera.fx;
        const double error = SIGMAS * noise * z * z;
        const Eigen::Vector3d across = view.at(d) - p;
        // off both surfaces: a limb before what is close behind it
        const double off = std::min(std::abs(normals[std::size_t(piece)].dot(across)),
                                    std::abs(normals[std::size_t(other)].dot(across)));
        ++border.pairs;
        border.jumps += std::abs(across.z()) > slope + error || off > error;
      }
  }
  for (auto& [pair, border] : borders) {
    const auto a = std::size_t(pair.first), b = std::size_t(pair.second);
    const Eigen::Vector3d off = normals[a] - normals[b];
    const double angle = std::acos(std::clamp(normals[a].dot(normals[b]), -1.0, 1.0));
    const Eigen::Vector3d along = result.pieces[b].mean() - result.pieces[a].mean();
    const double fold = off.dot(along) > 0.0 ? angle : -angle;
    border.fold = (border.pairs - border.jumps) * fold;
  }
  result.borders.assign(borders.begin(), borders.end());
  return result;
}

} // namespace pcl_sq::detail

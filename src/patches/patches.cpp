// SPDX-License-Identifier: BSD-3-Clause
#include "patches/patches.h"

#include "sensor/observation.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace pcl_sq::detail {

namespace {

constexpr double ALIKE_COLOR = 1.0; ///< of colorDistance(), neighbours'
constexpr double SAME_PATCH = 1.5;  ///< of whole patches
constexpr double STRAYS = 0.02;     ///< of a patch's pixels

constexpr double FEW = 0.1; ///< of a line's pixels that may be errors

constexpr int APART = 8;             ///< pixels, as far as a halo reaches
constexpr int RIM = 3;               ///< pixels that matching windows fatten things by
constexpr double LEAST_INSIDE = 0.1; ///< of the pixels of what is more than a rim

class DisjointSets {
public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int root(int i) {
    while (parent_[std::size_t(i)] != i) {
      int& up = parent_[std::size_t(i)];
      up = parent_[std::size_t(up)];
      i = up;
    }
    return i;
  }
  void join(int root, int into) { parent_[std::size_t(root)] = into; }

private:
  std::vector<int> parent_;
};

void measure(const SceneView& view, Patch& patch) {
  std::vector<double> heights;
  heights.reserve(patch.pixels.size());
  for (const int c : patch.pixels)
    heights.push_back(view.table.height(view.at(c)));
  const auto quantile = [&heights](double share) {
    const auto place =
        heights.begin() + std::ptrdiff_t(share * double(heights.size() - 1));
    std::nth_element(heights.begin(), place, heights.end());
    return *place;
  };
  patch.low = quantile(STRAYS);
  patch.high = quantile(1.0 - STRAYS);
}

Eigen::Vector2d pixelOf(int c, int width) {
  const int row = c / width;
  return {double(c % width), double(row)};
}

int nearestTo(const Patch& patch, const Eigen::Vector2d& place, int width) {
  return *std::min_element(patch.pixels.begin(), patch.pixels.end(), [&](int c, int d) {
    return (pixelOf(c, width) - place).squaredNorm() <
           (pixelOf(d, width) - place).squaredNorm();
  });
}

int highest(const SceneView& view, const Patch& patch) {
  int best = patch.pixels.front();
  double most = -1e300;
  for (const int c : patch.pixels)
    if (const double height = view.table.height(view.at(c));
        height > most && height <= patch.high) { // but strays
      most = height;
      best = c;
    }
  return best;
}

/** \brief What lies on a line of the image between two pixels of two patches. */
Between along(const SceneView& view, int from, int to, const CellMask& own) {
  const Eigen::Vector2d begin = pixelOf(from, view.width),
                        end = pixelOf(to, view.width);
  const auto nearest = double(std::min(view.points(2, from), view.points(2, to)));
  const int steps = std::max(1, int((end - begin).cwiseAbs().maxCoeff()));
  int occluder = 0, other = 0;
  for (int k = 1; k < steps; ++k) {
    const Eigen::Vector2d at = begin + double(k) / steps * (end - begin);
    const int x = int(std::lround(at.x())), y = int(std::lround(at.y()));
    const int c = y * view.width + x;
    if (own(x, y) || !view.finite(c))
      continue;
    const Eigen::Vector3d p = view.at(c);
    const double slack = standingHeight(view.table, p.z());
    // the table before two things hides neither
    ++(p.z() < nearest - slack && view.table.height(p) > slack ? occluder : other);
  }
  Between gap;
  gap.background = double(other) > FEW * double(steps);
  gap.hidden = !gap.background && occluder > 0;
  return gap;
}

} // namespace

Footprint footprintOf(const TableModel& table, const Patch& patch) {
  Footprint f;
  const Eigen::Vector3d n = table.normal, middle = patch.sums.mean();
  const Eigen::Matrix3d spread =
      patch.sums.square / patch.sums.count - middle * middle.transpose();
  const double across = std::max(0.0, spread.trace() - n.dot(spread * n));
  f.middle = middle - table.height(middle) * n;
  f.radius = 2.0 * std::sqrt(across);
  return f;
}

bool isThin(const std::vector<int>& pixels, int width, int height) {
  CellMask mask(width, height);
  for (const int c : pixels)
    mask.cells[std::size_t(c)] = 1;
  std::size_t inside = 0;
  for (const int c : pixels) {
    const int x = c % width, y = c / width;
    inside +=
        mask(x - RIM, y) && mask(x + RIM, y) && mask(x, y - RIM) && mask(x, y + RIM);
  }
  return double(inside) < LEAST_INSIDE * double(pixels.size());
}

std::vector<int> withoutStrays(const std::vector<int>& pixels, int width, int height) {
  CellMask left((width - 1) / APART + 1, (height - 1) / APART + 1);
  const auto cellOf = [&](int c) {
    return left.indexOf(c % width / APART, c / width / APART);
  };
  std::vector<int> inside(left.cells.size(), 0); // pixels of each cell
  for (const int c : pixels) {
    left.cells[cellOf(c)] = 1;
    ++inside[cellOf(c)];
  }
  std::vector<bool> is_stray(left.cells.size(), false);
  std::vector<std::pair<int, int>> piece;
  const auto take = [&](int x, int y) {
    if (!left(x, y))
      return;
    left.cells[left.indexOf(x, y)] = 0;
    piece.emplace_back(x, y);
  };
  for (const int c : pixels) {
    piece.clear();
    take(c % width / APART, c / width / APART);
    int count = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const auto [x, y] = piece[i];
      count += inside[left.indexOf(x, y)];
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          take(x + dx, y + dy);
    }
    for (const auto& [x, y] : piece)
      is_stray[left.indexOf(x, y)] = double(count) < STRAYS * double(pixels.size());
  }
  std::vector<int> kept;
  std::copy_if(pixels.begin(), pixels.end(), std::back_inserter(kept), [&](int c) {
    return !is_stray[cellOf(c)];
  });
  return kept;
}

Patches patchesOf(const SceneView& view, const Superpixels& superpixels) {
  struct Link {
    int a, b;
    double distance;
  };
  std::vector<Link> links;
  for (const auto& [pair, border] : superpixels.borders) {
    const PieceSums& a = superpixels.pieces[std::size_t(pair.first)];
    const PieceSums& b = superpixels.pieces[std::size_t(pair.second)];
    const double distance = colorDistance(a, b);
    if (distance < ALIKE_COLOR && border.jumps < JUMPS * border.pairs &&
        border.meanFold() < FOLD)
      links.push_back({pair.first, pair.second, distance});
  }
  std::stable_sort(links.begin(), links.end(), [](const Link& a, const Link& b) {
    return a.distance < b.distance;
  });
  DisjointSets sets(superpixels.pieces.size());
  std::vector<PieceSums> sums = superpixels.pieces;
  for (const Link& link : links) {
    const int a = sets.root(link.a), b = sets.root(link.b);
    if (a == b ||
        colorDistance(sums[std::size_t(a)], sums[std::size_t(b)]) > SAME_PATCH)
      continue;
    sets.join(b, a);
    sums[std::size_t(a)].add(sums[std::size_t(b)]);
  }
  Patches patches;
  std::vector<int> number(superpixels.pieces.size(), -1);
  patches.of_pixel.assign(superpixels.of_pixel.size(), -1);
  for (std::size_t c = 0; c < superpixels.of_pixel.size(); ++c) {
    if (superpixels.of_pixel[c] < 0)
      continue;
    const int root = sets.root(superpixels.of_pixel[c]);
    int& n = number[std::size_t(root)];
    if (n < 0) {
      n = int(patches.list.size());
      patches.list.emplace_back();
      patches.list.back().sums = sums[std::size_t(root)];
    }
    patches.of_pixel[c] = n;
    patches.list[std::size_t(n)].pixels.push_back(int(c));
  }
  for (const auto& [pair, border] : superpixels.borders) {
    const int a = number[std::size_t(sets.root(pair.first))];
    const int b = number[std::size_t(sets.root(pair.second))];
    if (a == b)
      continue;
    patches.borders[std::minmax(a, b)].add(border);
  }
  for (Patch& patch : patches.list)
    measure(view, patch);
  return patches;
}

Between between(const SceneView& view, const Patch& a, const Patch& b) {
  CellMask own(view.width, view.height);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const int c : b.pixels)
    middle += pixelOf(c, view.width) / double(b.pixels.size());
  for (const Patch* patch : {&a, &b})
    for (const int c : patch->pixels)
      own.cells[std::size_t(c)] = 1;
  int from = nearestTo(a, middle, view.width);
  const int to = nearestTo(b, pixelOf(from, view.width), view.width);
  from = nearestTo(a, pixelOf(to, view.width), view.width);
  Between gap = along(view, from, to, own);
  gap.apart_above =
      gap.hidden && along(view, highest(view, a), highest(view, b), own).background;
  return gap;
}

} // namespace pcl_sq::detail

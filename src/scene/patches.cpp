// SPDX-License-Identifier: BSD-3-Clause
#include "scene/patches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl_sq::detail {

namespace {

constexpr double SAME_COLOR = 1.0; ///< of colorDistance(), neighbours'
constexpr double SAME_PATCH = 1.5; ///< of whole patches
constexpr double JUMPS = 0.5;      ///< of a border, at which it is an edge in depth
constexpr double CREASE = 0.7;     ///< angle of normals [rad], concave: a fold
constexpr double STRAYS = 0.02;    ///< of a patch's pixels

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

/** \brief Whether two neighbouring pieces make a fold that opens to the camera. */
bool foldedInwards(const PieceSums& a, const PieceSums& b) {
  const Eigen::Vector3d na = a.normal(), nb = b.normal();
  const Eigen::Vector3d d = (b.mean() - a.mean()).normalized();
  const double angle = std::acos(std::clamp(na.dot(nb), -1.0, 1.0));
  return angle > CREASE && (na - nb).dot(d) > 0.0;
}

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

} // namespace

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
    if (distance < SAME_COLOR && border.jumps < JUMPS * border.pairs &&
        !foldedInwards(a, b))
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
    Border& sum = patches.borders[std::minmax(a, b)];
    sum.pairs += border.pairs;
    sum.jumps += border.jumps;
  }
  for (Patch& patch : patches.list)
    measure(view, patch);
  return patches;
}

} // namespace pcl_sq::detail

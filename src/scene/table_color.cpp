// SPDX-License-Identifier: BSD-3-Clause
#include "scene/table_color.h"

#include "scene/open_ground.h"
#include "sensor/observation.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace pcl_sq::detail {

namespace {

constexpr int CELL = 40;           ///< pixels of the coarse grid: light changes slowly
constexpr float SAME_COLOR = 1.0F; ///< steps of shadeOf()
constexpr float UNEVEN = 2.0F;     ///< steps of shadeOf(), between places of one table
constexpr float LIKE_TABLE = 0.5F; ///< the same of a mean over several pixels, at least
constexpr float OVER_MEDIAN =
    2.2F;                        ///< 99 in 100 of a Gaussian in space, over the median
constexpr float CLEARLY = 0.5F;  ///< of the distance to the table: the thing's own
constexpr double OUTLINED = 0.7; ///< of the outline, that is an edge of the colour
constexpr double HIGHEST = 2.0;  ///< standing heights about the table
constexpr int HALO = 8;          ///< pixels: as far as windows and interpolation reach
constexpr int MISSING = 4;       ///< pixels without depth that are bridged

float hueDistance(const Eigen::Vector4f& a, const Eigen::Vector4f& b) {
  return (a - b).head<3>().norm(); // a shadow darkens the table, no more
}

} // namespace

TableColor::TableColor(const SceneView& view, const CellMask& above) : view_(view) {
  columns_ = (view.width + CELL - 1) / CELL;
  rows_ = (view.height + CELL - 1) / CELL;
  std::vector<int> level; // pixels at the table's height, thin things' among them
  for (int y = 0; y < view.height; y += 2)
    for (int x = 0; x < view.width; x += 2) {
      const int c = y * view.width + x;
      if (!above(x, y) && view.finite(c) &&
          std::abs(view.table.height(view.at(c))) <=
              standingHeight(view.table, double(view.points(2, c))))
        level.push_back(c);
    }
  const bool has_colors = (view.colors.array() !=
                           view.colors.col(0).replicate(1, view.colors.cols()).array())
                              .any();
  if (level.empty() || !has_colors) // no colour is no likeness
    return;
  // most of it is the table: what is far from the middle of all colours is not
  Eigen::Vector4f middle;
  std::vector<float> values(level.size());
  for (int k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < level.size(); ++i)
      values[i] = shadeOf(view.colors.col(level[i]).cast<double>())[k];
    const auto half = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    middle[k] = *half;
  }
  const auto average = [&](const std::vector<int>& pixels) {
    // where little is seen, the middle
    std::vector<Eigen::Vector4f> means(std::size_t(columns_) * std::size_t(rows_),
                                       middle);
    std::vector<float> counts(means.size(), 1.0F);
    for (const int c : pixels) {
      const Eigen::Vector4f shade = shadeOf(view.colors.col(c).cast<double>());
      if (hueDistance(shade, middle) > UNEVEN)
        continue;
      const auto cell = std::size_t(c / view.width / CELL) * std::size_t(columns_) +
                        std::size_t(c % view.width / CELL);
      means[cell] += shade;
      counts[cell] += 1.0F;
    }
    for (std::size_t k = 0; k < means.size(); ++k)
      means[k] /= counts[k];
    return means;
  };
  cells_ = average(level);
  // a saturated colour scatters, and is the table's all the same
  values.clear();
  for (std::size_t i = 0; i < level.size(); i += 7) {
    const int x = level[i] % view.width, y = level[i] / view.width;
    values.push_back(hueDistance(shadeAt(x, y), near(x, y)));
  }
  const auto half = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  like_ = std::max(LIKE_TABLE, OVER_MEDIAN * *half);
  const CellMask around = openGround(above);
  // what things enclose is the table between them, or the floor of a pan
  level.erase(std::remove_if(level.begin(),
                             level.end(),
                             [&](int c) { return !around.cells[std::size_t(c)]; }),
              level.end());
  const std::vector<Eigen::Vector4f> outside = average(level);
  for (std::size_t k = 0; k < cells_.size(); ++k)
    if (hueDistance(cells_[k], outside[k]) > like_)
      cells_[k] = outside[k];
}

Eigen::Vector4f TableColor::near(int x, int y) const {
  return cells_[std::size_t(y / CELL) * std::size_t(columns_) + std::size_t(x / CELL)];
}

Eigen::Vector4f TableColor::shadeAt(int x, int y) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (int v = std::max(0, y - 1); v <= std::min(view_.height - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(view_.width - 1, x + 1); ++u) {
      sum += view_.colors.col(v * view_.width + u).cast<double>();
      count += 1.0;
    }
  return shadeOf(sum / count);
}

std::vector<bool> TableColor::outlined(const LabelImage& labels) const {
  std::vector<int> edges(65536, 0), colored(65536, 0);
  const int w = view_.width;
  for (int y = 1; y + 1 < view_.height && !cells_.empty(); ++y)
    for (int x = 1; x + 1 < w; ++x) {
      const std::uint16_t* at =
          &labels.values[std::size_t(y) * std::size_t(w) + std::size_t(x)];
      if (*at == 0 || (at[-1] > 0 && at[1] > 0 && at[-w] > 0 && at[w] > 0))
        continue;
      ++edges[*at];
      colored[*at] += hueDistance(shadeOf(view_.colors.col(y * w + x).cast<double>()),
                                  near(x, y)) > SAME_COLOR;
    }
  std::vector<bool> result(65536, false);
  for (std::size_t k = 1; k < result.size(); ++k)
    result[k] = edges[k] > 0 && double(colored[k]) > OUTLINED * double(edges[k]);
  return result;
}

std::vector<bool> TableColor::rimsOf(const Patches& patches) const {
  std::vector<bool> rims(patches.list.size(), false);
  if (cells_.empty())
    return rims;
  const auto likeTable = [this](const Patch& patch) {
    const int middle = patch.pixels[patch.pixels.size() / 2];
    return hueDistance(shadeOf(patch.sums.color / patch.sums.count),
                       near(middle % view_.width, middle / view_.width)) < SAME_COLOR;
  };
  for (const auto& [pair, border] : patches.borders) {
    const Patch& a = patches.list[std::size_t(pair.first)];
    const Patch& b = patches.list[std::size_t(pair.second)];
    if (a.pixels.empty() || b.pixels.empty() || likeTable(a) == likeTable(b))
      continue;
    const int alike = likeTable(a) ? pair.first : pair.second;
    rims[std::size_t(alike)] =
        isThin(patches.list[std::size_t(alike)].pixels, view_.width, view_.height);
  }
  return rims;
}

void TableColor::removeHalo(CellMask& pixels) const {
  if (cells_.empty())
    return;
  const int w = view_.width;
  std::vector<int> steps(pixels.cells.size(), 0); // from outside, 0: not reached
  std::deque<int> queue;
  const auto reach = [&](int x, int y, int step) {
    const int c = y * w + x;
    if (!pixels(x, y) || steps[std::size_t(c)] > 0 ||
        hueDistance(shadeAt(x, y), near(x, y)) > LIKE_TABLE)
      return;
    steps[std::size_t(c)] = step;
    queue.push_back(c);
  };
  const auto around = [w](int c, const auto& use) {
    use(c % w - 1, c / w);
    use(c % w + 1, c / w);
    use(c % w, c / w - 1);
    use(c % w, c / w + 1);
  };
  CellMask missing(w, view_.height);
  for (std::size_t c = 0; c < missing.cells.size(); ++c)
    missing.cells[c] = !pixels.cells[c] && !view_.finite(int(c));
  const CellMask gaps = gapsWithin(pixels, missing, MISSING * MISSING);
  const auto ends = [&](int x, int y) { return !pixels(x, y) && !gaps(x, y); };
  for (int y = 0; y < view_.height; ++y)
    for (int x = 0; x < w; ++x)
      if (ends(x - 1, y) || ends(x + 1, y) || ends(x, y - 1) || ends(x, y + 1))
        reach(x, y, 1);
  std::deque<std::pair<int, int>> inside; // with steps that are left, outwards
  while (!queue.empty()) {
    const int c = queue.front();
    queue.pop_front();
    const int step = steps[std::size_t(c)];
    if (step > HALO)
      inside.emplace_back(c, HALO);
    else
      around(c, [&](int x, int y) { reach(x, y, step + 1); });
  }
  while (!inside.empty()) {
    const auto [c, left] = inside.front();
    inside.pop_front();
    const int more = left - 1;
    around(c, [&](int x, int y) {
      if (const int d = y * w + x; pixels(x, y) && steps[std::size_t(d)] > 0) {
        steps[std::size_t(d)] = 0;
        if (more > 0)
          inside.emplace_back(d, more);
      }
    });
    steps[std::size_t(c)] = 0;
  }
  for (std::size_t c = 0; c < steps.size(); ++c)
    if (steps[c] > 0)
      pixels.cells[c] = 0;
}

/** \brief Whether what stands over a low pixel was left out, such as a wall: its foot
 * is no other thing's. */
bool TableColor::isFootOfOther(const LabelImage& labels, int x, int y) const {
  const int foot = y * view_.width + x;
  if (!view_.finite(foot))
    return false;
  const double z = double(view_.points(2, foot));
  const int highest =
      1 + int(2.0 * HIGHEST * standingHeight(view_.table, z) * view_.camera.fy / z);
  for (int v = y - 1; v >= std::max(0, y - highest); --v) {
    const int c = v * view_.width + x;
    if (labels.values[std::size_t(c)] > 0)
      return false;
    if (view_.finite(c) && !isLow(c))
      return view_.table.height(view_.at(c)) > 0.0;
  }
  return false;
}

bool TableColor::isLow(int c) const {
  return std::abs(view_.table.height(view_.at(c))) <
         HIGHEST * standingHeight(view_.table, double(view_.points(2, c)));
}

void TableColor::growFeet(LabelImage& labels) const {
  if (cells_.empty())
    return;
  struct Step {
    int pixel;
    Eigen::Vector4f shade; ///< of the thing where it began to grow
    int missing;           ///< pixels without depth on the way
  };
  std::deque<Step> steps;
  const int w = view_.width, h = view_.height;
  for (int c = 0; c < w * h; ++c)
    if (labels.values[std::size_t(c)] > 0)
      steps.push_back({c, shadeAt(c % w, c / w), 0});
  while (!steps.empty()) {
    const Step step = steps.front();
    steps.pop_front();
    const int x = step.pixel % w, y = step.pixel / w;
    for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
      const int u = x + dx, v = y + dy;
      if (u < 0 || v < 0 || u >= w || v >= h ||
          labels.values[std::size_t(v) * std::size_t(w) + std::size_t(u)] > 0)
        continue;
      const int c = v * w + u;
      const int missing = view_.finite(c) ? 0 : step.missing + 1;
      const bool level = missing > 0 ? missing <= MISSING : isLow(c);
      const Eigen::Vector4f shade = shadeAt(u, v);
      const float from_table = hueDistance(shade, near(u, v));
      if (!level || from_table < like_ ||
          hueDistance(shade, step.shade) > CLEARLY * from_table ||
          isFootOfOther(labels, u, v))
        continue;
      labels.values[std::size_t(c)] = labels.values[std::size_t(step.pixel)];
      steps.push_back({c, step.shade, missing});
    }
  }
}

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "outlines/left_over.h"

#include "outlines/outline_cost.h"
#include "pieces/body_outline.h"
#include "tuning/parts_tuning.h"
#include "union/surface_statistics.h"

#include <algorithm>

namespace pcl_sq::detail {

namespace {

using namespace tuning::shared;
using tuning::outline_gaps::STEP;

/** \brief What each cell costs. */
class Grid {
public:
  explicit Grid(const CellMask& image)
      : width_(image.width / STEP + 1), height_(image.height / STEP + 1),
        worth_(std::size_t(width_ * height_), 0.0) {}

  void add(const Eigen::Vector2d& pixel, double worth) {
    const int x = int(std::lround(pixel.x())) / STEP,
              y = int(std::lround(pixel.y())) / STEP;
    if (has(x, y))
      worth_[indexOf(x, y)] += worth;
  }

  /** \brief Takes what costs something and hangs together out of the grid. */
  void takeFrom(std::size_t first, LeftOver& cluster) {
    std::vector<int> open;
    const auto take = [&](int x, int y) {
      double& worth = worth_[indexOf(x, y)];
      if (!(worth > 0.0))
        return;
      cluster.worth += worth;
      cluster.cells.emplace_back(STEP * x, STEP * y);
      worth = 0.0;
      open.push_back(y * width_ + x);
    };
    take(int(first) % width_, int(first) / width_);
    while (!open.empty()) {
      const int x = open.back() % width_, y = open.back() / width_;
      open.pop_back();
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
          if (has(x + dx, y + dy))
            take(x + dx, y + dy);
    }
  }

  std::size_t size() const { return worth_.size(); }

private:
  std::size_t indexOf(int x, int y) const {
    return std::size_t(y) * std::size_t(width_) + std::size_t(x);
  }
  bool has(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  int width_, height_;
  std::vector<double> worth_;
};

} // namespace

LeftOver leftOver(const PieceContext& context, const std::vector<Piece>& pieces) {
  const ObservedObject& o = context.observed;
  Grid grid(o.pixels);
  for (const Eigen::Vector2d& p : pixelsLeft(context, pieces))
    grid.add(p, contradictionCost(o));
  MultiSuperquadric model;
  for (const Piece& piece : pieces)
    model.parts.push_back(piece.fit.fit.model);
  const std::vector<double> distances =
      smallestResiduals(model, o.points, kernels::Residual::FOOT_POINT);
  const double least =
      std::max(STANDS_OFF * context.noise, tuning::outline_gaps::TOLERANCE * o.extent);
  const double each = MAX_COST * o.effective_points / double(o.points.cols());
  LeftOver most;
  for (int i = 0; i < int(o.points.cols()); ++i)
    if (distances[std::size_t(i)] > least) {
      most.off.push_back(i);
      grid.add(o.camera.project(o.points.col(i)), each);
    }
  for (std::size_t first = 0; first < grid.size(); ++first) {
    LeftOver cluster;
    grid.takeFrom(first, cluster);
    if (cluster.worth > most.worth) {
      most.worth = cluster.worth;
      most.cells = std::move(cluster.cells);
    }
  }
  return most;
}

std::vector<Eigen::Vector2d>
pixelsOf(const PieceContext& context, const LeftOver& left, const Superquadric& body) {
  const ObservedObject& o = context.observed;
  const CellMask& object = o.pixels;
  const RayTest test(body, o.camera.center);
  constexpr int REACH = tuning::outline_gaps::MARGIN + 1;
  CellMask seen(object.width, object.height), stands = seen;
  for (const int i : left.off) {
    const Eigen::Vector2d p = o.camera.project(o.points.col(i));
    const int x = int(std::lround(p.x())), y = int(std::lround(p.y()));
    if (object(x, y))
      stands.cells[stands.indexOf(x, y)] = 1;
  }
  std::vector<Eigen::Vector2d> all;
  for (const Eigen::Vector2d& cell : left.cells)
    for (int y = int(cell.y()) - REACH; y < int(cell.y()) + STEP + REACH; ++y)
      for (int x = int(cell.x()) - REACH; x < int(cell.x()) + STEP + REACH; ++x)
        if (object(x, y) && !seen(x, y)) {
          seen.cells[seen.indexOf(x, y)] = 1;
          const Eigen::Vector2d p(x, y);
          if (stands(x, y) || !test.hits(o.camera.ray(p)))
            all.push_back(p);
        }
  return all;
}

} // namespace pcl_sq::detail

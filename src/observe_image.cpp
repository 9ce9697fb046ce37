// SPDX-License-Identifier: BSD-3-Clause
// An object in an organized cloud: its pixels, outline, points and table.
#include "observe_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_sq {

namespace detail {

namespace {

constexpr int MIN_POINTS = 30;
constexpr std::size_t MAX_POINTS =
    1500;                         ///< fitted; neighbours share their errors anyway
constexpr int RIM_OF_MASK = 1;    ///< pixels beside a mask's outline that are left out
constexpr int RIM_OF_DEPTH = 3;   ///< the same for the fattened rim of stereo matching
constexpr double FATTENING = 1.5; ///< expected dilation of an outline from depth [px]
constexpr int OCCLUDER_REACH = 6; ///< pixels searched beyond the outline
constexpr int FREE_PIXELS = 500;  ///< about so many around the object are looked at
constexpr int FREE_MARGIN = 2;    ///< pixels beside the outline that may be either's
constexpr int PLANES = 3;         ///< largest ones among which the table is

/** \brief Upper median; reorders the values. */
double median(double* values, std::size_t count) {
  std::nth_element(values, values + count / 2, values + count);
  return values[count / 2];
}

double median(std::vector<double>& values) {
  return median(values.data(), values.size());
}

struct Bounds {
  int x0 = 1 << 30, y0 = 1 << 30, x1 = -1, y1 = -1;
  void add(int x, int y) {
    x0 = std::min(x0, x);
    y0 = std::min(y0, y);
    x1 = std::max(x1, x);
    y1 = std::max(y1, y);
  }
};

Bounds boundsOf(const CellMask& mask) {
  Bounds b;
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (mask.cells[mask.indexOf(x, y)])
        b.add(x, y);
  return b;
}

/** \brief Sets pixels that most of their neighbours set, within the bounds. */
void fillHoles(CellMask& mask, const Bounds& b) {
  for (int pass = 0; pass < 3; ++pass) {
    const CellMask before = mask;
    for (int y = b.y0; y <= b.y1; ++y)
      for (int x = b.x0; x <= b.x1; ++x) {
        if (before(x, y))
          continue;
        int set = 0;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx)
            set += before(x + dx, y + dy);
        if (set >= 5)
          mask.set(x, y);
      }
  }
}

bool deepInside(const CellMask& mask, int x, int y, int rim) {
  for (int d = 1; d <= rim; ++d)
    if (!mask(x - d, y) || !mask(x + d, y) || !mask(x, y - d) || !mask(x, y + d))
      return false;
  return true;
}

/** \brief Whether a pixel's depth is that of most of its neighbours in the mask. */
bool agreesWithNeighbours(const Observation& o, const CellMask& mask, int x, int y) {
  std::array<double, 49> depths;
  std::size_t count = 0;
  for (int dy = -3; dy <= 3; ++dy)
    for (int dx = -3; dx <= 3; ++dx)
      if (mask(x + dx, y + dy)) {
        const int c = (y + dy) * o.width + x + dx;
        if (o.finite(c))
          depths[count++] = o.out.camera.depthOf(o.at(c));
      }
  if (count < 5)
    return false;
  const double middle = median(depths.data(), count);
  for (std::size_t i = 0; i < count; ++i)
    depths[i] = std::abs(depths[i] - middle);
  const double spread = median(depths.data(), count);
  const double depth = o.out.camera.depthOf(o.at(y * o.width + x));
  return std::abs(depth - middle) <= 6.0 * spread + 1e-3 * middle;
}

/** \brief Where a plane is, as seen from the object. */
enum class TableRelation { UNDER, ABOVE, FAR };

TableRelation relationTo(const TableModel& table, const ObservedObject& observed) {
  const double tolerance = 5.0 * table.sigma + 0.1 * observed.extent;
  std::vector<double> heights;
  for (Eigen::Index i = 0; i < observed.points.cols(); ++i)
    heights.push_back(table.height(observed.points.col(i)));
  const auto at = [&heights](std::size_t index) {
    const auto place = heights.begin() + std::ptrdiff_t(index);
    std::nth_element(heights.begin(), place, heights.end());
    return *place;
  };
  if (at(heights.size() / 5) < -tolerance)
    return TableRelation::ABOVE;
  return at(heights.size() / 50) > observed.extent ? TableRelation::FAR
                                                   : TableRelation::UNDER;
}

/** \brief The table from the points around the object. */
void findTable(Observation& o, const Bounds& b) {
  const int margin = std::max(20, (b.x1 - b.x0 + b.y1 - b.y0) / 3);
  std::vector<Eigen::Vector3d> around;
  const int x0 = std::max(0, b.x0 - margin), x1 = std::min(o.width - 1, b.x1 + margin);
  const int y0 = std::max(0, b.y0 - margin / 3);
  const int y1 = std::min(o.height - 1, b.y1 + margin);
  const int step = std::max(
      1, static_cast<int>(std::sqrt(double(x1 - x0 + 1) * (y1 - y0 + 1) / 6000.0)));
  for (int y = y0; y <= y1; y += step)
    for (int x = x0; x <= x1; x += step) {
      const int c = y * o.width + x;
      bool near = false; // the rim has the object's depth
      for (int d = -4; d <= 4 && !near; d += 2)
        near = o.out.pixels(x + d, y) || o.out.pixels(x, y + d);
      if (!near && o.finite(c))
        around.push_back(o.at(c));
    }
  // the largest plane may be a wall behind the object
  for (int attempt = 0; attempt < PLANES; ++attempt) {
    TableModel table;
    if (!findPlane(around, o.out.camera.center, 0.008 * o.out.depth, table))
      break;
    if (relationTo(table, o.out) == TableRelation::UNDER) {
      o.out.table = table;
      return;
    }
    std::vector<Eigen::Vector3d> rest;
    for (const Eigen::Vector3d& p : around)
      if (std::abs(table.height(p)) > 0.016 * o.out.depth)
        rest.push_back(p);
    around.swap(rest);
  }
  o.out.notes.push_back("no table was found under the object");
}

/** \brief Whether something nearer than the object hides it beyond a contour pixel. */
bool occluded(const Observation& o, int x, int y) {
  constexpr std::size_t WINDOW = (2 * OCCLUDER_REACH + 1) * (2 * OCCLUDER_REACH + 1);
  std::vector<double> own, other;
  own.reserve(WINDOW);
  other.reserve(WINDOW);
  for (int dy = -OCCLUDER_REACH; dy <= OCCLUDER_REACH; dy += 1)
    for (int dx = -OCCLUDER_REACH; dx <= OCCLUDER_REACH; dx += 1) {
      const int u = x + dx, v = y + dy;
      if (u < 0 || v < 0 || u >= o.width || v >= o.height)
        continue;
      const int c = v * o.width + u;
      if (!o.finite(c))
        continue;
      const double depth = o.out.camera.depthOf(o.at(c));
      if (o.out.pixels(u, v))
        own.push_back(depth);
      else if (!o.out.table ||
               o.out.table->height(o.at(c)) > 4.0 * o.out.table->sigma + 0.01 * depth)
        other.push_back(depth);
    }
  if (own.size() < 5 || other.size() < 8)
    return false;
  const double mine = median(own);
  return median(other) < mine - std::max(0.03 * mine, 0.3 * o.out.extent);
}

/** \brief Pixels beside the object's through which the background is seen. */
void findFreePixels(Observation& o, const Bounds& b, bool has_mask) {
  const int margin = FREE_MARGIN + (has_mask ? 0 : RIM_OF_DEPTH);
  const int reach = std::max(8, (b.x1 - b.x0 + b.y1 - b.y0) / 16);
  const double area = double(b.x1 - b.x0 + 2 * reach) * double(b.y1 - b.y0 + 2 * reach);
  const int step = std::max(1, int(std::sqrt(area / FREE_PIXELS)));
  o.out.free_weight = std::min(1.0, std::pow(step / o.view.correlation, 2));
  const auto beside = [&](int x, int y) {
    for (int dy = -margin; dy <= margin; ++dy)
      for (int dx = -margin; dx <= margin; ++dx)
        if (o.out.pixels(x + dx, y + dy))
          return false;
    return true;
  };
  const int x1 = std::min(o.width - 1, b.x1 + reach);
  const int y1 = std::min(o.height - 1, b.y1 + reach);
  for (int y = std::max(0, b.y0 - reach); y <= y1; y += step)
    for (int x = std::max(0, b.x0 - reach); x <= x1; x += step) {
      const int c = y * o.width + x;
      // without a mask only a measured background counts; an occluder never does
      const bool known = o.finite(c);
      if ((!known && !has_mask) || !beside(x, y))
        continue;
      if (!known || o.out.camera.depthOf(o.at(c)) > o.out.depth)
        o.out.free_pixels.emplace_back(x, y);
    }
}

void choosePoints(Observation& o, const Bounds& b, int rim) {
  const double area = double(o.out.pixels.count());
  const int step =
      std::max(1, static_cast<int>(std::floor(std::sqrt(area / double(MAX_POINTS)))));
  std::vector<int> chosen;
  std::size_t finite = 0;
  for (int shrink = rim; shrink >= 0 && chosen.size() < std::size_t(MIN_POINTS);
       --shrink) {
    chosen.clear();
    finite = 0;
    for (int y = b.y0; y <= b.y1; y += step)
      for (int x = b.x0; x <= b.x1; x += step) {
        const int c = y * o.width + x;
        if (!o.out.pixels(x, y) || !o.finite(c) ||
            !deepInside(o.out.pixels, x, y, shrink))
          continue;
        ++finite;
        if (agreesWithNeighbours(o, o.out.pixels, x, y))
          chosen.push_back(c);
      }
  }
  o.out.columns = chosen;
  o.out.points.resize(3, static_cast<Eigen::Index>(chosen.size()));
  for (std::size_t i = 0; i < chosen.size(); ++i)
    o.out.points.col(static_cast<Eigen::Index>(i)) = o.at(chosen[i]);
  const double independent = area / (o.view.correlation * o.view.correlation) *
                             double(finite) / std::max(1.0, double(finite));
  o.out.effective_points = std::min(double(chosen.size()), independent);
}

} // namespace

void measure(ObservedObject& observed) {
  if (observed.points.cols() == 0)
    return;
  // a few wrong matches must not make the object large
  const Eigen::Index n = observed.points.cols(), cut = n / 100;
  Eigen::Vector3d side;
  std::vector<double> along(static_cast<std::size_t>(n));
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXd::Map(along.data(), n) = observed.points.row(k);
    std::nth_element(along.begin(), along.begin() + cut, along.end());
    const double low = along[std::size_t(cut)];
    std::nth_element(along.begin(), along.end() - 1 - cut, along.end());
    side[k] = *(along.end() - 1 - cut) - low;
  }
  observed.extent = 0.5 * side.norm();
  observed.depth =
      std::max(1e-9, observed.camera.depthOf(observed.points.rowwise().mean()));
}

void checkTable(ObservedObject& observed) {
  if (!observed.table || observed.points.cols() == 0)
    return;
  const TableRelation relation = relationTo(*observed.table, observed);
  if (relation == TableRelation::ABOVE)
    observed.notes.push_back(
        "the object lies below the table plane, which is left out");
  else if (relation == TableRelation::FAR)
    observed.notes.push_back(
        "the object does not stand on the table plane, which is left out");
  if (relation != TableRelation::UNDER)
    observed.table.reset();
}

bool observeImage(Observation& o, std::string& why) {
  ObservedObject& out = o.out;
  const bool has_mask = !o.view.mask.cells.empty();
  out.outline = has_mask ? OutlineSource::MASK : OutlineSource::DEPTH;
  if (has_mask)
    out.pixels = o.view.mask;
  else if (o.object.empty()) {
    out.table = o.view.table;
    if (!findStandingObject(o.points, o.width, o.height, out.table, out.pixels)) {
      out.table = o.view.table;
      for (int c = 0; c < o.width * o.height; ++c)
        out.pixels.cells[static_cast<std::size_t>(c)] = o.finite(c);
      out.notes.push_back("nothing was found that stands on a table; all points are "
                          "taken as the object");
    } else
      out.notes.push_back("the object is the largest thing that stands on the table");
  } else {
    out.pixels = CellMask(o.width, o.height);
    for (const int c : o.object)
      out.pixels.cells[static_cast<std::size_t>(c)] = o.finite(c);
  }
  const Bounds b = boundsOf(out.pixels);
  if (b.x1 < 0) {
    why = has_mask ? "the mask is empty; mark the object's pixels"
                   : "the object has no finite point";
    return false;
  }
  if (!has_mask)
    fillHoles(out.pixels, b);
  choosePoints(o, b, has_mask ? RIM_OF_MASK : RIM_OF_DEPTH);
  if (out.points.cols() < MIN_POINTS) {
    why = "fewer than " + std::to_string(MIN_POINTS) + " points lie under the " +
          (has_mask ? "mask; it must cover the object" : "object's pixels");
    return false;
  }
  measure(out);
  out.sideways = sidewaysErrors(o);
  if (o.view.table)
    out.table = *o.view.table;
  else if (!out.table && o.view.find_table)
    findTable(o, b);
  checkTable(out);
  findFreePixels(o, b, has_mask);
  out.outline_sigma = has_mask ? o.view.mask_sigma : 1.5;
  out.outline_dilation = has_mask ? o.view.mask_dilation : 1.5;
  out.outline_offset = has_mask ? 0.0 : FATTENING;
  // just above the table the cluster ends before the object does
  const double floor =
      has_mask || !out.table ? -1e300 : 3.0 * standingHeight(*out.table, out.depth);
  out.contour = contourOf(out.pixels, [&](int x, int y) {
    const int c = y * o.width + x;
    if (!has_mask && o.finite(c) && out.table->height(o.at(c)) < floor)
      return true;
    return occluded(o, x, y);
  });
  return true;
}

} // namespace detail

} // namespace pcl_sq

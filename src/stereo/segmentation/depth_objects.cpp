// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/segmentation/depth_objects.h"

#include "pcl_sq/object_view.h"
#include "stereo/segmentation/depth_odds.h"
#include "stereo/segmentation/depth_patches.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_sq::detail {
namespace {

constexpr double STEEP = 50.0 * M_PI / 180.0; // largest tilt of a table in the image
constexpr float NOISE = 0.008f;               // of a plane's points, of the depth

cv::Rect wholeImage(const ColorCloud& cloud) {
  return {0, 0, int(cloud.width), int(cloud.height)};
}

/** \brief Number of cells of each label. */
std::vector<int> sizesOf(const cv::Mat& labels, int count, const cv::Mat& where) {
  std::vector<int> sizes(static_cast<std::size_t>(count) + 1, 0);
  for (int v = 0; v < labels.rows; ++v)
    for (int u = 0; u < labels.cols; ++u)
      if (where.at<std::uint8_t>(v, u) != 0)
        ++sizes[static_cast<std::size_t>(labels.at<int>(v, u))];
  return sizes;
}

/** \brief The two outermost cells all round. */
cv::Mat rimOf(const cv::Size& size) {
  cv::Mat rim(size, CV_8U, cv::Scalar(255));
  if (size.width > 4 && size.height > 4)
    rim(cv::Rect(2, 2, size.width - 4, size.height - 4)).setTo(0);
  return rim;
}

bool findTable(const DepthGrid& grid, float tolerance, DepthPlane& plane) {
  constexpr double LEAST = 0.05;
  return findPlane(grid, grid.finite, tolerance, STEEP, LEAST, plane) ||
         findPlane(grid, grid.finite, tolerance, 0.5 * M_PI, LEAST, plane);
}

float heightOver(const DepthPlane& plane, const DepthGrid& grid, pcl::index_t i) {
  const auto& p = (*grid.points)[static_cast<std::size_t>(i)];
  return plane.head<3>().dot(p.getVector3fMap()) + plane[3];
}

/** \brief Cells that lie on one of some planes or behind it. */
cv::Mat
behind(const DepthGrid& grid, const std::vector<DepthPlane>& planes, float tolerance) {
  cv::Mat cells = cv::Mat::zeros(grid.height, grid.width, CV_8U);
  for (const pcl::index_t i : grid.finite)
    if (std::any_of(planes.begin(), planes.end(), [&](const DepthPlane& plane) {
          return heightOver(plane, grid, i) < tolerance;
        }))
      cells.ptr<std::uint8_t>()[i] = 255;
  return cells;
}

/** \brief Share of cells that lie on a plane or behind it. */
double shareOn(const DepthPlane& plane,
               const DepthGrid& grid,
               const pcl::Indices& cells,
               float tolerance) {
  const auto on = std::count_if(cells.begin(), cells.end(), [&](pcl::index_t i) {
    return heightOver(plane, grid, i) < tolerance;
  });
  return double(on) / std::max<double>(1.0, double(cells.size()));
}

/** \brief The plane around a box, if it goes on before it and the box's middle does not
 * lie on it as well. A slope that few cameras see a table at takes more of it. */
bool findTableAround(const DepthGrid& grid,
                     const pcl::Indices& ring,
                     const pcl::Indices& middle,
                     const cv::Rect& inner,
                     float tolerance,
                     DepthPlane& plane) {
  constexpr double USUAL = 40.0 * M_PI / 180.0;
  constexpr double LEAST = 0.2, MOST = 0.6; // of what is seen around the box
  constexpr double BEFORE = 0.3;            // of what is seen below it in the image
  const auto goesOnBefore = [&] {
    std::ptrdiff_t before = 0, on = 0;
    for (const pcl::index_t i : ring)
      if (i / grid.width * grid.step > inner.y + inner.height) {
        ++before;
        on += std::abs(heightOver(plane, grid, i)) < tolerance;
      }
    return double(on) > BEFORE * double(before);
  };
  const bool found =
      (findPlane(grid, ring, tolerance, USUAL, LEAST, plane) && goesOnBefore()) ||
      findPlane(grid, ring, tolerance, 0.5 * M_PI, MOST, plane);
  return found && shareOn(plane, grid, middle, tolerance) < 0.5;
}

/** \brief What the surroundings of a box are made of, its table first: the walls are
 * planes that go on around the box and pass behind its middle. */
std::vector<DepthPlane> findPlanesAround(const DepthGrid& grid,
                                         const cv::Mat& core,
                                         const cv::Rect& inner,
                                         float tolerance) {
  constexpr int WALLS = 2;
  constexpr double LEAST = 0.2;    // of what is seen around the box
  constexpr double THROUGH = 0.05; // of the middle: a plane behind it leaves it alone
  pcl::Indices ring, middle;
  for (const pcl::index_t i : grid.finite) {
    const cv::Point cell(i % grid.width, i / grid.width);
    if (!inner.contains(cell * grid.step))
      ring.push_back(i);
    else if (core.at<std::uint8_t>(cell) != 0)
      middle.push_back(i);
  }
  std::vector<DepthPlane> planes(1);
  if (!findTableAround(grid, ring, middle, inner, tolerance, planes[0]))
    planes.clear();
  const auto total = double(ring.size());
  const auto leaveOut = [&](const DepthPlane& plane) {
    ring.erase(std::remove_if(ring.begin(),
                              ring.end(),
                              [&](pcl::index_t i) {
                                return std::abs(heightOver(plane, grid, i)) < tolerance;
                              }),
               ring.end());
  };
  for (const DepthPlane& plane : planes)
    leaveOut(plane);
  for (int k = 0; k<WALLS&& double(ring.size())> LEAST * total; ++k) {
    DepthPlane wall;
    const double least = LEAST * total / double(ring.size());
    if (!findPlane(grid, ring, tolerance, 0.5 * M_PI, least, wall))
      break;
    if (shareOn(wall, grid, middle, tolerance) < THROUGH)
      planes.push_back(wall);
    leaveOut(wall);
  }
  return planes;
}

/** \brief Distance of each pixel to the set ones, CV_32F [px]. */
cv::Mat distanceTo(const cv::Mat& mask) {
  cv::Mat distance;
  cv::distanceTransform(mask == 0, distance, cv::DIST_L2, 3);
  return distance;
}

} // namespace

bool findTableObject(const ColorCloud& cloud, cv::Mat& mask, std::string& why) {
  constexpr std::size_t STRIDE = sizeof(pcl::PointXYZRGB) / sizeof(float);
  const CloudPoints points(Eigen::Map<const Eigen::Matrix3Xf, 0, Eigen::OuterStride<>>(
      cloud.front().data, 3, Eigen::Index(cloud.size()), Eigen::OuterStride<>(STRIDE)));
  const auto width = static_cast<int>(cloud.width);
  const auto height = static_cast<int>(cloud.height);
  std::optional<TableModel> table;
  CellMask object;
  if (!findStandingObject(points, width, height, table, object)) {
    why = "nothing was found that stands on a table; give a hint where the object is";
    return false;
  }
  mask = cv::Mat(height, width, CV_8U, object.cells.data()) != 0;
  return true;
}

bool depthOddsInBox(const ColorCloud& cloud,
                    const cv::Rect& box,
                    const cv::Rect& window,
                    double disparity_scale,
                    cv::Mat& odds) {
  constexpr double MOST = 3.0;   // of ln odds: of twenty such pixels one is another's
  constexpr double RIM = 6.0;    // a matched window fattens outlines by so much [px]
  constexpr double IN_BOX = 0.7; // of a piece of the object
  const DepthGrid grid(cloud, window);
  const cv::Rect inner = box - window.tl();
  cv::Mat core = cv::Mat::zeros(grid.height, grid.width, CV_8U);
  cv::ellipse(core,
              cv::Point(inner.x + inner.width / 2, inner.y + inner.height / 2) /
                  grid.step,
              cv::Size(inner.width * 2 / 5, inner.height * 2 / 5) / grid.step,
              0,
              0,
              360,
              255,
              cv::FILLED);
  if (grid.finite.size() < 20)
    return false;
  const float tolerance = NOISE * grid.medianDepth();
  int count = 0;
  const std::vector<DepthPlane> planes = findPlanesAround(grid, core, inner, tolerance);
  const cv::Mat patches = labelPatches(grid, planes, tolerance, &count);
  const std::vector<int> sizes = sizesOf(patches, count, core);
  const auto best = std::max_element(sizes.begin() + 1, sizes.end());
  if (best == sizes.end() || *best < 0.1 * cv::countNonZero(core))
    return false;
  cv::Mat cells = cv::Mat::zeros(grid.height, grid.width, CV_8U);
  const cv::Rect in_cells = cv::Rect(inner.tl() / grid.step,
                                     cv::Size(inner.width, inner.height) / grid.step) &
                            cv::Rect(0, 0, grid.width, grid.height);
  cells(in_cells).setTo(255);
  const std::vector<int> in_box = sizesOf(patches, count, cells);
  const std::vector<int> all =
      sizesOf(patches, count, cv::Mat(patches.size(), CV_8U, cv::Scalar(255)));
  // what the box holds at the depth of its middle belongs to the same thing, which is
  // hardly deeper than wide
  const auto main = std::size_t(best - sizes.begin());
  const std::vector<float> middle_depths = grid.medianDepths(patches, count);
  const float reach = 0.5F * middle_depths[main] * grid.angle() *
                      float(std::max(in_cells.width, in_cells.height));
  cv::Mat object = patches == static_cast<int>(main);
  for (std::size_t k = 1; k < sizes.size(); ++k)
    if (in_box[k] >= 5 && in_box[k] >= IN_BOX * all[k] &&
        std::abs(middle_depths[k] - middle_depths[main]) < reach)
      object |= patches == static_cast<int>(k);
  const cv::Mat background =
      (((patches > 0) | behind(grid, planes, tolerance)) & ~object) |
      grid.hiddenToTheLeft(object, disparity_scale);
  const cv::Mat told =
      grid.toPixels(oddsOfDepths(grid, object, cells, tolerance, MOST));
  const cv::Mat mine = grid.toPixels(object);
  const cv::Mat others = grid.toPixels(background) & ~mine;
  const cv::Mat to_mine = distanceTo(mine), to_others = distanceTo(others);
  odds = cv::Mat::zeros(window.size(), CV_32F);
  const cv::Mat inwards = cv::min(to_others / RIM, 1.0F);
  const cv::Mat outwards = cv::min(to_mine / RIM, 1.0F) * -float(MOST);
  cv::Mat(told.mul(inwards)).copyTo(odds, mine);
  outwards.copyTo(odds, others);
  return true;
}

bool findObjectAt(const ColorCloud& cloud, const cv::Point& pixel, cv::Mat& mask) {
  constexpr int NEAR = 3; // cells around the pixel: it may itself be without a match
  const DepthGrid grid(cloud, wholeImage(cloud));
  if (grid.finite.size() < 100)
    return false;
  const float tolerance = NOISE * grid.medianDepth();
  std::vector<DepthPlane> table(1);
  if (!findTable(grid, tolerance, table[0]))
    table.clear();
  int count = 0;
  const cv::Mat labels = labelPatches(grid, table, tolerance, &count);
  cv::Mat near = cv::Mat::zeros(labels.size(), CV_8U);
  cv::circle(near, pixel / grid.step, NEAR, 255, cv::FILLED);
  std::vector<int> votes = sizesOf(labels, count, near);
  votes[0] = 0;
  const auto best = std::max_element(votes.begin(), votes.end());
  if (*best == 0)
    return false;
  const cv::Mat patch = labels == static_cast<int>(best - votes.begin());
  const int area = cv::countNonZero(patch), total = static_cast<int>(labels.total());
  if (cv::countNonZero(patch & rimOf(labels.size())) > 0 || area > total / 4 ||
      area < std::max(20, total / 2000))
    return false;
  mask = grid.toPixels(patch);
  return true;
}

double
shareAtDepthOf(const ColorCloud& cloud, const cv::Mat& patch, const cv::Mat& mask) {
  std::vector<float> own, others;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!std::isfinite(cloud[i].z))
      continue;
    if (patch.ptr<std::uint8_t>()[i] != 0)
      own.push_back(cloud[i].z);
    if (mask.ptr<std::uint8_t>()[i] != 0)
      others.push_back(cloud[i].z);
  }
  if (own.empty() || others.empty())
    return 1.0;
  std::sort(own.begin(), own.end());
  const float near = own[own.size() / 20], far = own[own.size() - 1 - own.size() / 20];
  const float margin = far - near + 0.02f * far; // a patch may end before the object
  const auto count = std::count_if(others.begin(), others.end(), [&](float z) {
    return z > near - margin && z < far + margin;
  });
  return static_cast<double>(count) / static_cast<double>(others.size());
}

} // namespace pcl_sq::detail

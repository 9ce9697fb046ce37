// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/tabletop_segmentation.h"

#include "option_check.h"
#include "voxel_clusters.h"

#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_plane.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_sq {

namespace {

constexpr std::size_t RANSAC_POINTS = 20000; ///< a sample as large finds the same plane
constexpr double EXTENT_QUANTILE = 0.05;     ///< far outliers do not stretch the scale
constexpr double MIN_PLANE_SHARE = 0.1;      ///< of the points, or there is no table
constexpr std::size_t MIN_OBJECT_POINTS = 30;

std::vector<int> finiteColumns(const Eigen::Matrix3Xf& points) {
  std::vector<int> finite;
  for (int i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite())
      finite.push_back(i);
  return finite;
}

/** \brief Diagonal of the box that holds all but the outermost points [m]. */
double robustExtent(const Eigen::Matrix3Xf& points, const std::vector<int>& columns) {
  Eigen::Vector3d size;
  std::vector<float> values(columns.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      values[i] = points(axis, columns[i]);
    const auto cut =
        static_cast<std::ptrdiff_t>(EXTENT_QUANTILE * double(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + cut, values.end());
    const double low = values[cut];
    std::nth_element(values.begin(), values.end() - 1 - cut, values.end());
    size[axis] = double(*(values.end() - 1 - cut)) - low;
  }
  return size.norm();
}

bool fitPlane(const Eigen::Matrix3Xf& points,
              const std::vector<int>& columns,
              double distance,
              int max_iterations,
              TablePlane& plane) {
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  const std::size_t step = std::max<std::size_t>(1, columns.size() / RANSAC_POINTS);
  for (std::size_t i = 0; i < columns.size(); i += step) {
    const auto p = points.col(columns[i]);
    cloud->push_back(pcl::PointXYZ(p.x(), p.y(), p.z()));
  }
  auto model = pcl::make_shared<pcl::SampleConsensusModelPlane<pcl::PointXYZ>>(cloud);
  pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, distance);
  ransac.setMaxIterations(max_iterations);
  if (!ransac.computeModel())
    return false;
  pcl::Indices inliers;
  ransac.getInliers(inliers);
  Eigen::VectorXf coefficients, refined;
  ransac.getModelCoefficients(coefficients);
  model->optimizeModelCoefficients(inliers, coefficients, refined);
  if (refined.size() != 4 || !refined.allFinite() ||
      double(inliers.size()) < MIN_PLANE_SHARE * double(cloud->size()))
    return false;
  const double length = refined.head<3>().norm();
  plane.normal = refined.head<3>().cast<double>() / length;
  plane.offset = double(refined[3]) / length;
  return true;
}

/** \brief The area that the plane's points cover, as cells of a grid on the plane. */
class PlaneOutline {
public:
  PlaneOutline(const TablePlane& plane, double cell) : cell_(cell) {
    u_ = plane.normal.unitOrthogonal();
    v_ = plane.normal.cross(u_);
  }
  void add(const Eigen::Vector3d& p) {
    for (int angle = 0; angle < DIRECTIONS; ++angle)
      reach_[angle] = std::max(reach_[angle], along(angle, p));
  }
  /** \brief Whether p lies above the convex outline, a cell of margin included. */
  bool contains(const Eigen::Vector3d& p) const {
    for (int angle = 0; angle < DIRECTIONS; ++angle)
      if (along(angle, p) > reach_[angle] + cell_)
        return false;
    return true;
  }

private:
  static constexpr int DIRECTIONS = 32;
  double along(int angle, const Eigen::Vector3d& p) const {
    const double a = 2.0 * M_PI * angle / DIRECTIONS;
    return std::cos(a) * u_.dot(p) + std::sin(a) * v_.dot(p);
  }
  double cell_;
  Eigen::Vector3d u_, v_;
  std::vector<double> reach_ =
      std::vector<double>(DIRECTIONS, -std::numeric_limits<double>::infinity());
};

} // namespace

bool TabletopOptions::isValid(std::string* why) const {
  detail::OptionCheck check(why);
  check.inRange("plane_distance", plane_distance, 0.0, 1e9);
  check.inRange("cluster_gap", cluster_gap, 0.0, 1e9);
  check.inRange("max_iterations", max_iterations, 1, 100000);
  return check.passed();
}

bool findTabletopObject(const Eigen::Matrix3Xf& points,
                        const Eigen::Vector3f& viewpoint,
                        const std::vector<bool>& candidates,
                        const TabletopOptions& options,
                        TablePlane& plane,
                        std::vector<int>& object,
                        std::string* why) {
  object.clear();
  const auto fail = [why](const char* sentence) {
    if (why)
      *why = sentence;
    return false;
  };
  const std::vector<int> finite = finiteColumns(points);
  if (finite.size() < MIN_OBJECT_POINTS)
    return fail("there are too few finite points for a plane and an object");
  const double extent = robustExtent(points, finite);
  if (!(extent > 0.0) || !std::isfinite(extent))
    return fail("the points have no extent, or one too large to be a scene");
  const double distance =
      options.plane_distance > 0.0 ? options.plane_distance : 0.005 * extent;
  const double gap = options.cluster_gap > 0.0 ? options.cluster_gap : 0.01 * extent;
  if (!fitPlane(points, finite, distance, options.max_iterations, plane))
    return fail("no plane holds a tenth of the points; leave out the plane removal");
  if (plane.signedDistance(viewpoint.cast<double>()) < 0.0) {
    plane.normal = -plane.normal;
    plane.offset = -plane.offset;
  }
  PlaneOutline outline(plane, gap);
  for (const int i : finite)
    if (std::abs(plane.signedDistance(points.col(i).cast<double>())) <= distance)
      outline.add(points.col(i).cast<double>());
  std::vector<int> above;
  for (const int i : finite) {
    if (!candidates.empty() && !candidates[i])
      continue;
    const Eigen::Vector3d p = points.col(i).cast<double>();
    if (plane.signedDistance(p) > distance && outline.contains(p))
      above.push_back(i);
  }
  object = detail::largestCluster(points, above, gap);
  if (object.size() < MIN_OBJECT_POINTS) {
    object.clear();
    return fail("nothing stands on the largest plane; give the region of the object");
  }
  return true;
}

} // namespace pcl_sq

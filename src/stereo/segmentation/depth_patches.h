// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/types.hpp>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vector>

namespace pcl_sq::detail {

/** \brief Every step-th pixel of a window of an organized cloud: enough to find objects
 * in it. */
struct DepthGrid {
  int step = 1, width = 0, height = 0;
  cv::Rect window;
  pcl::PointCloud<pcl::PointXYZ>::Ptr points; ///< width x height, NaN: none
  pcl::PointCloud<pcl::Normal>::Ptr normals;  ///< of the same; 0: unknown
  pcl::Indices finite;                        ///< cells that have a point

  DepthGrid(const pcl::PointCloud<pcl::PointXYZRGB>& cloud, const cv::Rect& window);
  const pcl::PointXYZ& at(int u, int v) const {
    return (*points)[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(u)];
  }
  float medianDepth() const; ///< \pre there is a finite cell
  /** \brief The same of the cells of each label, 0 to count; 0 where there are none. */
  std::vector<float> medianDepths(const cv::Mat& labels, int count) const;
  /** \brief Whether the surface at a cell is seen so aslant that it is none: a step
   * between two of them, which matching has smeared over its window. */
  bool isStep(int u, int v) const { return steps_.at<std::uint8_t>(v, u) != 0; }
  /** \brief Whether a fold runs through a cell that opens to the camera: there one
   * thing stands on another or leans on it. */
  bool isFold(int u, int v) const { return folds_.at<float>(v, u) > least_fold_; }
  float angle() const; ///< between the rays of neighbouring cells [rad]
  /** \brief Cells without a point to the left of a thing that it hides from the right
   * camera: as far as the disparities differ from those beyond.
   * \param[in] object CV_8U \param[in] scale disparity times depth [px m] */
  cv::Mat hiddenToTheLeft(const cv::Mat& object, double scale) const;
  /** \brief A mask of cells as one of the window's pixels. */
  cv::Mat toPixels(const cv::Mat& cells) const;

private:
  int side_ = 0;  ///< of the window that normals are taken over, in cells
  cv::Mat steps_; ///< CV_8U, whether each cell is one
  cv::Mat folds_; ///< CV_32F, of each cell the angle that opens widest [rad]
  float least_fold_ = 0.0F;

  void findNormals();
  void findSteps();
  void findFolds();
  float foldAt(int u, int v) const;
};

/** \brief n.p + d = 0, the camera on the positive side. */
using DepthPlane = Eigen::Vector4f;

/** \brief Largest plane among some cells whose normal is within \a angle of the
 * camera's up (-y). Cells are on it where their own surface faces as it does: what it
 * cuts through is no part of it. \param[in] least inliers of a plane, as a share of the
 * cells */
bool findPlane(const DepthGrid& grid,
               const pcl::Indices& cells,
               double tolerance,
               double angle,
               double least,
               DepthPlane& plane);

/** \brief Patches of points, cut at jumps, steps and folds. \param[in] planes only
 * points above all of them count \param[in] tolerance least height above a plane [m]
 * \return CV_32S: 1 to count, 0 = none */
cv::Mat labelPatches(const DepthGrid& grid,
                     const std::vector<DepthPlane>& planes,
                     float tolerance,
                     int* count);

} // namespace pcl_sq::detail

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/roi.h"
#include "pcl_sq/triangle_mesh.h"

#include <opencv2/core/mat.hpp>

#include <vector>

namespace pcl_sq::app {

/** \brief A picture of points, boxes and surfaces seen from around an object, drawn
 * with a depth buffer; needs no display. */
class ViewCanvas {
public:
  /** \param[in] focus box that fills the picture [m] \param[in] turn about the vertical
   * and \param[in] tilt from above, seen from the camera [rad] */
  ViewCanvas(const cv::Size& size, const RoiBox& focus, double turn, double tilt);

  /** \brief Square dots. \param[in] colors BGR, one for each point */
  void addPoints(const std::vector<Eigen::Vector3d>& points,
                 const std::vector<cv::Vec3b>& colors,
                 int dot);
  /** \brief Shaded translucent surface. \param[in] opacity 0 to 1 */
  void addMesh(const TriangleMesh& mesh, const cv::Vec3b& color, double opacity);
  /** \brief Solid box with dark edges. */
  void addSolidBox(const RoiBox& box, const cv::Vec3b& color, double opacity);
  /** \brief Edges of a box. */
  void addWireBox(const RoiBox& box, const cv::Vec3b& color, int width);

  const cv::Mat& picture() const { return picture_; }

private:
  Eigen::Vector3d project(const Eigen::Vector3d& point) const;
  void fillTriangle(const Eigen::Vector3d* corners,
                    const cv::Vec3b& color,
                    cv::Mat& layer,
                    cv::Mat& depth) const;
  void blend(const cv::Mat& layer, const cv::Mat& depth, double opacity);

  cv::Mat picture_, depth_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d center_;
  double distance_ = 1.0, scale_ = 1.0;
};

/** \brief Corners of a box as a closed mesh of twelve triangles. */
TriangleMesh meshBox(const RoiBox& box);

} // namespace pcl_sq::app

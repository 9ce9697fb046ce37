// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"
#include "pcl_sq/roi.h"
#include "pcl_sq/silhouette.h"
#include "pcl_sq/triangle_mesh.h"

#include <opencv2/core/mat.hpp>

#include <vector>

namespace pcl_sq::app {

/** \brief A picture of points, boxes and surfaces, drawn with a depth buffer; needs no
 * display. Part k of a model has colour partTint(k). */
class ViewCanvas {
public:
  /** \param[in] focus box that fills the picture [m] \param[in] turn about the vertical
   * and \param[in] tilt from above, seen from the camera [rad] */
  ViewCanvas(const cv::Size& size, const RoiBox& focus, double turn, double tilt);

  /** \brief The view of a camera over its own image. \param[in] image CV_8UC3 */
  ViewCanvas(const cv::Mat& image, const PinholeCamera& camera);

  /** \brief Square dots. \param[in] colors BGR, one for each point */
  void addPoints(const std::vector<Eigen::Vector3d>& points,
                 const std::vector<cv::Vec3b>& colors,
                 int dot);
  /** \brief Shaded translucent surface. \param[in] opacity 0 to 1 */
  void addMesh(const TriangleMesh& mesh, const cv::Vec3b& color, double opacity);
  /** \brief The parts of a model; what \a eye could not see of them is lighter. */
  void
  addModel(const MultiSuperquadric& model, const Eigen::Vector3d& eye, double opacity);
  /** \brief The parts' outlines, finer and paler where another part hides them. */
  void addOutlines(const MultiSuperquadric& model);
  /** \brief Solid box with dark edges. */
  void addSolidBox(const RoiBox& box, const cv::Vec3b& color, double opacity);
  /** \brief Edges of a box. */
  void addWireBox(const RoiBox& box, const cv::Vec3b& color, int width);

  const cv::Mat& picture() const { return picture_; }
  /** \brief Pixel and depth of a point. */
  Eigen::Vector3d project(const Eigen::Vector3d& point) const;

private:
  template <typename ColorOf>
  void drawMesh(const TriangleMesh& mesh, const ColorOf& color_of, double opacity);
  void fillTriangle(const Eigen::Vector3d* corners,
                    const cv::Vec3b& color,
                    cv::Mat& layer,
                    cv::Mat& depth) const;
  void blend(const cv::Mat& layer, const cv::Mat& depth, double opacity);

  cv::Mat picture_, depth_;
  PinholeCamera camera_;
};

/** \brief Colour of a model's part in the panel, BGR. */
cv::Vec3b partTint(std::size_t part);

} // namespace pcl_sq::app

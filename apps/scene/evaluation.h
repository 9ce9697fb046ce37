// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/multi_superquadric.h"
#include "scene/mesh_bvh.h"
#include "scene/objects.h"

#include <cstdint>
#include <functional>

namespace pcl_sq::app {

/** \brief A known shape: a closed mesh in its own frame, and where it stands. */
struct ReferenceShape {
  TriangleMesh mesh;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); ///< mesh to model's frame
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< mesh to model's frame [m]
  Symmetry symmetry = Symmetry::NONE;
};

/** \brief Mean, root mean square and maximum of distances [m]; a few stray points
 * decide the latter two, not the median. */
struct DistanceFigures {
  double mean = 0.0, rms = 0.0, median = 0.0, max = 0.0;
};

/** \brief A model against a known shape; lengths in metres. */
struct ShapeFigures {
  Eigen::Vector3d model_size = Eigen::Vector3d::Zero(); ///< along the shape's x, y, z
  Eigen::Vector3d true_size = Eigen::Vector3d::Zero();
  Eigen::Vector3d center_error = Eigen::Vector3d::Zero(); ///< model minus truth
  double axis_error_deg = 0.0; ///< modulo the shape's symmetry
  double iou = 0.0;            ///< of the volumes, hollows filled up to their rims
  double iou_material = 0.0;   ///< of the walls, where one is hollow
  double model_volume = 0.0, true_volume = 0.0; ///< of the material [m^3]
  DistanceFigures model_to_truth;               ///< from the union's surface
  DistanceFigures truth_to_model;               ///< from the shape's surface
  double chamfer() const { return 0.5 * (model_to_truth.mean + truth_to_model.mean); }
};

/** \brief Told of long work: which, and the share of it that is done. */
using WorkDone = std::function<void(const char* work, double share)>;

/** \brief Figures of a model against a shape; repeatable.
 * \param[in] samples points for each of volume and surfaces */
ShapeFigures evaluateShape(const MultiSuperquadric& model,
                           const ReferenceShape& shape,
                           std::size_t samples,
                           unsigned int threads = 0,
                           const WorkDone& done = {});

/** \brief A model against measured points. */
struct CloudFigures {
  std::size_t points = 0;
  double distortion_mm = 0.0; ///< D, Eq. (7), semi-axes in millimetres (Table I)
  DistanceFigures distance;   ///< from the points to the union's surface [m]
};
CloudFigures evaluateCloud(const MultiSuperquadric& model,
                           const Eigen::Matrix3Xd& points,
                           unsigned int threads = 0,
                           const WorkDone& done = {});

/** \brief Smallest angle between the axes of a model and those of a shape [deg]. */
double axisError(const Eigen::Matrix3d& model,
                 const Eigen::Matrix3d& shape,
                 Symmetry symmetry);

} // namespace pcl_sq::app

// SPDX-License-Identifier: BSD-3-Clause
// numpy's arrays as the programs' clouds, labels and pages have them.
#pragma once

#include "arrays.h"
#include "files/cloud_io.h"
#include "input/shape.h"

#include "pcl_sq/scene_estimation.h"

#include <optional>

namespace pcl_sq::python {

/** \brief The points as a file would hold them. */
app::Shape shapeOf(const PointArray& points, const std::optional<py::array>& colors);

/** \brief The cloud of an array. \throw app::Failure with a whole sentence */
app::LoadedCloud cloudOf(app::Shape shape, const app::CloudOptions& options);

/** \brief Labels of an array of whole numbers, H x W. \throw std::invalid_argument */
LabelImage labelsOf(const py::array& labels);

/** \brief A cloud as htmlView() takes it. */
struct PageCloud {
  Eigen::Matrix3Xf
      points; ///< of single precision, which keeps its digits near the model
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::vector<std::uint32_t> colors;

  PageCloud(const std::optional<py::array>& cloud,
            const std::optional<py::array>& colors,
            const MultiSuperquadric& model);
};

} // namespace pcl_sq::python

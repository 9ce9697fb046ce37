// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/scene_io.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_sq {

/** \brief Settings of htmlView(). */
struct PCL_SQ_EXPORTS HtmlViewOptions {
  std::string title = "pcl_sq"; ///< of the page
  /** \brief Points of the cloud that are shown at most, evenly chosen; nine bytes each.
   */
  std::size_t max_points = 50000;
  /** \brief How far around the object the cloud is shown, in diagonals of the model's
   * box; points outside are left out. */
  double context = 1.5;
};

/** \brief A model to turn in a browser: one file, offline, WebGL of its own.
 *
 * It holds the cloud, the parts (on and off, their names and sizes under the pointer),
 * the grasps that stand in the file's members "grasps" and "gripper", the table and the
 * camera's place where they are known.
 * \param[in] points 3 x N, NaN columns allowed, or empty [m]
 * \param[in] offset is added to the points [m]
 * \param[in] colors 0xRRGGBB for each point, or empty */
PCL_SQ_EXPORTS std::string htmlView(const ModelFile& file,
                                    const CloudPoints& points,
                                    const Eigen::Vector3d& offset,
                                    const std::vector<std::uint32_t>& colors,
                                    const HtmlViewOptions& options = {});

/** \brief The same of all things of a scene; the parts of a thing share its colour. */
PCL_SQ_EXPORTS std::string htmlView(const SceneFile& scene,
                                    const CloudPoints& points,
                                    const Eigen::Vector3d& offset,
                                    const std::vector<std::uint32_t>& colors,
                                    const HtmlViewOptions& options = {});

} // namespace pcl_sq

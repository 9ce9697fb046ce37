// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcl_sq/palette.h"
#include "pcl_sq/visualization/view_camera.h"

#include <optional>
#include <string>

namespace pcl_sq {

/** \brief Settings of a picture.
 * \ingroup pcl_sq */
struct PCL_SQ_EXPORTS SnapshotOptions {
  int width = 1280;      ///< [px], [16, 4096]
  int height = 960;      ///< [px], [16, 4096]
  View view = View::ISO; ///< where from
  /** \brief Upward direction in the cloud's frame; cameras have y down. */
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
  double opacity = 0.45; ///< of the superquadrics, [0, 1]
  /** \brief The sensor's place in the cloud's frame [m]: what it could not see of the
   * superquadrics is drawn lighter. Without it all is drawn alike. */
  std::optional<Eigen::Vector3d> sensor;
  /** \brief How far around the object the cloud is shown, in diagonals of the object's
   * box, fading out; points outside are left out. [0, inf] */
  double context = 0.5;
  Color background = {255, 255, 255};
  std::string title;      ///< large, at the top
  std::string caption;    ///< small, under the title
  bool axes = true;       ///< triad of the cloud's frame
  bool scale_bar = true;  ///< with a round length
  bool legend = true;     ///< part numbers and colours; only if there is more than one
  double point_size = 0.; ///< of the cloud's points [px]; 0: from their density

  /** \brief Whether every setting is in its range.
   * \param[out] why the first that is not, as a sentence */
  [[nodiscard]] bool isValid(std::string* why = nullptr) const;
};

} // namespace pcl_sq

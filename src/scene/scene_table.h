// SPDX-License-Identifier: BSD-3-Clause
// Private. The table of a scene: which plane it is, and how far it reaches.
#pragma once

#include "patches/scene_view.h"
#include "pcl_sq/cell_mask.h"
#include "pcl_sq/object_view.h"

namespace pcl_sq::detail {

/** \brief The area of a table that is seen: the convex hull of its points, for things
 * hide parts of it; beyond the image's border it goes on. */
class TableArea {
public:
  /** \param[in] points of an organized cloud in its camera's frame */
  TableArea(const TableModel& table,
            const CloudPoints& points,
            int width,
            int height,
            const PinholeCamera& camera);

  [[nodiscard]] bool empty() const { return hull_.size() < 3; }
  /** \brief Points of the table, in pixels. */
  [[nodiscard]] int pixels() const { return pixels_; }
  /** \brief Whether a point lies above the area. */
  [[nodiscard]] bool isOver(const Eigen::Vector3d& point) const;

private:
  [[nodiscard]] Eigen::Vector2d onPlane(const Eigen::Vector3d& point) const {
    return {u_.dot(point), v_.dot(point)};
  }

  Eigen::Vector3d u_, v_;
  std::vector<Eigen::Vector2d> hull_; ///< counter-clockwise
  int pixels_ = 0;
};

/** \brief A table and how many planes it was chosen from. */
struct SceneTable {
  std::optional<TableModel> table; ///< empty: none that anything stands on
  int planes = 0;
};

/** \brief The plane on which most of what is seen stands: whole things above its area.
 * A table that itself stands on a floor is preferred to that.
 * \param[in] points of an organized cloud in its camera's frame
 * \param[in] up of the view, where known */
[[nodiscard]] SceneTable findSceneTable(const CloudPoints& points,
                                        int width,
                                        int height,
                                        const PinholeCamera& camera,
                                        const std::optional<Eigen::Vector3d>& up);

} // namespace pcl_sq::detail

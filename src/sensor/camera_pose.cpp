// SPDX-License-Identifier: BSD-3-Clause
#include "sensor/camera_pose.h"

namespace pcl_sq::detail {

Eigen::Matrix3Xf CameraPose::toCamera(const CloudPoints& points) const {
  Eigen::Matrix3Xf moved(3, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    moved.col(i) =
        (camera_.rotation.transpose() * (points.col(i).cast<double>() - camera_.center))
            .cast<float>();
  return moved;
}

TableModel CameraPose::toCamera(TableModel table) const {
  table.offset = table.height(camera_.center);
  table.normal = camera_.rotation.transpose() * table.normal;
  return table;
}

ViewOptions CameraPose::toCamera(ViewOptions view) const {
  if (view.table)
    view.table = toCamera(*view.table);
  if (view.up)
    view.up = camera_.rotation.transpose() * *view.up;
  view.viewpoint.reset(); // the origin now
  return view;
}

TableModel CameraPose::toCloud(TableModel table) const {
  table.normal = camera_.rotation * table.normal;
  table.offset -= table.normal.dot(camera_.center);
  return table;
}

void CameraPose::toCloud(ObservedObject& observed, const CloudPoints& points) const {
  for (std::size_t i = 0; i < observed.columns.size(); ++i)
    observed.points.col(Eigen::Index(i)) =
        points.col(observed.columns[i]).cast<double>();
  if (observed.table)
    observed.table = toCloud(*observed.table);
  observed.camera.center = camera_.center;
  observed.camera.rotation = camera_.rotation;
}

} // namespace pcl_sq::detail

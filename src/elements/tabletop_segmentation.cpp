// SPDX-License-Identifier: BSD-3-Clause
#include "pcl_sq/tabletop_segmentation.h"

#include "observe/observe_parts.h"
#include "sensor/camera_pose.h"
#include "table/table_search.h"
#include "util/option_check.h"

namespace pcl_sq {

namespace {

using namespace detail;

/** \brief Table and thing in an image, where the cloud is one. */
bool findOnImage(const CloudPoints& points,
                 int width,
                 int height,
                 const std::vector<bool>& candidates,
                 const ViewOptions& view,
                 Standing& found) {
  ObservedObject observed;
  if (!findCamera(points, width, height, view.viewpoint, observed.camera))
    return false;
  const CameraPose pose(observed.camera);
  observed.camera.center.setZero();
  observed.camera.rotation.setIdentity();
  Eigen::Matrix3Xf moved;
  if (!pose.isIdentity())
    moved = pose.toCamera(points);
  const CloudPoints seen = pose.isIdentity() ? points : CloudPoints(moved);
  const ViewOptions moved_view = pose.isIdentity() ? view : pose.toCamera(view);
  if (candidates.empty())
    found = findInImage(seen, width, height, moved_view);
  else {
    CellMask region(width, height);
    for (std::size_t i = 0; i < candidates.size(); ++i)
      region.cells[i] = candidates[i] && seen.col(Eigen::Index(i)).allFinite();
    const std::vector<int> none;
    const Observation o{seen, width, height, none, moved_view, observed};
    found = findInRegion(o, region, true);
  }
  found.table = pose.toCloud(found.table);
  return true;
}

} // namespace

bool TabletopOptions::isValid(std::string* why) const {
  OptionCheck check(why);
  check.inRange("plane_distance", plane_distance, 0.0, 1e9);
  check.inRange("cluster_gap", cluster_gap, 0.0, 1e9);
  if (!check.passed())
    return false;
  ViewOptions view;
  view.viewpoint = viewpoint;
  view.up = up;
  view.table = table;
  return view.isValid(why);
}

bool findTabletopObject(const CloudPoints& points,
                        int width,
                        int height,
                        const std::vector<bool>& candidates,
                        const TabletopOptions& options,
                        TableModel& table,
                        std::vector<int>& object,
                        std::string* why) {
  object.clear();
  const auto fail = [why](const char* sentence) {
    if (why)
      *why = sentence;
    return false;
  };
  std::size_t finite = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    finite += points.col(i).allFinite();
  if (finite < MIN_TABLE_SCENE)
    return fail(
        "there are too few finite points for a table and an object; leave out the "
        "plane removal");
  ViewOptions view;
  view.viewpoint = options.viewpoint;
  view.up = options.up;
  view.table = options.table;
  Standing found;
  // own distances are those of a list
  const bool image = width > 1 && height > 1 && options.plane_distance == 0.0 &&
                     options.cluster_gap == 0.0 &&
                     findOnImage(points, width, height, candidates, view, found);
  if (!image)
    found = findInList(
        points, candidates, view, options.plane_distance, options.cluster_gap);
  if (found.thing.empty())
    return fail(found.planes == 0
                    ? "there is no table, that is no plane that holds a tenth of the "
                      "points; leave out the plane removal"
                    : "nothing stands on a plane of the cloud; give the region of the "
                      "object");
  table = found.table;
  object = std::move(found.thing);
  std::sort(object.begin(), object.end());
  return true;
}

} // namespace pcl_sq

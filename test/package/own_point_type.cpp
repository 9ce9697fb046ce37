// SPDX-License-Identifier: BSD-3-Clause
// A user's own point type without PCL_NO_PRECOMPILE, which the linker would not
// understand.
#include <pcl_sq/object_surface_estimation.h>

#include <pcl/point_types.h>

struct OwnPoint {
  PCL_ADD_POINT4D;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

int main() {
  pcl_sq::ObjectSurfaceEstimation<OwnPoint> estimation;
  return 0;
}

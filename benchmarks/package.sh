#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What the module costs its users: CPU seconds to compile a file that includes a header of
# pcl_sq (best of three, beside the empty file and PCL's own headers), size of the
# installed packages. Usage: benchmarks/package.sh [BUILD_DIR]
set -euo pipefail
cd "$(dirname "$0")/.."
build=$(cd "${1:-build}" && pwd)

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
flags="-std=c++17 -O2 -Iinclude -I$build/include $(pkg-config --cflags pcl_filters eigen3)"

# compile NAME LINE...: prints the CPU seconds of a file with these lines
compile() {
  local name=$1 best="" seconds
  shift
  printf '%s\n' "$@" >"$folder/user.cpp"
  for _ in 1 2 3; do
    # shellcheck disable=SC2086
    seconds=$({ TIMEFORMAT='%U %S'; time g++ $flags -c -o /dev/null "$folder/user.cpp"; } 2>&1 |
      awk '{printf "%.2f", $1 + $2}')
    best=$(printf '%s\n%s\n' "$best" "$seconds" | sed '/^$/d' | sort -n | head -n 1)
  done
  printf '%-44s %s s\n' "$name" "$best"
}

points='#include <pcl/point_types.h>'
compile "empty file" ""
compile "pcl/point_types.h" "$points"
compile "pcl/filters/voxel_grid.h" "$points" '#include <pcl/filters/voxel_grid.h>'
compile "pcl_sq/superquadric.h" '#include <pcl_sq/superquadric.h>'
compile "pcl_sq/object_surface_estimation.h" "$points" \
  '#include <pcl_sq/object_surface_estimation.h>'
compile "the same, estimate() called" "$points" \
  '#include <pcl_sq/object_surface_estimation.h>' \
  'bool f(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& cloud) {' \
  '  pcl_sq::ObjectSurfaceEstimation<pcl::PointXYZ> estimation;' \
  '  estimation.setInputCloud(cloud);' \
  '  pcl_sq::MultiSuperquadric model;' \
  '  return estimation.estimate(model);' \
  '}'
./scripts/check_packages.sh "$build"

#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# header_warnings.sh INCLUDE FLAGS...: whoever compiles with many warnings as errors, and
# our headers not as the system's, has none from them: neither from what they say nor from
# the templates' bodies. $CXX is the compiler.
set -eu
include=$1
shift
cd "$include"
{
  echo '#define PCL_NO_PRECOMPILE'
  for header in $(find pcl_sq -name '*.h' | sort); do
    # VTK and OpenCV are not everybody's
    case "$header" in
    */pcl_visualizer.h | pcl_sq/stereo/*) [ "${ALL_HEADERS:-}" ] || continue ;;
    esac
    echo "#include <$header>"
  done
  echo '#include <pcl/point_types.h>'
  for class in AdaptiveVoxelGrid GraspPointFilter ObjectSurfaceEstimation \
    PrismSegmentation RoiCrop RoiEstimator SceneEstimation TabletopSegmentation; do
    echo "template class pcl_sq::$class<pcl::PointXYZRGBL>;"
  done
} >"${TMPDIR:-/tmp}/pcl_sq_headers_$$.cpp"
trap 'rm -f "${TMPDIR:-/tmp}/pcl_sq_headers_$$.cpp"' EXIT
# words are wanted: the compiler may come with flags
# shellcheck disable=SC2086
$CXX -std=c++17 -fsyntax-only -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow \
  -Wnon-virtual-dtor -Wold-style-cast -Woverloaded-virtual -Werror -I. "$@" \
  "${TMPDIR:-/tmp}/pcl_sq_headers_$$.cpp"

#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# pkg_config.sh SOURCE PROGRAM: builds and runs a user's file with pkg-config alone.
set -eu
flags=$(pkg-config --cflags --libs pcl_sq_core)
case "$flags" in
*vtk* | *opencv*)
  echo "pcl_sq_core.pc asks for VTK or OpenCV: $flags" >&2
  exit 1
  ;;
esac
# words are wanted: both variables hold several arguments
# shellcheck disable=SC2086
$CXX -std=c++17 -o "$2" "$1" $flags
"$2"

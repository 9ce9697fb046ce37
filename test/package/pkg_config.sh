#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# pkg_config.sh COMPONENT OPTION SOURCE PROGRAM: builds and runs a user's file with
# pkg-config alone; OPTION is --static, or
# --print-errors where nothing is wanted (CMake drops empty arguments).
set -eu
# words are wanted here and below: each of these variables holds several arguments
# shellcheck disable=SC2086
flags=$(pkg-config --cflags --libs $2 "pcl_sq_$1")
case "$1 $flags" in
core*vtk* | core*opencv*)
  echo "pcl_sq_core.pc asks for VTK or OpenCV: $flags" >&2
  exit 1
  ;;
esac
# shellcheck disable=SC2086
$CXX -std=c++17 -o "$4" "$3" $flags
"$4"

#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# run.sh COMPONENT PROGRAM: runs a consumer; core's may load neither VTK nor OpenCV.
set -eu
"$2"
if [ "$1" = core ] && ldd "$2" | grep -E 'libvtk|libopencv'; then
  echo "The consumer of core loads VTK or OpenCV." >&2
  exit 1
fi

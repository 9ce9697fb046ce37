#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# examples.sh: runs every example of the current folder; those that read or write files
# are called with some, one's cloud being the next one's.
set -eu
./example_00_bottle_cloud bottle.pcd
for program in ./example_0*; do
  case "$program" in
  *00_bottle_cloud) continue ;;
  *05_camera_to_grasp) set -- bottle.pcd ;;
  *06_picture) set -- picture.png mesh.ply ;;
  *) set -- ;;
  esac
  echo "$program $*"
  "$program" "$@"
done
[ ! -x ./example_06_picture ] || [ -s picture.png ]

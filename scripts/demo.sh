#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The main job on sample data that the project makes itself: a bottle on a table, seen by a
# depth camera from one side. Leaves model.json, mesh.ply and picture.png in demo/.
set -euo pipefail
cd "$(dirname "$0")/.."
export PCL_SQ_BUILD_DIR=${PCL_SQ_BUILD_DIR:-build}
./scripts/build.sh example_00_bottle_cloud pcl_sq_fit
bin=$PCL_SQ_BUILD_DIR/bin

mkdir -p demo
"$bin/example_00_bottle_cloud" demo/bottle.pcd
"$bin/pcl_sq_fit" demo/bottle.pcd --remove-plane \
  -o demo/model.json --mesh demo/mesh.ply --snapshot demo/picture.png
echo "Written: $(cd demo && ls -d model.json mesh.ply picture.png | sed 's|^|demo/|' | xargs)"

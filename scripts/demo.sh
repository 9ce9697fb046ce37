#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The main job on sample data that the project makes itself: two rendered images of a bottle
# on a table -> cloud -> union of superquadrics, judged by the exact truth. Leaves
# model.json, mesh.ply, picture.png and panel.png (the steps side by side) in demo/.
set -euo pipefail
cd "$(dirname "$0")/.."
export PCL_SQ_BUILD_DIR=${PCL_SQ_BUILD_DIR:-build}
./scripts/build.sh pcl_sq_render pcl_sq_stereo pcl_sq_evaluate
bin=$PCL_SQ_BUILD_DIR/bin scene=demo/scene

mkdir -p demo
"$bin/pcl_sq_render" bottle --out "$scene"
"$bin/pcl_sq_stereo" "$scene/left.png" "$scene/right.png" --calib "$scene/calib.yml" \
  --matcher sgbm --wls -o demo/model.json --mesh demo/mesh.ply \
  --snapshot demo/picture.png --panel demo/panel.png
echo "Against the truth:"
"$bin/pcl_sq_evaluate" demo/model.json --truth "$scene/truth.json" --format table
echo "Written: demo/model.json demo/mesh.ply demo/picture.png demo/panel.png"

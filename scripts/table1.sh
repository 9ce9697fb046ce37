#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The paper's Table I, measured again: its bottle (53 x 350 mm at 1.134 m) is rendered
# as a stereo pair, goes through the paper's chain as one and as several superquadrics,
# with both matchers, and is judged against the exact truth.
#
#   scripts/table1.sh [FOLDER]      results and panels; default: a temporary folder
#
# SEED=n renders another texture and noise; BIN=dir is where the programs are;
# PRESET=best runs the default mode instead of the paper's.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
bin=${BIN:-$root/build/bin}
preset=${PRESET:-paper}
out=${1:-}
if [[ -z $out ]]; then
  out=$(mktemp -d)
  trap 'rm -rf "$out"' EXIT
fi
mkdir -p "$out"

"$bin/pcl_sq_render" bottle --out "$out/scene" --seed "${SEED:-1}" --quiet
# the 2D query: the object's box as a person would draw it, 8 px too large all around
roi=$(awk '/"roi"/ { f = 1; next } f && /[0-9]/ { gsub(/[^0-9]/, ""); n[++k] = $0 }
           f && /\]/ { exit }
           END { printf "%d,%d,%d,%d", n[1] - 8, n[2] - 8, n[3] + 16, n[4] + 16 }' \
  "$out/scene/truth.json")

# row NAME FILE...: the paper's columns out of pcl_sq_evaluate's table
row() {
  awk -v name="$1" '
    $1 == "superquadrics" { count = $2 }
    $1 == "width" || $1 == "height" || $1 == "thickness" { size[$1] = $2 / 1000 }
    /^centre error/ { error[$3] = $4 }
    /^axis error/ { axis = $3 }
    /^IoU/ { iou = $5 }
    /^D / { d = $NF }
    END {
      printf "%-28s %7.3f %7.3f %9.3f %7.1f %6.1f %6.1f %7.2f %9.4f %7s %6.3f\n", name,
        size["width"], size["height"], size["thickness"], error["x"], error["y"],
        error["z"], axis, d, count, iou }'
}

format='%-28s %7s %7s %9s %7s %6s %6s %7s %9s %7s %6s\n'
# shellcheck disable=SC2059
header() { printf "$format" "$@"; }
header approximation width height thickness dx dy dz axis D count IoU
header '' '[m]' '[m]' '[m]' '[mm]' '[mm]' '[mm]' '[deg]' '' '' ''
header 'paper: ground truth' 0.053 0.350 0.053 - - - - - - -
header 'paper: single' 0.065 0.362 0.057 -7 20 -3 2.6 5.7313 1 -
header 'paper: multiple' 0.057 0.349 0.057 -3 40 -3 2.6 2.0139 2 -
for matcher in bm sgbm; do
  for mode in single multiple; do
    args=(--preset "$preset")
    if [[ $preset == paper ]]; then
      decomposition=prisms
      [[ $mode == single ]] && decomposition=none
      args+=(--decomposition "$decomposition")
    elif [[ $mode == single ]]; then
      args+=(--parts 1)
    else
      args+=(--parts 2)
    fi
    name=${matcher}_$mode
    "$bin/pcl_sq_stereo" "$out/scene/left.png" "$out/scene/right.png" \
      --calib "$out/scene/calib.yml" --matcher "$matcher" --segment grabcut \
      --roi "$roi" "${args[@]}" --quiet --output "$out/$name.json" \
      --object-cloud "$out/$name.pcd" --panel "$out/$name.png"
    "$bin/pcl_sq_evaluate" "$out/$name.json" --truth "$out/scene/truth.json" \
      --cloud "$out/$name.pcd" --format table | row "$preset mode: $mode, $matcher"
  done
done

#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# plug_ins.sh PREFIX FOLDER: an installation that was moved loads no more than a run needs,
# finds its plug-ins, and says so where one is missing.
set -eu
rm -rf "$2"
mkdir -p "$2"
cp -a "$1" "$2/moved"
cd "$2"
for program in fit grasp scene stereo; do
  if ldd "moved/bin/pcl_sq_$program" | grep -E 'libvtk|libgdal|libpcl_io|imgcodecs'; then
    echo "pcl_sq_$program loads at its start what few runs need." >&2
    exit 1
  fi
done
moved/bin/pcl_sq_render can --rig vga --out scene -q
moved/bin/pcl_sq_stereo scene/left.png scene/right.png --calib scene/calib.yml --wls \
  -o model.json --cloud scene.pcd --mesh can.vtp --snapshot can.png -q
moved/bin/pcl_sq_snapshot model.json --cloud scene.pcd -o again.png -q
for file in can.vtp can.png again.png; do
  [ -s "$file" ]
done
find moved -name pcl_sq_vtk.so -delete
code=0
moved/bin/pcl_sq_snapshot model.json -o none.png 2>said || code=$?
[ "$code" = 1 ]
grep -F 'plug-in pcl_sq_vtk.so' said
[ ! -e none.png ]

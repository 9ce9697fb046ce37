#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the Debian packages of a build folder and checks what is in them:
#   check_packages.sh [BUILD_DIR]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}

fail() {
  echo "check_packages.sh: $*" >&2
  exit 1
}
rm -rf "$build/deb"
(cd "$build" && cpack -G DEB -B deb >cpack.log 2>&1) || {
  cat "$build/cpack.log" >&2
  fail "cpack failed"
}
field() { dpkg-deb -f "$1" "$2"; }
package() { echo "$build/deb/$1"_*.deb; }

core=$(package libpcl-sq-core) core_dev=$(package libpcl-sq-core-dev)
field "$core" Depends | grep libpcl-common >/dev/null || fail "core misses libpcl-common"
for deb in "$core" "$core_dev"; do
  field "$deb" Depends | grep -E 'libvtk|libopencv' && fail "$deb depends on VTK or OpenCV"
done
field "$core_dev" Depends | grep 'libpcl-sq-core (= ' >/dev/null || fail "core-dev misses core"
for file in pcl_sq/superquadric.h pcl_sq/config.h pcl_sqConfig.cmake pcl_sq_core.pc; do
  dpkg-deb -c "$core_dev" | grep "/$file$" >/dev/null || fail "core-dev misses $file"
done
dpkg-deb -c "$core_dev" | grep -E 'pcl_sq/(stereo|visualization)/' &&
  fail "core-dev holds another component's headers"
for deb in "$build"/deb/*.deb; do
  dpkg-deb -c "$deb" | awk '{print $6}' | grep -vE '^\./(usr/.*)?$' &&
    fail "$deb puts files outside of /usr"
  echo "$(basename "$deb"): $(field "$deb" Installed-Size) KiB installed"
done

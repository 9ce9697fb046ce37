#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the Debian packages of a build folder and checks what is in them, also by lintian:
#   check_packages.sh [BUILD_DIR]
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}
./scripts/install_deps.sh lintian dpkg-dev

fail() {
  echo "check_packages.sh: $*" >&2
  exit 1
}
rm -rf "$build/deb"
ninja -C "$build" build.ninja >/dev/null # cpack reads what cmake has written
(cd "$build" && cpack -G DEB -B deb >cpack.log 2>&1) || {
  cat "$build/cpack.log" >&2
  fail "cpack failed"
}
field() { dpkg-deb -f "$1" "$2"; }
# shellcheck disable=SC2086 # a pattern is wanted
package() { echo "$build"/deb/$1_*.deb; }

lib=usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH)
core=$(package 'libpcl-sq-core[0-9]*') core_dev=$(package libpcl-sq-core-dev)
doc=$(package libpcl-sq-doc)
# holds PACKAGE FILE...: the package has these files
holds() {
  local package=$1 file
  dpkg-deb -c "$package" | awk '{print $6}' >"$build/deb/files"
  shift
  for file in "$@"; do
    grep -x "./$file" "$build/deb/files" >/dev/null || fail "$package misses $file"
  done
}

field "$core" Depends | grep libpcl-common >/dev/null || fail "core misses libpcl-common"
for deb in $core $core_dev; do
  field "$deb" Depends | grep -E 'libvtk|libopencv' && fail "$deb depends on VTK or OpenCV"
done
field "$core_dev" Depends | grep 'libpcl-sq-core[0-9.]* (= ' >/dev/null ||
  fail "core-dev misses core"
holds "$core_dev" usr/include/pcl_sq/superquadric.h usr/include/pcl_sq/config.h \
  "$lib/cmake/pcl_sq/pcl_sqConfig.cmake" "$lib/pkgconfig/pcl_sq_core.pc" \
  "$lib/libpcl_sq_core.so"
dpkg-deb -c "$core_dev" | grep -E 'pcl_sq/(stereo|visualization)/' &&
  fail "core-dev holds another component's headers"
holds "$doc" usr/share/doc/pcl_sq/README.md usr/share/doc/pcl_sq/html/index.html \
  usr/share/doc/pcl_sq/examples/01_fit_one.cpp
if grep -q 'PCL_SQ_BUILD_PYTHON:BOOL=ON' "$build/CMakeCache.txt"; then
  python=$(package python3-pcl-sq) module=usr/lib/python3/dist-packages/pcl_sq
  holds "$python" $module/__init__.py $module/py.typed $module/_core.pyi $module/batch.py
  field "$python" Depends | grep 'python3-numpy' >/dev/null || fail "python3-pcl-sq misses numpy"
  field "$python" Depends | grep 'pcl-sq' && fail "python3-pcl-sq depends on another file"
  # as installed, without installing: this one file, from another folder than the build's
  rm -rf "$build/deb/root"
  dpkg-deb -x "$python" "$build/deb/root"
  PYTHONPATH="$build/deb/root/usr/lib/python3/dist-packages" /usr/bin/python3 -B -c \
    'import pcl_sq, pcl_sq._files, pcl_sq._render, pcl_sq._stereo
maps = [line.split()[-1] for line in open("/proc/self/maps") if "libpcl_sq" in line]
assert len(set(maps)) == 3 and all("/deb/root/" in file for file in maps), maps
assert pcl_sq.Superquadric([1, 1, 1]).distance([3.0, 0, 0]) == 2' ||
    fail "python3-pcl-sq does not import"
  rm -rf "$build/deb/root"
fi
# Debian's files have no run path: what loads plug-ins must know where they are
for file in "$(package 'libpcl-sq-visualization[0-9]*') $lib/libpcl_sq_visualization.so" \
  "$(package 'libpcl-sq-stereo[0-9]*') $lib/libpcl_sq_stereo.so" \
  "$(package pcl-sq-apps) usr/bin/pcl_sq_fit"; do
  dpkg-deb --fsys-tarfile "${file% *}" | tar -xO --wildcards "./${file#* }*" |
    grep -a "/$lib/pcl_sq-" >/dev/null || fail "${file#* } does not find its plug-ins"
done
# what policy asks of every package, and of the programs' man pages and completion
programs=$(cd apps && ls pcl_sq_*.cpp)
for deb in "$build"/deb/*.deb; do
  folder=usr/share/doc/$(field "$deb" Package)
  holds "$deb" "$folder/copyright" "$folder/changelog.Debian.gz"
  dpkg-deb -c "$deb" | awk '{print $6}' | grep -vE '^\./(usr/.*)?$' &&
    fail "$deb puts files outside of /usr"
  dpkg-deb -c "$deb" | grep -E ' \./usr/lib/[^/]*pcl_sq' && fail "$deb is not multiarch"
  echo "$(basename "$deb"): $(field "$deb" Installed-Size) KiB installed"
done
for program in $programs; do
  program=${program%.cpp}
  holds "$(package pcl-sq-apps)" "usr/bin/$program" "usr/share/man/man1/$program.1.gz" \
    "usr/share/bash-completion/completions/$program"
done
lintian --allow-root --fail-on error "$build"/deb/*.deb || fail "lintian found errors"

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what building, testing and running pcl_sq needs on Debian 12, and the packages
# named as arguments. Says nothing and takes no time when everything is there.
set -euo pipefail

packages=(
  build-essential cmake ninja-build ccache pkg-config git file
  libeigen3-dev libpcl-dev libopencv-dev libopencv-contrib-dev libvtk9-dev
  nlohmann-json3-dev libcli11-dev libqhull-dev libyaml-cpp-dev
  libgtest-dev libbenchmark-dev libceres-dev
  libx11-dev libgl-dev xvfb libgl1-mesa-dri
  clang-format-14 doxygen help2man python3
  pybind11-dev python3-dev python3-numpy
  python3-pytest python3-mypy python3-distributed python3-jsonschema
  liburdfdom-tools assimp-utils libsdformat-dev
  "$@"
)

# the names of the packages that are not installed
missing() {
  comm -23 <(printf '%s\n' "${packages[@]}" | sort -u) \
    <(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null |
      sed -n 's/^installed //p' | sort -u)
}

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  echo "install_deps.sh: this system has no apt; install PCL 1.12, OpenCV 4, VTK 9," \
    "CLI11, nlohmann-json, GoogleTest, Ninja and ccache with its own means." >&2
  exit 1
fi

needed=$(missing)
[ -z "$needed" ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install_deps.sh: needs root or sudo to install:" $needed >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing:" $needed
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o=Dpkg::Use-Pty=0 \
    "$@" </dev/null >>"$log" 2>&1
}
# package lists may be missing or old: fetch them, then install
if ! { apt update && apt install -y --no-install-recommends $needed; }; then
  tail -n 20 "$log" >&2
  echo "install_deps.sh: apt-get could not install:" $(missing) >&2
  exit 1
fi

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing and builds Release: build.sh [TARGET...], by default everything.
#   PCL_SQ_BUILD_DIR    build folder (default: build)
#   PCL_SQ_CMAKE_ARGS   further arguments of cmake, e.g. -DPCL_SQ_WERROR=ON
set -euo pipefail
cd "$(dirname "$0")/.."
build=${PCL_SQ_BUILD_DIR:-build}

./scripts/install_deps.sh
# a configured folder is kept up to date by ninja itself
if [ ! -f "$build/build.ninja" ] || [ -n "${PCL_SQ_CMAKE_ARGS:-}" ]; then
  log=$(mktemp)
  trap 'rm -f "$log"' EXIT
  if ! cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    ${PCL_SQ_CMAKE_ARGS:-} >"$log" 2>&1; then
    cat "$log" >&2
    exit 1
  fi
fi
ninja -C "$build" "$@"

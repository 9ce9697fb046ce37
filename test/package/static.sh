#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# static.sh SOURCE BUILD PREFIX OPTION...: builds the libraries as static ones and installs
# them into PREFIX.
set -eu
source=$1 build=$2 prefix=$3
shift 3
rm -rf "$prefix"
cmake -S "$source" -B "$build" -G Ninja -DBUILD_SHARED_LIBS=OFF -DPCL_SQ_BUILD_TESTS=OFF \
  -DPCL_SQ_BUILD_APPS=OFF -DPCL_SQ_BUILD_EXAMPLES=OFF -DPCL_SQ_BUILD_PYTHON=OFF "$@"
cmake --build "$build"
cmake --install "$build" --prefix "$prefix"
if find "$prefix" -name '*.so*' | grep .; then
  echo "BUILD_SHARED_LIBS=OFF made shared libraries." >&2
  exit 1
fi
find "$prefix" -name 'libpcl_sq_core.a' | grep . >/dev/null

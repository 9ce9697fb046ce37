#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# All tests but those of pictures and packages under ThreadSanitizer (clang: its OpenMP
# runtime tells the sanitizer about barriers). Arguments go to ctest.
set -euo pipefail
cd "$(dirname "$0")/.."
./scripts/install_deps.sh clang libomp-14-dev
[ -f build-tsan/build.ninja ] || cmake --preset tsan >/dev/null
cmake --build --preset tsan
ctest --preset tsan -LE package -j "$(nproc)" "$@"

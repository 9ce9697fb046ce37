#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Unit and pipeline tests under AddressSanitizer and UndefinedBehaviorSanitizer (clang).
# Arguments go to ctest.
set -euo pipefail
cd "$(dirname "$0")/.."
./scripts/install_deps.sh clang libclang-rt-14-dev libomp-14-dev llvm-14
[ -f build-dev/build.ninja ] || cmake --preset dev >/dev/null
cmake --build --preset dev --target pcl_sq_unit_tests pcl_sq_pipeline_tests
ctest --preset dev -L '^(unit|pipeline)$' -E 'fit_fuzz' -j "$(nproc)" "$@"

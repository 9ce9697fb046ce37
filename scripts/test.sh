#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds and runs all tests. Arguments go to ctest, e.g.
#   ./scripts/test.sh -L unit        (labels: unit pipeline app render package)
# PCL_SQ_BUILD_DIR and PCL_SQ_CMAKE_ARGS as in build.sh.
set -euo pipefail
cd "$(dirname "$0")/.."
./scripts/build.sh
ctest --test-dir "${PCL_SQ_BUILD_DIR:-build}" --output-on-failure -j "$(nproc)" "$@"

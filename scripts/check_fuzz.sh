#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs each fuzz target of test/fuzz (libFuzzer with AddressSanitizer) for some seconds:
#   check_fuzz.sh [SECONDS]
# The inputs are the same in each run as far as it comes.
# What ends one is left in build-fuzz/findings.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
build="build-fuzz"
./scripts/install_deps.sh clang libclang-rt-14-dev llvm-14
if [ ! -f "$build/build.ninja" ]; then
  CC=clang CXX=clang++ cmake -S . -B "$build" -G Ninja -DPCL_SQ_BUILD_FUZZERS=ON \
    -DCMAKE_CXX_FLAGS_RELEASE="-O1 -g1" -DPCL_SQ_BUILD_TESTS=OFF \
    -DPCL_SQ_BUILD_EXAMPLES=OFF -DPCL_SQ_UNITS=OFF >/dev/null
fi
ninja -C "$build" pcl_sq_fuzzers
mkdir -p "$build/findings"

# inputs beyond 10 s or 1 GiB are findings too
fuzz() {
  local name corpus
  name=$(basename "$1") corpus=$(mktemp -d)
  if "$1" -seed=1 -max_total_time="$2" -timeout=10 -rss_limit_mb=1024 -print_final_stats=1 \
    -artifact_prefix="$3/$name-" "$corpus" >"$3/$name.log" 2>&1; then
    echo "$name: $(sed -n 's/^stat::number_of_executed_units: *//p' "$3/$name.log") inputs"
  else
    tail -n 40 "$3/$name.log" >&2
    return 1
  fi
  rm -rf "$corpus"
}
export -f fuzz
printf '%s\0' "$build"/bin/*_fuzz |
  xargs -0 -P "$(nproc)" -I{} bash -c 'fuzz "$@"' fuzz {} "$seconds" "$build/findings"

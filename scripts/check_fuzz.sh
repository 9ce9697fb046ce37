#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs each fuzz target of test/fuzz (libFuzzer with the sanitizers) for some seconds:
#   check_fuzz.sh [SECONDS]
# The inputs are the same in each run as far as it comes.
# What ends one is left in build-dev/findings.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
build="build-dev"
./scripts/install_deps.sh clang libclang-rt-14-dev libomp-14-dev llvm-14
[ -f "$build/build.ninja" ] || cmake --preset dev >/dev/null
cmake --build --preset dev --target pcl_sq_fuzzers
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

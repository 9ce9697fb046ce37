#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# clang-tidy over libraries, programs and examples, fails on any finding; some 40 minutes on
# two cores: check_tidy.sh [FILE-PATTERN]
set -euo pipefail
cd "$(dirname "$0")/.."
build="build-tidy"
./scripts/install_deps.sh clang clang-tidy-14 libomp-14-dev
if [ ! -f "$build/build.ninja" ]; then
  cmake --preset tidy >/dev/null
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
# headers that cmake generates exist after configuring: nothing has to be built
if ! run-clang-tidy-14 -quiet -p "$build" "${1:-/(src|apps|examples)/}" >"$log" 2>&1; then
  tail -n 40 "$log" >&2
  exit 1
fi
# the analyzer also tells of libraries' headers, which are not ours to mend
if sed 's/\x1b\[[0-9;]*m//g' "$log" | grep -E "^$PWD/.*(warning|error): " | sort -u | grep .; then
  exit 1
fi

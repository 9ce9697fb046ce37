#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Fails where clang-format 14 would change a source file; check_format.sh --fix changes it.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=(--dry-run --Werror)
[ "${1:-}" = --fix ] && mode=(-i)
git ls-files -z '*.h' '*.hpp' '*.cpp' | xargs -0 -r clang-format-14 "${mode[@]}"

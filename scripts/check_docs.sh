#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Fails on any warning of doxygen: broken references, wrong parameters, classes and free
# functions without a word. Members that say it by their name (empty, size, getters) need
# none.
set -euo pipefail
cd "$(dirname "$0")/.."
warnings=$( (cat docs/Doxyfile && echo "WARN_IF_UNDOCUMENTED = YES") | doxygen - 2>&1 >/dev/null |
  grep -vE 'Member .* of (class|struct) .* is not documented\.$|^ *$' || true)
if [ -n "$warnings" ]; then
  echo "$warnings" >&2
  exit 1
fi

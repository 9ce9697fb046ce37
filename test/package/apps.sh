#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# apps.sh FOLDER VERSION: each installed program starts from there and tells its version.
set -eu
found=0
for program in "$1"/pcl_sq_*; do
  "$program" --version | grep -F "$2" >/dev/null || {
    echo "$program --version does not say $2" >&2
    exit 1
  }
  found=$((found + 1))
done
echo "$found programs"
[ "$found" -gt 0 ]

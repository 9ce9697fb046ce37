#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# headers.sh SENTENCE INCLUDE FLAGS...: every installed header below INCLUDE/pcl_sq stops
# the compiler $CXX, called with FLAGS, and says SENTENCE as its first error. (The one for
# users of PCL's viewer is left out: it needs VTK.)
set -eu
sentence=$1 include=$2
shift 2
cd "$include"
found=0
for header in $(find pcl_sq -name '*.h' ! -name pcl_visualizer.h | sort); do
  # words are wanted: the compiler may come with flags
  # shellcheck disable=SC2086
  said=$(echo "#include <$header>" |
    LC_ALL=C $CXX "$@" -I. -fmax-errors=1 -fsyntax-only -x c++ - 2>&1) || true
  case "$said" in
  *"$sentence"*) ;;
  *)
    echo "$header does not say '$sentence': $said" >&2
    exit 1
    ;;
  esac
  found=$((found + 1))
done
echo "$found headers"
[ "$found" -gt 50 ]

#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# headers.sh SENTENCE INCLUDE FLAGS...: whichever header below INCLUDE/pcl_sq a user's file
# comes with first, the compiler $CXX, called with FLAGS, stops and says SENTENCE as its
# first error: config.h does, and every header has it before anything else.
set -eu
sentence=$1 include=$2
shift 2
cd "$include"
first_include() {
  sed -n 's/^#include [<"]\([^>"]*\)[>"].*/\1/p' "$1" | head -n 1
}
found=0
for header in $(find pcl_sq -name '*.h' | sort); do
  first=$header
  while [ "$first" != pcl_sq/config.h ]; do
    before=$first
    [ -f "$first" ] && first=$(first_include "$first") || first=
    if [ -z "$first" ] || [ "$first" = "$before" ]; then
      echo "$header does not begin with pcl_sq/config.h, but with $before" >&2
      exit 1
    fi
  done
  found=$((found + 1))
done
echo "$found headers"
[ "$found" -gt 50 ]
for header in pcl_sq/config.h pcl_sq/scene_estimation.h; do
  # words are wanted: the compiler may come with flags
  # shellcheck disable=SC2086
  said=$(echo "#include <$header>" |
    LC_ALL=C $CXX "$@" -I. -Wfatal-errors -fsyntax-only -x c++ - 2>&1) || true
  case "$said" in
  *"$sentence"*) ;;
  *)
    echo "$header does not say '$sentence': $said" >&2
    exit 1
    ;;
  esac
done

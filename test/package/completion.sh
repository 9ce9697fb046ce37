#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# completion.sh PREFIX: bash completion of every installed program knows its options and
# their words; each program has a manual page.
set -euo pipefail
prefix=$1
PATH=$prefix/bin:$PATH

# complete_line WORD...: what is offered for the last word
complete_line() {
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  _pcl_sq
  echo " ${COMPREPLY[*]-} "
}
for path in "$prefix"/bin/pcl_sq_*; do
  program=$(basename "$path")
  # shellcheck source=/dev/null
  . "$prefix/share/bash-completion/completions/$program"
  complete -p "$program" >/dev/null
  [[ $(complete_line "$program" --ver) == " --version " ]] || {
    echo "$program --ver: $(complete_line "$program" --ver)" >&2
    exit 1
  }
  if command -v help2man >/dev/null; then
    zcat "$prefix/share/man/man1/$program.1.gz" | grep '^\.SH EXAMPLES' >/dev/null
  fi
done
[[ $(complete_line pcl_sq_fit cloud.pcd --preset "") == *" best "* ]]
[[ $(complete_line pcl_sq_fit cloud.pcd --preset pa) == " paper " ]]
[[ $(complete_line pcl_sq_fit "") == "  " ]] # files
echo "completion knows $(complete_line pcl_sq_fit - | wc -w) options of pcl_sq_fit"

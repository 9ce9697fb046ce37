#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# man_page.sh PROGRAM OUTPUT.gz: a manual page out of the program's own --help, by help2man.
set -eu
summary=$("$1" --help | sed -n '1s/\.$//p' | cut -c 1-200)
[ -n "$summary" ] || summary=$("$1" --help | head -n 1)
page=$(mktemp)
trap 'rm -f "$page"' EXIT
help2man --no-info --source="$("$1" --version)" --name="$summary" --output="$page" "$1"
# help2man would fill the examples to one paragraph
sed '/^\.SH EXAMPLES/,/^\.PP/ { s/^\.IP$/.IP\n.nf/; s/^\.PP$/.fi\n.PP/ }' "$page" |
  gzip -9n >"$2"

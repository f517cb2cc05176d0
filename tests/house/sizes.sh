#!/usr/bin/env bash
# Functions have at most 60 lines, and fewer than one file in eight has less than 40: a file is a thing that is worth a name.
set -u
cd "$2" || exit 1
long=$(find src lab -name '*.c' -print0 | xargs -0 awk '
  FNR == 1 { start = 0 }
  /^[A-Za-z_].*[(,]/ && !/;$/ { head = FNR; name = $0 } # where a definition begins, even where its parameters take several lines
  /\) \{$/ && head != 0 && start == 0 { start = head }
  /^}/ { if (start != 0 && FNR - start + 1 > 60) print FILENAME ":" start ": " FNR - start + 1 " lines: " name; start = head = 0 }')
[ -z "$long" ] || { echo "functions of more than 60 lines:"; echo "$long"; exit 1; }
read -r short all < <(find src -name '*.[ch]' -exec wc -l {} + | awk '$2 != "total" { ++all; short += $1 < 40 } END { print short, all }')
[ "$((8 * short))" -lt "$all" ] || { echo "$short of $all files have less than 40 lines"; exit 1; }

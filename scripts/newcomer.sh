#!/usr/bin/env bash
# What it costs to begin: runs the commands of docs/start.md, as they stand there, on this machine, and prints for each section how many
# commands they are, how many words one reads (the README as far as its link to that page, the page's head and the section), and the
# minutes they took, of the clock and of all processors. Meant for a bare Debian 12 in a clone, a fresh one for each section, as root: what
# is there already costs nothing. It installs packages, and writes below /usr/local.
#   scripts/newcomer.sh [SECTION]     its heading, or the beginning of one; all, where none is given
#   scripts/newcomer.sh --count       commands and words alone; nothing is run
# Exit status 1 where a command fails, 2 where there is no such section. The log of the commands goes to standard error.
set -euo pipefail
export PATH=/usr/local/bin:$PATH # as every login has it on Debian; the shell of a bare chroot may not
cd "$(dirname "$0")/.."
page=docs/start.md
count_only=false
if [ "${1:-}" = --count ]; then
  count_only=true
  shift
fi
mapfile -t sections < <(sed -n 's/^## //p' "$page" | grep "^${1:-}" || true)
[ ${#sections[@]} -gt 0 ] || { echo "newcomer.sh: $page has no section '$1'" >&2; exit 2; }
grep -q '](docs/start.md)' README.md || { echo "newcomer.sh: README.md does not lead to $page" >&2; exit 2; }

# The lines of a section (head: those before the first), and the commands of its block.
lines() { awk -v section="## $1" '/^## / { on = $0 == section; next } on' "$page"; }
commands() { lines "$1" | awk '/^```/ { inside = $0 == "```sh"; next } inside'; }
head_words=$({ sed '/](docs\/start.md)/q' README.md; sed '/^## /,$d' "$page"; } | wc -w)

printf '| from nothing to | commands | words to read | minutes | minutes of processors |\n|---|---|---|---|---|\n'
for section in "${sections[@]}"; do
  mapfile -t todo < <(commands "$section")
  [ ${#todo[@]} -gt 0 ] || continue # it only tells
  words=$((head_words + $(lines "$section" | wc -w)))
  row="| $section | ${#todo[@]} | $words |"
  if $count_only; then
    echo "$row | |"
    continue
  fi
  wall=0 cpu=0
  for command in "${todo[@]}"; do
    echo "+ $command" >&2
    TIMEFORMAT='%R %U %S'
    # The command's own output goes to standard error, the times of bash into a file.
    { time bash -c "$command" </dev/null >&3 2>&3; } 3>&2 2>newcomer.times || { echo "newcomer.sh: '$command' failed" >&2; exit 1; }
    read -r real user system <newcomer.times
    rm newcomer.times
    echo "  $real s, $(awk "BEGIN { print $user + $system }") s of processors" >&2
    wall=$(awk "BEGIN { print $wall + $real }") cpu=$(awk "BEGIN { print $cpu + $user + $system }")
  done
  awk -v row="$row" -v wall="$wall" -v cpu="$cpu" 'BEGIN { printf "%s %.1f | %.1f |\n", row, wall / 60, cpu / 60 }'
done

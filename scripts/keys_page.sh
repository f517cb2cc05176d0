#!/usr/bin/env bash
# Writes docs/keys.md, every key of every table of the program, to standard output: scripts/keys_page.sh PROGRAM.
# With --options, docs/options.md, every option of every command. With --words, the names of all kinds, things, keys and
# choices instead, as a dictionary for fuzzers (fuzz/keys.dict).
set -eu
program=$1
kinds='set measure integrator bsdf texture spectrum shape emitter sensor medium phase volume film rfilter sampler ignored refused image lab-integrator'

if [ "${2:-}" = --words ]; then
  for kind in $kinds; do
    echo "$kind"
    "$program" help "$kind" --format csv | tail -n +2 | cut -d, -f1 | while read -r name; do
      echo "$name"
      "$program" help "$kind" "$name" --format csv | awk -F, 'NR > 1 {
        print $1
        if (/,choice,/ && split($0, part, "\"") > 1) { gsub(/ /, "", part[2]); gsub(/,/, "\n", part[2]); print part[2] }
      }'
    done
  done | LC_ALL=C sort -u | sed 's/.*/"&"/'
  exit
fi

# Turns the CSV of keys into a table.
table() {
  awk '
  # Splits a line of CSV into field[1..count]; quotes may hold commas and doubled quotes.
  function split_csv(line, count, at, c, quoted, text) {
    count = 1; text = ""
    for (at = 1; at <= length(line); ++at) {
      c = substr(line, at, 1)
      if (quoted && c == "\"" && substr(line, at + 1, 1) == "\"") { text = text c; ++at }
      else if (c == "\"") quoted = !quoted
      else if (c == "," && !quoted) { field[count++] = text; text = "" }
      else text = text c
    }
    field[count] = text
  }
  NR == 1 { next }
  NR == 2 { print "\n| key | type | default | values | |\n|---|---|---|---|---|" }
  {
    split_csv($0)
    for (i = 1; i <= 5; ++i) gsub(/\|/, "\\|", field[i])
    printf "| `%s` | %s | %s | %s | %s |\n", field[1], field[2], field[3], field[4], field[5]
  }'
}

if [ "${2:-}" = --options ]; then
  cat <<'HEAD'
# Options

Every command of the program with its options, as `aureole help COMMAND` prints them. `scripts/keys_page.sh PROGRAM --options` writes this page.
HEAD
  "$program" help command --format csv | tail -n +2 | cut -d, -f1 | while read -r name; do
    printf '\n## %s\n\n`%s`: %s.\n' "$name" "$("$program" help command "$name" | head -1)" \
      "$("$program" help command --json | sed -n "s/.*\"name\": \"$name\", \"summary\": \"\(.*\)\"}.*/\1/p")"
    "$program" help command "$name" --format csv | table
  done
  exit
fi

cat <<'HEAD'
# Parameters

Every parameter (key) of sets, integrators, materials, textures, shapes, lights, cameras and films, in SET and
`--integrator` texts (`NAME:key=value,...`) and as children of a scene's elements. `aureole help KIND NAME` prints them; `scripts/keys_page.sh` writes this page.
HEAD
for kind in $kinds; do
  [ "$kind" = sampler ] && continue # the sets
  printf '\n## %s\n' "$kind"
  "$program" help "$kind" --format csv | tail -n +2 | cut -d, -f1 | while read -r name; do
    # The first paragraph says what it is.
    printf '\n`%s`: %s.\n' "$name" "$("$program" help "$kind" "$name" |
      awk -v head="$kind $name: " '!NF { exit } { text = text between $0; between = " " } END { print substr(text, length(head) + 1) }')"
    "$program" help "$kind" "$name" --format csv | table
  done
done

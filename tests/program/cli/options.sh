#!/usr/bin/env bash
# The options of every command: what is given wrongly is said with what would be right, help fits 80 columns and names every
# option, and what could be given before there was a table of options can still be given.
set -u
aureole=$1
status=0
fail() {
  echo "FAILED: $*"
  status=1
}
# refuses TEXT ARGUMENT...: exit status 2 and one line on standard error that has the text.
refuses() {
  local text=$1 code
  shift
  "$aureole" "$@" >out 2>err
  code=$?
  [ $code = 2 ] || fail "aureole $*: exit status $code"
  [ "$(wc -l <err)" = 1 ] || fail "aureole $*: $(cat err)"
  grep -qF -- "$text" err || fail "aureole $*: no '$text' in $(cat err)"
}
refuses "unknown option '--smothness'; did you mean '--smoothness'?" points sobol -n 4 --smothness 1.5
refuses "unknown option '--xyzzy': try 'aureole help points'" points sobol --xyzzy=3
refuses "unknown option '-x'" points sobol -qx
refuses "'--s' may be --size, --symmetry, --single, --smoothness, --scramble, --seed" points sobol --s 1
refuses "option '-n' needs a value" points sobol -n
refuses "option '--seed' needs a value" points sobol --seed
refuses "option '--quiet' takes no value" points sobol --quiet=yes
refuses "--size: must be at least 1, not '0'" points sobol -n 0
refuses "--size: must be below 2^64, not '18446744073709551616'" points sobol -n 18446744073709551616
refuses "--seed: must be below 2^64, not '18446744073709551616'" points sobol -n 4 --seed 18446744073709551616
refuses "--seed: must be at least 0, not '-1'" points sobol -n 4 --seed -1
refuses "--size: must be an integer, not '1e3'" points sobol -n 1e3
refuses "--samples: must be between 1 and 1073741824, not '0'" render a.xml --spp 0
refuses "--smoothness: must be between 1 and 6, both exclusive, not '6'" points sobol -n 4 --smoothness 6
refuses "--count: must be a size N of at least 1, A:B" measure sobol -n 4,0 --metric star
refuses "--format: must be one of table, csv, json, latex, not 'jsn'; did you mean 'json'?" sets --format jsn
refuses "--map: must be one of lambert, concentric, azimuthal, polar, not 'lamber'; did you mean 'lambert'?" \
  points sobol -n 4 --domain disk --map lamber
refuses "-o: 'image' has no extension: expected exr, pfm, hdr, png or jpg" render a.xml -o image
refuses "--to: must be one of exr, pfm, hdr, png, jpg, not 'gif'" convert a b --to gif
refuses "-D: 'width' is not of the form name=value" info a.xml -D width
refuses "unexpected argument 'halton'" points sobol halton -n 4
refuses "unexpected argument 'x'" sets sobol x
refuses "unknown set 'sobl'; did you mean 'sobol'?" sets sobl
refuses "must end in .svg, .pdf, .png or .tex" measure sobol -n 64 -m star --plot x.eps
[ ! -s out ] || fail "measured before the plot's format was refused"
"$aureole" sets halton | grep -q "permute" || fail "sets halton"

# Abbreviated, joined, in any order, after --, and the last one counts.
"$aureole" points -n4 --scr=none --seed 7 -q -o - -- sobol >new || fail "forms of options"
"$aureole" points sobol -n 9 -n 4 >old || fail "points"
cmp -s old new || fail "forms of options differ"
[ "$("$aureole" points sobol -n 4 --domain cube --dim 3 | head -1)" = u1,u2,u3 ] || fail "points of the cube"

# Help of every command fits a terminal and has every option that the table for programs has.
"$aureole" help command --format csv | tail -n +2 | cut -d, -f1 >verbs
[ "$(wc -l <verbs)" -ge 10 ] || fail "verbs: $(cat verbs)"
while read -r verb; do
  "$aureole" help "$verb" >help || fail "help $verb"
  "$aureole" "$verb" --help | cmp -s help || fail "$verb --help differs from help $verb"
  awk -v verb="$verb" 'length($0) > 80 { print "FAILED: " verb ": wider than 80: " $0; bad = 1 } END { exit bad }' help || status=1
  "$aureole" help command "$verb" --format csv | tail -n +2 | grep -oE -- '--[a-z0-9-]*[a-z0-9]' | sort -u | while read -r option; do
    grep -q -- "  $option\|, $option" help || echo "$verb: help has no $option"
  done >missing
  [ -s missing ] && fail "$(cat missing)"
done <verbs
"$aureole" help | awk 'length($0) > 80 { print "FAILED: help is wider than 80: " $0; bad = 1 } END { exit bad }' || status=1
exit $status

#!/usr/bin/env bash
# docs/keys.md, docs/options.md and fuzz/keys.dict say what the program's tables say, and the tables of
# docs/rendering.md have the integrators' keys and defaults.
set -u
program=$1 source_tree=$2
status=0
bash "$source_tree/scripts/keys_page.sh" "$program" >keys.md
bash "$source_tree/scripts/keys_page.sh" "$program" --words >keys.dict
bash "$source_tree/scripts/keys_page.sh" "$program" --options >options.md
for pair in docs/keys.md docs/options.md fuzz/keys.dict; do
  if ! diff "$source_tree/$pair" "${pair##*/}" >difference; then
    echo "$pair is not what scripts/keys_page.sh prints:"
    head -10 difference
    status=1
  fi
done
# The tables of docs/rendering.md with a column of defaults have every key of their section's integrator, and its default:
# one default for all keys of a row, or one for each; blank where the text says it.
awk '
  function clean(text) { gsub(/[`(]/, " ", text); split(text, word, " "); return word[1] }
  /^## / { section = $2 }
  /^### Keys of / { section = $4 }
  /^\| key \| default/ { on = 1; next }
  !/^\|/ { on = 0 }
  on && /^\| `/ {
    split($0, cell, "|")
    keys = split(cell[2], key, ","); values = split(cell[3], value, ",")
    for (i = 1; i <= keys; ++i) print section, clean(key[i]), clean(value[keys == 1 || values == 1 ? 1 : i])
  }' "$source_tree/docs/rendering.md" >told
grep '^### Keys\|^## Keys$\|^|' "$source_tree/docs/papers/gathering.md" |
  awk '/^## Keys/ { on = 1 } on && /^\| `/ { split($0, cell, "|"); gsub(/[`, ]+/, "\n", cell[2]); print cell[2] }' | grep . | sort >told_lab
"$program" help lab-integrator finalgather-lab --format csv | tail -n +2 | cut -d, -f1 | sort | diff - told_lab >difference ||
  { echo "docs/papers/gathering.md: other keys than finalgather-lab has:"; cat difference; status=1; }
for integrator in finalgather radiosity ao; do
  "$program" help integrator "$integrator" --format csv | tail -n +2 | awk -F, '{ split($3, word, " "); print $1, word[1] }' >known
  awk -v integrator="$integrator" '
    function bad(what) { print "docs/rendering.md: " integrator ": " what; status = 1 }
    FNR == NR { known[$1] = $2; next }
    $1 != integrator { next }
    !($2 in known) { bad("there is no key " $2) }
    $3 != "" && $3 != known[$2] { bad("the default of " $2 " is " known[$2] ", not " $3) }
    { told[$2] }
    END { for (key in known) if (!(key in told)) bad("the key " key " is missing"); exit status }' known told || status=1
done
exit $status

#!/usr/bin/env bash
# docs/keys.md, docs/options.md and fuzz/keys.dict say what the program's tables say, and docs/papers/gathering.md has the
# keys of the lab's integrator.
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
grep '^### Keys\|^## Keys$\|^|' "$source_tree/docs/papers/gathering.md" |
  awk '/^## Keys/ { on = 1 } on && /^\| `/ { split($0, cell, "|"); gsub(/[`, ]+/, "\n", cell[2]); print cell[2] }' | grep . | sort >told_lab
"$program" help lab-integrator finalgather-lab --format csv | tail -n +2 | cut -d, -f1 | sort | diff - told_lab >difference ||
  { echo "docs/papers/gathering.md: other keys than finalgather-lab has:"; cat difference; status=1; }
exit $status

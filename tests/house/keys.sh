#!/usr/bin/env bash
# docs/keys.md, docs/options.md and fuzz/keys.dict say what the program's tables say.
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
exit $status

#!/usr/bin/env bash
# docs/keys.md, docs/options.md and fuzz/keys.dict say what the program's tables say, and every key of the table of finalgather that
# docs/rendering.md explains is one.
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
# Defaults in the tables of docs/rendering.md, where a row names one key.
known=$("$program" help integrator finalgather --format csv | tail -n +2 | cut -d, -f1)
sed -n '/^## finalgather/,/^### Weights/p' "$source_tree/docs/rendering.md" | grep '^| `' | cut -d'|' -f2 |
  grep -o '`[a-z_]*`' | tr -d '`' >told
while read -r key; do
  grep -qx "$key" <<<"$known" || { echo "docs/rendering.md: finalgather has no key '$key'"; status=1; }
done <told
for key in $known; do
  grep -qx "$key" told || { echo "docs/rendering.md: finalgather's key '$key' is missing"; status=1; }
done
exit $status

#!/usr/bin/env bash
# What the documents point to exists: every relative link, and in CONTRIBUTING.md every type, header and table of the list
# of what can be added.
set -u
cd "$2" || exit 1
status=0
wrong() { echo "$*"; status=1; }

while IFS= read -r document; do
  folder=$(dirname "$document")
  while IFS= read -r target; do
    target=${target%%#*}
    [ -z "$target" ] || [ -e "$folder/$target" ] || wrong "$document: nothing is at '$target'"
  done < <(grep -oE '\]\([^)]+\)' "$document" | sed -E 's/^\]\(//; s/\)$//' | grep -vE '^(https?|mailto):')
done < <(find . -name '*.md' -not -path './build/*' -not -path './out/*' -not -path './.git/*')

shopt -s globstar
# So does every file of ours that a comment names, by its path or alone in brackets.
while IFS=: read -r file name; do
  name=${name#\(}
  name=${name%)}
  [ -e "src/$name" ] || [ -e "$name" ] || compgen -G "src/**/$name" >/dev/null || compgen -G "include/*/$name" >/dev/null || wrong "$file names $name, which is not there"
done < <(grep -roE '\((points|render|lighting|program)?[a-z0-9_/]+\.[ch]\)' src --include='*.[ch]' | sort -u)

rows=0
while IFS='|' read -r _ what write table _; do
  rows=$((rows + 1))
  table=$(sed -E 's/^ *`([^`]*)`.*/\1/' <<<"$table")
  [ -e "$table" ] || { wrong "CONTRIBUTING.md:$what: no table $table"; continue; }
  grep -qE ': an? `' <<<"$write" || continue # a row that names no type
  folder=$(sed -E 's/^ *`([^`]*)\/[^`]*`.*/\1/' <<<"$write")
  type=$(sed -E 's/.*: an? `([^`]*)`.*/\1/' <<<"$write")
  header=$(sed -E 's/.*\(`([^`]*)`\).*/\1/' <<<"$write")
  grep -qE "\b$type\b" "$table" || wrong "CONTRIBUTING.md:$what: $table knows no $type"
  place=$(dirname "$table")/$header
  [ -e "$place" ] || place=$folder/$header
  [ -e "$place" ] || place=$header
  grep -qE "\b$type\b" "$place" || wrong "CONTRIBUTING.md:$what: $place knows no $type"
done < <(grep -E '^\| an? ' CONTRIBUTING.md)
[ "$rows" -ge 7 ] || wrong "CONTRIBUTING.md has lost its table"
exit $status

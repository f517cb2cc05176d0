#!/usr/bin/env bash
# The page of all sets is made from the table of sets: none is missing there, and its images are in the tree.
set -u
aureole=$1
docs=$2/docs
status=0
while IFS=, read -r set _; do
  [ "$set" = set ] && continue
  grep -q "^| \*\*\`$set\`\*\*" "$docs/sets.md" ||
    { echo "docs/sets.md does not show '$set': run scripts/draw_sets.sh"; status=1; }
done < <("$aureole" sets --format csv)
pictures=$(grep -o 'sets/[a-z0-9-]*\.svg' "$docs/sets.md")
[ "$(wc -w <<<"$pictures")" -gt 30 ] || { echo "docs/sets.md shows too few images"; status=1; }
for picture in $pictures; do
  [ -s "$docs/$picture" ] || { echo "docs/$picture is missing: run scripts/draw_sets.sh"; status=1; }
done
exit $status

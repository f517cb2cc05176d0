#!/usr/bin/env bash
# A room includes only its own headers and those of rooms below it; the program and the lab include public headers only.
set -u
source_tree=$2
# From the top floor to the ground.
rooms=(cli lab render transport quality quadrature scene material sphere image pointset core)
status=0
floor_of() { for i in "${!rooms[@]}"; do [ "${rooms[$i]}" = "$1" ] && { echo "$i"; return; }; done; echo -1; }
for room in "${rooms[@]}"; do
  here=$(floor_of "$room")
  while IFS=: read -r file line text; do
    target=$(sed -E 's/.*"([a-z_]+)\/.*/\1/' <<<"$text")
    there=$(floor_of "$target")
    if [ "$there" -lt 0 ]; then echo "$file:$line: unknown room '$target'"; status=1; fi
    if [ "$there" -lt "$here" ]; then echo "$file:$line: $room must not call $target, which is above it"; status=1; fi
    if [ "$room" = cli ] && [ "$target" != cli ] && [ "$target" != lab ]; then
      echo "$file:$line: the program uses <aureole/...> only"; status=1; fi
    if [ "$room" = lab ] && [ "$target" != lab ]; then
      echo "$file:$line: the lab uses <aureole/...> only"; status=1; fi
  done < <(grep -nHE '^#include "[a-z_]+/' "$source_tree/src/$room/"*.[ch] 2>/dev/null)
  for public in "$source_tree/include/aureole/"*.h; do
    grep -nE '^#include "' "$public" && { echo "$public: public headers include <aureole/...> only"; status=1; }
  done
done
# No C file may stand outside a room.
for folder in "$source_tree"/src/*/; do
  [ "$(floor_of "$(basename "$folder")")" -ge 0 ] || { echo "$folder is not a room"; status=1; }
done
exit $status

#!/usr/bin/env bash
# Every "$ aureole ..." of the README's console blocks prints what stands below it.
set -u
program=$1
awk '/^```/ { inside = ($0 == "```console"); next } inside' "$2/README.md" >session
grep -q '^\$ aureole ' session || { echo "README.md has no session"; exit 1; }
while IFS= read -r line; do
  printf '%s\n' "$line"
  case $line in "$ aureole "*) (cd "$2" && eval "\"\$program\" ${line#??aureole }") 2>&1 ;; esac
done < <(grep '^\$ ' session) >printed
diff session printed || { echo "README.md shows something else than the program prints"; exit 1; }

#!/usr/bin/env bash
# The programs of examples/ know the public headers alone and are short; each compiles and runs as its first comment says,
# and this file has what must come out.
set -u
build=$(dirname "$1")
source_tree=$2
[ -e "$build/libaureole.so" ] || { echo "skipped: the libraries are static"; exit 77; }
fail() { echo "$*"; exit 1; }
cc=$(sed -n 's/^CMAKE_C_COMPILER:[^=]*=//p' "$build/CMakeCache.txt")
flags=
grep -q '^AUREOLE_SANITIZE:BOOL=ON' "$build/CMakeCache.txt" && flags=-fsanitize=address,undefined
for file in "$source_tree"/examples/*.c; do
  name=$(basename "$file" .c)
  [ "$(wc -l <"$file")" -lt 100 ] || fail "$name.c: 100 lines or more"
  grep -q '#include "' "$file" && fail "$name.c: includes more than <...>"
  "$cc" -std=c17 -Wall -Wextra -Werror $flags -I "$source_tree/include" "$file" -o "$name" -L "$build" -laureole -lm \
    -Wl,-rpath,"$build" || fail "$name.c does not compile"
  ./"$name" >"$name.txt" || fail "$name failed"
done

# The error is within three intervals, which are a thousandth of the power.
awk '$1 == "power" { power = $2 } $1 == "interval" { interval = $2 } $1 == "off" { off = $3 }
     END { exit !(power > 0 && interval <= 1e-3 * power && off <= 3 * interval) }' integrate.txt || fail "$(cat integrate.txt)"
grep -q "ended by *the tolerance" integrate.txt || fail "$(cat integrate.txt)"
exit 0

#!/usr/bin/env bash
# aureole nearest: each point is nearest to itself, on every domain; bad input is refused with status 2 and one line.
set -u
aureole=$1
fail() { echo "$*"; exit 1; }
for domain in square sphere hemisphere axes rotations; do
  "$aureole" points sobol -n 32 --domain $domain --scramble owen -o $domain.csv || fail "points on $domain"
  "$aureole" nearest $domain.csv $domain.csv --domain $domain --format csv >own.csv || fail "nearest on $domain"
  awk -F, 'NR > 1 && ($1 != $2 || $3 > 1e-7) { bad = 1 } END { exit bad || NR != 33 }' own.csv || fail "$domain: not itself"
  "$aureole" nearest sobol -n 32 $domain.csv --domain $domain --scramble owen --format csv | cmp -s - own.csv ||
    fail "$domain: the set is not its file"
done
"$aureole" points sobol -n 10 --dim 5 -o cube.csv -q || fail "the cube"
[ "$("$aureole" nearest cube.csv cube.csv -k 3 --format csv | wc -l)" = 31 ] || fail "three neighbours in a cube"
refuse() {
  "$aureole" nearest "$@" >out.txt 2>err.txt
  [ $? = 2 ] || fail "nearest $*: not refused"
  [ "$(wc -l <err.txt)" = 1 ] || fail "nearest $*: $(cat err.txt)"
}
refuse
refuse sobol
refuse sobol sphere.csv
refuse sobol nothing.csv -n 4
refuse sobl sphere.csv -n 4
refuse sphere.csv square.csv
refuse sphere.csv sphere.csv -k 33
refuse super-fibonacci sphere.csv -n 4

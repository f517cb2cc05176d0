#!/usr/bin/env bash
# The quick forms of the experiments of docs/domains.md: they run, and what they say holds.
set -u
aureole=$1
fail() { echo "$*"; cat table.csv; exit 1; }
for name in axes grids prefixes; do
  "$aureole" lab run domains-$name --quick -q --format csv -o results >table.csv || fail "domains-$name"
  cp table.csv $name.csv
done
# What is at rest has the least energy, to the last bits of its sum; a prefix and a shell have a few per cent more.
awk -F, '$1 ~ /^electrostatic/ && !($5 > -1e-9 && $5 < 6) { bad = 1 } END { exit bad || NR != 8 }' axes.csv || { cp axes.csv table.csv; fail "axes"; }
# The first row is the grid's base twice: 250 and 500 rotations.
awk -F, 'NR > 1 && !($3 > 1 && $3 < 1.2 && $4 < 1 && $5 < 1.4) { bad = 1 } END { exit bad || NR != 3 }' grids.csv ||
  { cp grids.csv table.csv; fail "grids"; }
# Charges at rest are the most even, the spiral next, and every prefix is behind both.
awk -F, 'NR == 2 { rest = $3 } NR == 3 && !($3 > rest) { bad = 1 } NR == 3 { spiral = $3 } NR > 3 && !($3 > spiral) { bad = 1 }
  END { exit bad || NR != 8 }' prefixes.csv || { cp prefixes.csv table.csv; fail "prefixes"; }
"$aureole" lab run domains-prefixes --quick -q --set golden-set -o results >table.csv 2>&1 || fail "one more set"
grep -q "golden-set  *the first n" table.csv || fail "one more set"
exit 0

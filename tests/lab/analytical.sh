#!/usr/bin/env bash
# The analytical lighting cases in their quick form: references of two derivations agree to 1e-9, every point is within 3 % of
# its case's largest value, none is beyond five standard errors, and as many are outside of their intervals as chance
# allows. The experiment says so itself; here its words are held against its table.
set -u
program=$1
rm -rf out && mkdir out || exit 1
"$program" lab run analytical-cases --quick -q --threads 1 -o out >out/table.txt || { cat out/table.txt; exit 1; }
awk -F, '/^#/ || $1 == "case" { next }
         { ++rows; points += $3; outside += $7
           if (!($3 >= 5 && $4 <= 1e-9 && $5 <= 3e-2 && $6 <= 5)) { print "FAILED: " $0; bad = 1 } }
         END { exit bad || rows != 34 || points < 330 || outside > 10 }' out/analytical-cases.csv || { cat out/table.txt; exit 1; }
grep -q '^# verdict: all holds' out/analytical-cases.csv || { cat out/table.txt; exit 1; }
# The same numbers on three threads.
cut -d, -f1-7 out/analytical-cases.csv | grep -v '^#' >out/one.csv
"$program" lab run analytical-cases --quick -q --threads 3 -o out >/dev/null || exit 1
cut -d, -f1-7 out/analytical-cases.csv | grep -v '^#' | cmp - out/one.csv

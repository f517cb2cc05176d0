#!/usr/bin/env bash
# The quick forms of Keller's tables: every row has a published number or says that there is none, the deviations fall with
# N, and the ratio and spread that do not depend on the scene are what they must be.
set -u
aureole=$1
source=$2
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
for table in 1 2 3; do
  "$aureole" lab run keller-1994-table$table --quick -q --scenes "$source/scenes" -o results >table$table.txt 2>&1 ||
    fail "table $table: $(cat table$table.txt)"
done
csv=results/keller-1994-table
awk -F, '!/^#/ && NR > 1 { ++rows; if (!($5 <= $4 && $4 <= $6 && $4 >= 3000 && $8 > 0.4 && $8 < 2.5)) bad = 1 }
         END { exit !(rows == 6 && !bad) }' ${csv}1.csv || fail "table 1: $(cat ${csv}1.csv)"
for table in 2 3; do
  awk -F, '!/^#/ && NR > 1 { ++rows; if (!($5 <= $4 && $4 <= $6)) bad = 1; if ($2 == 1000) first[$1 $3] = $4
                             if ($2 == 10000 && !($4 < 0.75 * first[$1 $3])) bad = 1 }
           END { exit !(rows == 12 && !bad) }' ${csv}$table.csv || fail "table $table: $(cat ${csv}$table.csv)"
done
# By algebra, for 12 equal triangles; and the corridor in the published range.
awk -F': ' '/Delta_a \/ Delta_aw of the cube/ { cube = $2 } /1 x 1 x 26/ { box = $2 }
            END { exit !(cube > 3.463 && cube < 3.465 && box > 7.9 && box < 11) }' ${csv}2.csv || fail "the ratios: $(cat ${csv}2.csv)"
# Independent points: 8 solutions of a skewed quantity each, within 30 %; two scenes.
awk '/Delta_aw sqrt N of independent/ {
       ++scenes
       for (i = 1; i < NF; ++i) if ($i == "points") { uniform = $(i + 1); cosine = $(i + 6) }
       if (!(uniform > 0.117 && uniform < 0.217 && cosine > 0.1 && cosine < 0.188)) bad = 1 }
     END { exit !(scenes == 2 && !bad) }' ${csv}3.csv || fail "the spread: $(grep independent ${csv}3.csv)"
exit $((failures > 0))

#!/usr/bin/env bash
# The lab as a user meets it: the list, an experiment in its quick form, and names that do not exist.
set -u
aureole=$1
source=$2
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

"$aureole" lab list | grep -q '^marques-2013-gather .*Marques 2013' || fail "the list"
rm -rf results
"$aureole" lab run marques-2013-gather --quick -q --scenes "$source/scenes" -o results >table.txt || fail "the run"
cat table.txt
# A row a component and pattern, each interval about its value, and Sobol's error above spherical Fibonacci's.
awk -F, '!/^#/ && NR > 1 { ++rows; if (!($5 <= $4 && $4 <= $6 && $4 > 0)) bad = 1; rmse[$1 "/" $2] = $4 }
         END { exit !(rows == 4 && !bad && rmse["diffuse/sobol"] > rmse["diffuse/spherical-fibonacci"] &&
                      rmse["glossy/sobol"] > rmse["glossy/spherical-fibonacci"]) }' \
  results/marques-2013-gather.csv || fail "the table"
grep -q '^# bias of finalgather against path' results/marques-2013-gather.csv || fail "the bias"
for picture in diffuse-reference glossy-error-sobol finalgather path; do
  [ -s "results/marques-2013-gather-$picture.png" ] || fail "no picture $picture"
done

# Table 1: 2 components x 2 maps x 2 rivals of spherical Fibonacci, each interval about its ratio; no rival is better than
# chance allows (a quarter below it would be), and all means together are worse.
"$aureole" lab run marques-2013-table1 --quick -q --scenes "$source/scenes" -o results >table.txt || fail "the run of table 1"
cat table.txt
awk -F, '/^#/ || $1 == "scene" { next }
         { ++rows; if (!($5 > 0 && $7 <= $6 && $6 <= $8 && $6 > 0.75 && $9 > 0 && $10 >= 1 && $11 > 512)) bad = 1; sum += log($6) }
         END { exit !(rows == 8 && !bad && sum > 0) }' results/marques-2013-table1.csv || fail "the table of table 1"
# Rows that are named are made alone, with the same figures.
cp results/marques-2013-table1.csv all.csv
"$aureole" lab run marques-2013-table1 --quick -q --scenes "$source/scenes" -o results --rows '*/diffuse/lambert/sobol' >table.txt ||
  fail "rows by name"
diff <(grep -v '^#' results/marques-2013-table1.csv) <(grep -E '^scene|,diffuse,lambert,sobol' all.csv) || fail "other figures of one row"
"$aureole" lab run marques-2013-gather --quick --rows '*' 2>message.txt && fail "rows without names"
grep -q "rows of 'marques-2013-gather' have no names" message.txt || fail "$(cat message.txt)"

# Ambient occlusion: 5 sets x 2 counts x 2 forms, each interval about its value; every set below random numbers at 64
# samples, where even the least of the gains is 2; and errors that are independent from pixel to pixel only where the set is
# randomised for each: banding is 1 then, up to its own scatter of about .1, and above 1.2 when it is not.
"$aureole" lab run schretter-2012-fig5 --quick -q --scenes "$source/scenes" -o results >table.txt || fail "the run of fig. 5"
cat table.txt
awk -F, '/^#/ || $1 == "pattern" { next }
         { ++rows; if (!($5 <= $4 && $4 <= $6 && $4 > 0)) bad = 1
           if ($2 == 64 && $1 != "random" && !($7 < 0.6)) bad = 1
           if ($3 == "pixel" ? !($8 > 0.7 && $8 < 1.3) : !($8 > 1.2)) bad = 1 }
         END { exit !(rows == 20 && !bad) }' results/schretter-2012-fig5.csv || fail "the table of fig. 5"
[ -s results/schretter-2012-fig5-golden-set-16-pixel.png ] || fail "no picture of fig. 5"
"$aureole" lab run marques-2031 2>message.txt && fail "an unknown experiment runs"
[ $? -le 2 ] && grep -q "marques-2031.*lab list" message.txt || fail "$(cat message.txt)"
"$aureole" lab 2>/dev/null
[ $? -eq 2 ] || fail "lab without a word"
exit $((failures > 0))

#!/usr/bin/env bash
# aureole weights through the program: golden figures, the sum of weights, two lobes, tables, images, bad input.
set -u
program=$1
rm -rf work && mkdir work && cd work || exit 1
fail() { echo "$*"; exit 1; }
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { d = a - b; exit !((d < 0 ? -d : d) <= t * b) }'; }
column() { # FILE NAME [ROW]: one cell of a CSV
  awk -F, -v name="$2" -v row="${3:-1}" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) c = i }
    NR == row + 1 { print $c }' "$1"
}
check() { near "$(column "$1" "$2" "${5:-1}")" "$3" "$4" || fail "$1: $2 is $(column "$1" "$2" "${5:-1}"), not $3"; }

sf=spherical-fibonacci
"$program" weights $sf -n 64 --lobe cosine --regularization 0 --unconstrained --report --format csv >diffuse || exit 1
check diffuse equal 3.451313401060e-2 1e-9
check diffuse weighted 3.299058614880e-2 1e-9
check diffuse weight_sum .998357445867 1e-9
# A gain is the part of the error that is saved; four digits are printed.
gain() { awk -v plain="$(column "$1" "$2")" -v weighted="$(column "$1" weighted)" 'BEGIN { print 100 * (plain - weighted) / plain }'; }
check diffuse gain_percent "$(gain diffuse equal)" 1e-3
"$program" weights $sf -n 64 --lobe phong:20 --regularization 0 --unconstrained --report --format csv >glossy || exit 1
check glossy equal 2.284681166476e-2 1e-9
check glossy weighted 2.130088901918e-2 1e-9
# A system that is nearly a multiple of the identity has the condition 1; three digits are printed.
"$program" weights $sf -n 64 --lobe cosine --regularization 1e6 --unconstrained --report --format csv >identity || exit 1
check identity condition 1 .005
# The optimal density: plain weights p/q, and optimal ones.
"$program" weights $sf -n 64 --lobe phong:20 --density optimal --regularization 0 --unconstrained --report \
  --format csv >dense || exit 1
check dense ratio 2.078e-2 2.5e-4
check dense weighted 2.055e-2 5e-4
check dense gain_percent "$(gain dense ratio)" 1e-3

# x,y,z,w: a header, 17 digits, weights of sum 1, and a file that goes in comes out the same.
"$program" weights sobol -n 32 --lobe cosine -o points.csv || exit 1
[ "$(head -1 points.csv)" = "x,y,z,w# domain: hemisphere" ] || fail "header $(head -1 points.csv)"
[ "$(wc -l <points.csv)" = 33 ] || fail "$(wc -l <points.csv) lines"
near "$(awk -F, 'NR > 1 { s += $4 } END { printf "%.17g", s }' points.csv)" 1 1e-12 || fail "sum of weights"
"$program" weights points.csv --lobe cosine >again.csv || exit 1
cmp points.csv again.csv || fail "weights of a file differ from weights of its set"
"$program" weights sobol -n 32 --domain sphere --method equal | awk -F, 'NR > 1 && $4 != 0.03125 { exit 1 }' ||
  fail "equal weights are 1/N"

# Exact to a degree: the golden figures of spherical Fibonacci sets; weights that go in as a file are kept where they do.
"$program" weights $sf -n 1000 --domain sphere --method exact --report --format csv >exact || exit 1
check exact degree 30 0
check exact least .869413059 1e-6
check exact largest 1.138763250 1e-6
awk -v r="$(column exact residual)" 'BEGIN { exit !(r <= 1.5e-15) }' || fail "residual $(column exact residual)"
"$program" weights sobol -n 256 --lobe cosine --method exact --degree 4 -o exact.csv || exit 1
"$program" weights exact.csv --lobe cosine --method exact --degree 4 --near >kept.csv || exit 1
paste -d, exact.csv kept.csv | awk -F, 'NR > 1 { d = $4 - $8; if (d < -1e-15 || d > 1e-15) exit 1 }' || fail "weights near to exact ones"
"$program" weights $sf -n 300 --cap 30 --method exact --report --format csv | grep -q ",exact," || fail "a cap"
"$program" weights esfg -n 256 --domain sphere --method exact --degree 4 --levels 64,128,256 -o nested.csv || exit 1
awk -F, 'NR == 1 { if ($0 != "x,y,z,w,w2,w3") exit 1; next } { a += $4; b += $5; c += $6; if (NR > 65 && $4 != 0) exit 1 }
  END { exit !(a > 1 - 1e-14 && a < 1 + 1e-14 && b > 1 - 1e-14 && b < 1 + 1e-14 && c > 1 - 1e-14 && c < 1 + 1e-14) }' nested.csv ||
  fail "nested weights"
printf 'x,y,z\n0,0,1\n0,0,1\n0,0,-1\n' >doubled.csv
"$program" weights doubled.csv --domain sphere --method exact >shared.csv 2>message || exit 1
grep -q "share" message || fail "doubled points: $(cat message)"
[ "$(tail -1 shared.csv)" = "0,0,-1,0.5" ] || fail "doubled points: $(cat shared.csv)"
"$program" weights sobol -n 256 --domain sphere --method voronoi --report --format csv >cells || exit 1
awk -v a="$(column cells weighted)" -v b="$(column cells equal)" 'BEGIN { exit !(a < b) }' || fail "gain of Voronoi cells"

# GGX: the ratio weights carry the masking, and both they and the optimal ones leave hidden samples out.
for method in ratio osw; do
  "$program" weights sobol -n 256 --lobe ggx:0.3:70 --method $method --report --format csv >ggx.$method || exit 1
  "$program" weights sobol -n 256 --lobe ggx:0.3:70 --method $method |
    awk -F, 'NR > 1 && $3 < 0 { n++; if ($4 != 0) exit 1 } END { exit n == 0 }' || fail "GGX: hidden samples"
done
near "$(column ggx.ratio weight_sum)" 1 0.02 || fail "GGX: sum of ratio weights"
awk -v a="$(column ggx.osw weighted)" -v b="$(column ggx.ratio weighted)" 'BEGIN { exit !(a < b) }' || fail "GGX: gain"

# Two lobes: OSWA has the lowest error of all methods for both.
for method in osw mis mis-power equal oswa; do
  "$program" weights sobol -n 128 --n2 64 --lobe cosine --lobe2 phong:20 --angle 65 --clip --method $method \
    --scramble digit --report --format csv >two.$method || exit 1
done
for row in 1 2; do
  best=$(column two.oswa weighted $row)
  near "$(column two.oswa weight_sum $row)" 1 1e-10 || fail "OSWA sum"
  awk -v a="$best" -v b="$(column two.osw weighted $row)" 'BEGIN { exit !(a < b) }' || fail "OSWA against OSW"
  for method in mis mis-power equal; do
    awk -v a="$best" -v b="$(column two.$method weighted $row)" 'BEGIN { exit !(a < b) }' || fail "OSWA against $method"
  done
done
"$program" weights sobol -n 16 --n2 8 --lobe cosine --lobe2 ggx:0.3 --angle 80 >two.csv || exit 1
[ "$(head -1 two.csv)" = "x,y,z,w,w2# domain: hemisphere" ] || fail "header of two lobes"
awk -F, 'NR > 1 && $3 < 0 && ($4 != 0 || $5 != 0) { exit 1 }' two.csv || fail "hidden samples have weight 0"

# Tables: the same file whatever the threads.
table() { "$program" weights $sf -n 16 --n2 8 --lobe cosine --lobe2 phong:20 --clip --angles 9 --rotations 2 "$@"; }
table --table a.table -t 1 && table --table b.table -t 4 || exit 1
cmp a.table b.table || fail "a table depends on the threads"
head -1 a.table | grep -q "aureole weight table" || fail "what a table says of itself"

# Read back: without a set any table will do, with one it must be that of the options.
table --table a.table --lookup 83 --rotation 1 -o entry.csv || exit 1
"$program" weights --table a.table --lookup 83 --rotation 1 >same.csv || exit 1
cmp entry.csv same.csv || fail "a look-up depends on the options that were given again"
[ "$(head -1 entry.csv)" = "x,y,z,w,w2" ] || fail "header of a look-up: $(head -1 entry.csv)"
awk -F, 'NR > 1 { a += $4; b += $5; n++; if ($3 < -1e-6 && ($4 != 0 || $5 != 0)) exit 1; if ($3 < 0) h++ }
  END { exit !(n == 24 && h > 0 && a > 0.999999 && a < 1.000001 && b > 0.999999 && b < 1.000001) }' entry.csv ||
  fail "weights of a look-up"
# The samples as a file of points, solved again: the same weights for the first lobe, whose samples all count here.
"$program" weights $sf -n 16 --n2 8 --lobe cosine --lobe2 phong:20 --angles 9 --rotations 1 --table whole.table || exit 1
"$program" weights --table whole.table --lookup 22.5 >looked.csv || exit 1
cut -d, -f1-3 looked.csv >samples.csv
"$program" weights samples.csv --lobe cosine --method osw >solved.csv || exit 1
paste -d, looked.csv solved.csv | awk -F, 'NR > 1 { d = $4 - $9; if (d < -1e-6 || d > 1e-6) exit 1 } END { exit NR != 25 }' ||
  fail "a look-up at an angle of the table is not the solve of its samples"
"$program" weights --table a.table --lookup 83 --rotation 1 --mirrored >image.csv || exit 1
paste -d, entry.csv image.csv | awk -F, 'NR > 1 && ($2 + $7 != 0 || $5 != $10) { exit 1 }' || fail "the mirror image"
"$program" info a.table --format csv >described || exit 1
[ "$(column described set) $(column described angles) $(column described rotations)" = "$sf 9 2" ] ||
  fail "info of a table: $(cat described)"

# A ggx lobe alone, over roughness too: a look-up at a node is the solve of its samples, and sums stay 1 between.
rough() { "$program" weights $sf -n 12 --lobe ggx:0.25 --roughnesses 3 --angles 7 --rotations 2 "$@"; }
rough --table rough.table || exit 1
rough --table rough.table --lookup 60 --roughness 0.5 --rotation 1 >rough.csv || exit 1
[ "$(head -1 rough.csv)" = "x,y,z,w" ] || fail "header of one lobe's look-up: $(head -1 rough.csv)"
cut -d, -f1-3 rough.csv >samples.csv
"$program" weights samples.csv --lobe ggx:0.5:60 --method osw >solved.csv || exit 1
paste -d, rough.csv solved.csv | awk -F, 'NR > 1 { d = $4 - $8; if (d < -1e-5 || d > 1e-5) exit 1 } END { exit NR != 13 }' ||
  fail "a look-up at a roughness of the table is not the solve of its samples"
"$program" weights --table rough.table --lookup 71 --roughness 0.7 |
  awk -F, 'NR > 1 { s += $4; if ($3 < 0 && $4 != 0) exit 1 } END { exit !(s > 0.999999 && s < 1.000001) }' || fail "between roughnesses"
[ "$("$program" info rough.table --format csv | tail -1 | tr , '\n' | grep -c "^3$")" = 1 ] || fail "info of roughnesses"

"$program" weights random -n 50 --lobe cosine --plot "it's.svg" || fail "plot"
grep -q "</svg>" "it's.svg" || fail "no picture"
"$program" weights random -n 50 --lobe cosine --plot no/such/folder.svg 2>/dev/null && fail "a plot nowhere"

# Where memory is short the weights are found or refused; they are not waited for.
for limit in 150000 200000 250000; do
  (ulimit -v $limit; timeout 60 "$program" weights random -n 2000 --lobe cosine >/dev/null 2>&1)
  [ $? != 124 ] || fail "2000 samples within $limit KiB of addresses take for ever"
done

refused() { # PATTERN COMMAND...: exit status 2, one line on standard error, nothing on standard output
  local pattern=$1; shift
  "$program" weights "$@" >out 2>message; local status=$?
  [ $status -eq 2 ] || fail "weights $*: status $status"
  [ ! -s out ] || fail "weights $*: wrote to standard output"
  [ "$(wc -l <message)" -eq 1 ] || fail "weights $*: $(cat message)"
  grep -q -- "$pattern" message || fail "weights $*: $(cat message)"
}
printf 'x,y,z\n0,0,1\n0,0.5,0.5\n' >off.csv
refused "length 1" off.csv --lobe cosine
printf 'x,y,z\n0,0,1\n0,0,-1\n' >below.csv
refused "below the hemisphere" below.csv --lobe cosine
printf 'u,v\n0.5,0.5\n' >square.csv
refused "cannot be used with a file" points.csv --lobe cosine --density optimal
refused "x,y,z" square.csv --lobe cosine
refused "exponent" sobol -n 8 --lobe phong:-1
refused "exponent\|nan" sobol -n 8 --lobe phong:nan
refused "away from integers" sobol -n 8 --lobe cosine --smoothness 3
refused "smoothness" sobol -n 8 --lobe cosine --smoothness 1
refused "regularization" sobol -n 8 --lobe cosine --regularization -1
refused "sobol" sobl -n 8 --lobe cosine
refused "-n is missing" sobol --lobe cosine
refused "no such file" nothing.csv --lobe cosine
refused "lobe2" sobol -n 8 --lobe cosine --method oswa
refused "lobe2" sobol -n 8 --lobe cosine --clip
refused "angle" sobol -n 8 --lobe cosine --lobe2 phong:20
refused "hemisphere" sobol -n 8 --domain sphere --lobe cosine
refused "no set or file" --lobe cosine
refused "must be one of" sobol -n 8 --method best
refused "1024 polynomials of degree 31" $sf -n 1000 --domain sphere --method exact --degree 31
refused "negative weights, the least of them -" random -n 256 --domain sphere --method exact --degree 13
refused "for --method exact" sobol -n 8 --lobe cosine --degree 3
refused "only a file" sobol -n 8 --lobe cosine --method exact --near
refused "level 1 has 9 points" sobol -n 8 --lobe cosine --method exact --levels 4,9
refused "not 'x'" sobol -n 8 --lobe cosine --method exact --levels 4,x
refused "one lobe" sobol -n 8 --lobe cosine --lobe2 phong:20 --angle 3 --method exact
"$program" weights random -n 300 --cap 30 --method voronoi >cap.csv || fail "cells of a cap"
"$program" weights cap.csv --cap 30 --method voronoi | cmp - cap.csv || fail "cells of a file's cap"
"$program" voronoi cap.csv --cap 30 --format csv |
    awk -F, 'NR > 1 { area += $5; sr += $6 } END { exit !(area > 299.99 && area < 300.01 && sr > .84178 && sr < .84180) }' ||
    fail "areas of a cap's cells: 300 means, 2 pi (1 - cos 30)"
refused "outside the cap of 20 degrees" cap.csv --cap 20 --method voronoi
refused "for --method exact and voronoi" sobol -n 8 --cap 20 --method osw
refused "whole hemisphere" sobol -n 8 --cap 20 --lobe cosine --method voronoi
"$program" voronoi cap.csv --cap 30 --cells cells.obj 2>/dev/null && fail "corners of a cap's cells"
refused "for the domain sphere" sobol -n 8 --domain hemisphere --cap 120 --method exact
"$program" weights $sf -n 100 --cap 120 --method exact >wide.csv || fail "a wide cap"
"$program" weights $sf -n 100 --domain sphere --cap 120 --method exact | cmp - wide.csv || fail "a wide cap is of the sphere"
"$program" weights wide.csv --cap 120 --method exact | cmp - wide.csv || fail "a wide cap of a file"
refused "degree must be at most 64" sobol -n 8 --lobe ggx:0.3 --method exact --degree 65
refused "needs negative weights" $sf -n 100 --lobe ggx:.3:30 --method exact --degree 6
refused "at least 1, not '0'" sobol -n 0 --method exact
refused "at least 1, not '0'" sobol -n 0 --method osw
for n in 1 2; do
    for how in "--method exact" "--method osw" "--method equal" "--lobe ggx:.3:30 --method exact"; do
        # shellcheck disable=SC2086
        "$program" weights sobol -n $n $how -q |
            awk -F, 'NR > 1 { sum += $4 } END { exit !(NR == '$n' + 1 && sum > .9999999 && sum < 1.0000001) }' ||
            fail "$n points, $how"
    done
done
"$program" weights doubled.csv --domain sphere --method voronoi | tail -n +2 | cut -d, -f4 | paste -sd' ' | grep -qx '0.25 0.25 0.5' || fail "halves of the sphere"
# Tables: of another set, of other options, of another version, damaged, not there.
refused "'spherical-fibonacci', not 'sobol'" sobol -n 16 --n2 8 --lobe cosine --lobe2 phong:20 --clip --table a.table --lookup 10
refused "exponent of the mirror lobe: 20, not 21" $sf -n 16 --n2 8 --lobe cosine --lobe2 phong:21 --clip --table a.table --lookup 10
refused "another clipping" $sf -n 16 --n2 8 --lobe cosine --lobe2 phong:20 --table a.table --lookup 10
sed 's/^version 3$/version 9/' a.table >other.table
refused "version 9; this program reads version 3" --table other.table --lookup 10
head -c -9 a.table >cut.table
refused "damaged" --table cut.table --lookup 10
refused "not a weight table" --table points.csv --lookup 10
refused "rotations 0 to 1" --table a.table --lookup 10 --rotation 2
refused "lookup" --table a.table --lookup 100
refused "roughnesses from 0.25 to 1, not 0.2" --table rough.table --lookup 10 --roughness 0.2
refused "one only, or none" --table a.table --lookup 10 --roughness 0.5
refused "for a --table of a ggx lobe" $sf -n 8 --lobe cosine --lobe2 phong:20 --roughnesses 2 --table no.table
refused "or one that is ggx" $sf -n 8 --lobe cosine --table no.table
refused "table FILE" --lookup 10
refused "cannot" --table nothing.table --lookup 10
# Beyond memory: what it would take.
"$program" weights random -n 2000000 --lobe cosine >/dev/null 2>message && fail "two million samples"
grep -q "GiB" message || fail "$(cat message)"
exit 0

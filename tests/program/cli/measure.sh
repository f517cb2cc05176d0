#!/usr/bin/env bash
# aureole measure: golden figures as a user sees them, and what it says about bad input.
set -u
program=$1
status=0
fail() { echo "FAILED: $*"; status=1; }
# prints WORDS COMMAND...: succeeds and prints the words.
prints() { local words=$1; shift; local out; out=$("$@" 2>&1) || fail "$* exits with $?: $out"
  grep -qF -- "$words" <<<"$out" || fail "$* does not print '$words': $out"; }
# refuses WORDS COMMAND...: exits with 2 and one line on standard error that has the words.
refuses() { local words=$1; shift; local out; out=$("$@" 2>&1 >stdout); local code=$?
  [ $code = 2 ] || fail "$* exits with $code, not 2"
  [ "$(wc -l <<<"$out")" = 1 ] || fail "$* says more than one line: $out"
  grep -qF -- "$words" <<<"$out" || fail "$* does not say '$words': $out"; }
rm -f ./*.csv
# Points are read from CSV and NPY; other formats that are written say so.
for format in ply json svg png; do
  "$program" points spherical-fibonacci -n 8 --domain sphere -o "foreign.$format" || fail "points in $format"
  refuses "read from CSV and NPY, not from ${format^^}" "$program" measure "foreign.$format" --metric energy
done
measure="$program measure"

prints 0.00498051 $measure spherical-fibonacci -n 1024 --domain sphere --metric energy
prints '"energy": 0.00498051' $measure spherical-fibonacci -n 1024 --metric energy --format json
prints 'spherical-fibonacci,1024,sphere,0.00498051' $measure spherical-fibonacci -n 1024 --metric energy --format csv
prints 0.0360748 $measure spherical-fibonacci -n 64 --domain hemisphere --metric energy
prints 0.00333786 $measure larcher-pillichshammer -n 1024 --metric star
prints riesz:S $measure --list
# Over seeds the mean, the sample's standard deviation and the root mean square of the single figures.
$measure random -n 64 --domain sphere --seeds 3 --seed 5 --metric energy,riesz:1 --format csv | tail -1 | cut -d, -f4- | tr , ' ' >several
for seed in 5 6 7; do $measure random -n 64 --domain sphere --seed $seed --metric energy,riesz:1 --format csv | tail -1 | cut -d, -f4-; done |
  cat several - | tr , ' ' | awk 'function near(a, b) { return (a / b - 1) ^ 2 < 1e-18 }
    NR == 1 { for (i = 1; i <= 6; ++i) said[i] = $i; next } { for (m = 0; m < 2; ++m) { sum[m] += $(m + 1); squares[m] += $(m + 1) ^ 2 } }
    END { for (m = 0; m < 2; ++m) good += near(said[3 * m + 1], sum[m] / 3) && near(said[3 * m + 2], sqrt((squares[m] - sum[m] ^ 2 / 3) / 2)) &&
            near(said[3 * m + 3], sqrt(squares[m] / 3))
          exit good != 2 }' || fail "figures over seeds: $(cat several)"
prints energy-rms $measure sobol -n 64 --scramble digit --seeds 3 --metric energy

printf 'x,y,z\n1,0,0\n-1,0,0\n0,1,0\n0,-1,0\n0,0,1\n0,0,-1\n' >octahedron.csv
prints 0.239146 $measure octahedron.csv --metric energy
printf 'x,y,z,w\n0,0,1,3\n0,0,-1,3\n' >pair.csv
prints 0.57735 $measure pair.csv --metric energy

printf 'x,y,z\n1,0,0\n0,1.000002,0\n' >off.csv
refuses off.csv:3 $measure off.csv --metric energy
printf 'x,y,z\n1,0,0\n0,nan,0\n' >nan.csv
refuses nan.csv:3 $measure nan.csv --metric energy
prints 0.0345131 $measure spherical-fibonacci -n 64 --domain hemisphere --lobe cosine --metric wce:1.5:cosine
refuses 'not for the sphere' $measure octahedron.csv --metric star
refuses 'point 6 has z' $measure octahedron.csv --domain hemisphere --metric energy
refuses 'did you mean' $measure octahedron.csv --metric enrgy
refuses -n $measure sobol --metric star
# Without --metric, all measures; --size is another name of --count.
[ "$($measure sobol -n 4)" = "$($measure sobol --size 4 --metric all)" ] || fail 'measure without --metric'
refuses 'at least 2 points' $measure sobol -n 1 --metric min-distance
refuses no-such $measure no-such-set -n 4 --metric energy
printf 'x,y,z,w\n1,0,0,1\n# a comment\n0,1,0,-0.5\n0,0,1,1\n' >negative.csv
refuses "not for caps" $measure sobol -n 64 --cap 30 --metric energy
refuses negative.csv:4 $measure negative.csv --domain sphere --metric cap
prints 1.1547 $measure negative.csv --domain sphere --metric energy
printf '1,0,0\n0,0,-1\n' >low.csv
refuses low.csv:2 $measure low.csv --domain hemisphere --metric energy
printf 'x,y,z\n1,0,0\n1,0,0\n' >twice.csv
prints inf $measure twice.csv --metric riesz:1
prints coincide $measure twice.csv --metric riesz:1
prints null $measure twice.csv --metric riesz:1 --format json -q
# A bound holds for the difference to the sum over all pairs, and is within the accuracy.
$measure random -n 20000 --domain sphere --metric energy --format csv >exact
$measure random -n 20000 --domain sphere --metric energy --accuracy 1e-4 --format csv >bounded
[ "$(head -1 bounded)" = set,n,domain,energy,energy-error ] || fail "columns: $(head -1 bounded)"
paste -d, <(tail -1 exact) <(tail -1 bounded) | awk -F, '{ off = $8 - $4; exit !((off < 0 ? -off : off) <= $9 && $9 > 0 && $9 <= 1e-4 * $4) }' ||
  fail "bounds: $(cat exact bounded)"
refuses --accuracy $measure random -n 64 --metric energy --accuracy -1
refuses accuracy $measure random -n 64 --metric energy --accuracy 1
refuses 'cannot be combined' $measure sobol -n 16 --metric spectrum,star
prints 'degree' $measure sobol -n 16 --metric spectrum:2 --domain sphere
prints 'kx,ky,power' $measure sobol -n 16 --metric periodogram:2 --format csv

# A session that is interrupted prints the rows that it has finished and says so.
"$program" measure random -n 64,1000000 --domain sphere --metric energy -t 1 >kept.txt 2>message.txt &
job=$!
# Half a second of its own time: the first row is long finished, the second takes minutes.
for ((i = 0; i < 600; ++i)); do
  [ "$(cut -d' ' -f14 /proc/$job/stat 2>/dev/null || echo 0)" -ge 50 ] && break
  sleep 0.1
done
kill -INT $job
wait $job
[ $? = 3 ] || fail "an interrupted measure does not exit with 3"
grep -q '64  sphere' kept.txt || fail "finished rows are lost on interrupt: $(cat kept.txt)"
grep -q 'interrupted after 1 finished row' message.txt || fail "no word of the interrupt: $(cat message.txt)"

rm -f slopes.svg spectrum.png
prints 'slope -0.7513' $measure spherical-fibonacci -n 64,128,256,512,1024,2048,4096,8192,16384 --metric energy --plot slopes.svg
grep -q 'slope -0.751' slopes.svg || fail "the plot does not show the slope"
prints power $measure jittered -n 64 --metric spectrum --plot spectrum.png
[ -s spectrum.png ] || fail "no plot of the spectrum"
path=$(printf 'n\nof three\nlines.svg')
$measure sobol -n 16,32,64 --metric star --plot "$path" 2>/dev/null && grep -q '</svg>' "$path" ||
  fail "no plot at a path of three lines"
refuses 'must end in' $measure sobol -n 4 --metric energy --plot slopes.txt
refuses 'logarithmic' $measure sobol -n 4 --metric net --plot slopes.svg
# The page for newcomers knows every measure.
[ "$($measure --list --format csv | wc -l)" -gt 20 ] || fail "--list is short"
for name in $($measure --list --format csv | tail -n +2 | cut -d, -f1 | cut -d: -f1 | cut -d'[' -f1); do
  grep -q "\`$name[\`:\[]" "$2/docs/measures.md" || fail "docs/measures.md does not name $name"
done

# Ranges of sizes, each end included, and all figures of a domain beside the same asked for one by one.
sizes() { $measure sobol -q -n "$1" --metric star --format csv | tail -n +2 | cut -d, -f2 | paste -sd' '; }
[ "$(sizes 4:32)" = "4 8 16 32" ] || fail "-n 4:32 is $(sizes 4:32)"
[ "$(sizes 4:40:x3,7)" = "4 12 36 7" ] || fail "-n 4:40:x3,7 is $(sizes 4:40:x3,7)"
[ "$(sizes 2:9:x1.2)" = "2 3 4 5 6 7 9" ] || fail "-n 2:9:x1.2 is $(sizes 2:9:x1.2)"
[ "$(sizes 10:20:5)" = "10 15 20" ] || fail "-n 10:20:5 is $(sizes 10:20:5)"
for range in 8:4 4:8:x1 4:8:0 4:8:2:2 0:4 :4 4:; do
  refuses "A:B" $measure sobol -n $range --metric star
done
for points in "sobol -n 16" "spherical-fibonacci -n 16" "spherical-fibonacci -n 16 --cap 40" "octahedron.csv" "sobol -n 16 --dim 3"; do
  # shellcheck disable=SC2086 # words
  all=$($measure $points -q --metric all --format csv) || fail "--metric all of $points: $all"
  names=$(head -1 <<<"$all" | cut -d, -f4-)
  [ "$(tr -cd , <<<"$names" | wc -c)" -ge 2 ] || fail "--metric all of $points is $names"
  domain=$(tail -1 <<<"$all" | cut -d, -f3)
  # shellcheck disable=SC2086
  [ "$all" = "$($measure $points -q --domain "$domain" --metric "$names" --format csv)" ] || fail "--metric all of $points is not $names"
done
refuses "cannot be combined" $measure sobol -n 4 --metric all,star
# A net has a power of its base as its size: such a figure is left out, and said.
prints "no net: a net in base 2" $measure halton -n 8,12 --metric all
[ "$($measure halton -q -n 8,12 --metric all --format csv |
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "net") at = i } { print $at }' | paste -sd' ')" = "net 3 nan" ] ||
  fail "--metric all of 12 points: $($measure halton -q -n 8,12 --metric all --format csv)"
refuses "--domain" $measure - --metric all <octahedron.csv
prints 0.239146 $measure - --domain sphere --metric all <octahedron.csv
exit $status

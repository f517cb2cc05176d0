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
measure="$program measure"

prints 0.00498051 $measure spherical-fibonacci -n 1024 --domain sphere --metric energy
prints '"energy": 0.00498051' $measure spherical-fibonacci -n 1024 --metric energy --format json
prints 'spherical-fibonacci,1024,sphere,0.00498051' $measure spherical-fibonacci -n 1024 --metric energy --format csv
prints 0.0360748 $measure spherical-fibonacci -n 64 --domain hemisphere --metric energy
prints 0.00333786 $measure larcher-pillichshammer -n 1024 --metric star
prints riesz:S $measure --list
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
refuses --metric $measure sobol -n 4
refuses 'at least 2 points' $measure sobol -n 1 --metric min-distance
refuses no-such $measure no-such-set -n 4 --metric energy
exit $status

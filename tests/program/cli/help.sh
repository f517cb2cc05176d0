#!/usr/bin/env bash
# aureole help: the commands, what there is of each kind, the keys of each thing, and the nearest name after a mistake.
set -u
aureole=$1
status=0
fail() {
  echo "FAIL: $*"
  status=1
}
expect() { # STATUS TEXT ARGUMENT...: the exit status, and what the output must hold
  local wanted=$1 text=$2 output
  shift 2
  output=$("$aureole" "$@" 2>&1)
  [ $? = "$wanted" ] || fail "aureole $*: exit status"
  grep -qF -- "$text" <<<"$output" || fail "aureole $*: no '$text' in: $output"
}
expect 0 "the parameters of one:" help
expect 0 "aureole render SCENE [MODEL...] [OPTION...]" help render
expect 0 "measure the quality of points" help measure # the command: its measures are listed by --list
expect 0 "final gathering over a photon map" help integrator
expect 0 "diffuse_samples" help integrator finalgather
expect 0 "hide_emitters" help integrator path
expect 0 "measure energy: distance energy" help measure energy
expect 0 "final gathering over a photon map" help integrators
expect 0 "measure the quality of points" measure -h
expect 2 "did you mean 'integrator'?" help integrater
expect 2 "unknown command 'rendr'; did you mean 'render'?" rendr
expect 0 "$("$aureole" --version)" -V
expect 0 "$("$aureole" --version)" version
expect 2 "did you mean 'finalgather'?" help integrator finalgathr
expect 2 "unknown command 'xyzzyplugh'" help xyzzyplugh
expect 2 "one command, or a kind and a name" help set sobol more
# Every row of every kind can be asked for, and its keys come as CSV, one a line.
for kind in set measure integrator shape emitter sensor rfilter film picture; do
  "$aureole" help "$kind" --format csv | tail -n +2 | cut -d, -f1 >names
  [ -s names ] || fail "no $kind"
  "$aureole" help "$kind" --format table >listing
  [ "$kind" != measure ] || "$aureole" measure --list >listing
  while read -r name; do
    grep -q -- "^  $name\b" listing || fail "help $kind: no $name"
    "$aureole" help "$kind" "$name" >>text || fail "help $kind $name"
    "$aureole" help "$kind" "$name" --format csv >keys || fail "help $kind $name"
    [ "$(head -1 keys)" = key,type,default,values,help ] || fail "help $kind $name: $(head -1 keys)"
  done <names
done
"$aureole" sets >sets && "$aureole" measure --list >measures && "$aureole" lab list >lab || fail listings
awk 'length($0) > 80 { print "FAIL: wider than 80: " FILENAME ": " $0; bad = 1 } END { exit bad }' listing text sets measures lab || status=1
# Capitals and _ for - are forgiven in names of things, and other mistakes told from them.
[ "$("$aureole" points Spherical_Fibonacci -n 5)" = "$("$aureole" points spherical-fibonacci -n 5)" ] || fail "Spherical_Fibonacci"
expect 2 "did you mean 'star'?" measure sobol -n 4 -m Star
expect 2 "did you mean 'spherical-fibonacci'?" measure Spherical_Fibonaci -n 4 -m energy
expect 2 "unknown integrator 'foo'; there are: path" render "$2/scenes/cornell-box/cornell-box.xml" --integrator foo --spp 1
exit $status

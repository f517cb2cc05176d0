#!/usr/bin/env bash
# SIGINT and SIGTERM stop a render also within a tile, soon, leave a finished image alone and no other file behind.
set -euo pipefail
aureole=$1 scene=$2/scenes/cornell-box/cornell-box.xml
fail() { echo "$*" >&2; exit 1; }
rm -rf signals
mkdir signals
cd signals

# Seconds of CPU time that a process has taken, in hundredths.
spent() {
  local line
  line=$(cat "/proc/$1/stat" 2>/dev/null) || { echo 1000000; return; }
  # shellcheck disable=SC2086
  set -- ${line##*) }
  echo $((${12} + ${13}))
}

for signal in INT TERM; do
  for integrator in path ao finalgather:photons=2000,diffuse_samples=1000000; do
    echo old >p.exr
    rm -f p.partial.exr
    # One tile that would take hours.
    "$aureole" render "$scene" --width 16 --height 16 --spp 1000000 --integrator $integrator -t 1 -o p.exr -q 2>said &
    while [ "$(spent $!)" -lt 50 ]; do sleep 0.1; done
    before=$(spent $!)
    kill -$signal $!
    while kill -0 $! 2>/dev/null && [ "$(spent $!)" -lt $((before + 1000)) ]; do sleep 0.1; done
    kill -9 $! 2>/dev/null && fail "$integrator still works ten seconds after SIG$signal"
    status=0
    wait $! || status=$?
    [ "$status" = 3 ] || fail "$integrator ends with $status after SIG$signal, not 3: $(cat said)"
    [ "$(cat p.exr)" = old ] || fail "$integrator replaced the picture after SIG$signal"
    "$aureole" info p.partial.exr >/dev/null || fail "$integrator left no partial picture after SIG$signal: $(cat said)"
    [ "$(ls -A | tr '\n' ' ')" = "p.exr p.partial.exr said " ] || fail "left behind: $(ls -A)"
  done
done

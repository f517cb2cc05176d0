#!/usr/bin/env bash
# Kills the program at random moments, goes on, and compares what comes out with a run that was never stopped, byte by
# byte: scripts/faults.sh PROGRAM [KILLS [SEED]]. Prints a table; exit status 1 where anything differs.
set -uo pipefail
export AUREOLE_CACHE= # everything is made anew
aureole=$(realpath "${1:-build/release/aureole}")
kills=${2:-50}
RANDOM=${3:-1}
source=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mktemp -d)
# Not where a background command is killed before it has begun: there bash still has this trap.
trap '[ "$BASH_SUBSHELL" = 0 ] && rm -rf "$folder"' EXIT
cd "$folder" || exit 2
scene=$source/scenes/cornell-box/cornell-box.xml
size=64 angles=32
[ -z "${AUREOLE_SHORT_TESTS:-}" ] || size=32 angles=8 # sanitizers take long enough to be killed
render="render $scene --width $size --height $size -q"
gather=finalgather:photons=2000,diffuse_samples=256
# What is run, its output, and what a run that goes on is told besides.
works=("$render --spp 64|-o|a.exr|--checkpoint kept --checkpoint-every .05s --resume"
       "$render --spp 16 --integrator $gather|-o|a.exr|--checkpoint kept --checkpoint-every .05s --resume"
       "$render --integrator radiosity --spp 16|-o|a.exr|--checkpoint kept --checkpoint-every .05s --resume"
       "$render --error 4%|-o|a.exr|--checkpoint kept --checkpoint-every .05s --resume"
       "weights spherical-fibonacci -n 256 --lobe cosine --lobe2 phong:50 --n2 256 --angles $angles --rotations 4|--table|a.table|"
       "lab run keller-1994-table2 --quick|-o|lab|")
each=$(((kills + ${#works[@]} - 1) / ${#works[@]}))
status=0
printf '| work | SIGKILL | SIGTERM | files left over | result |\n|---|---|---|---|---|\n' 
for work in "${works[@]}"; do
  IFS='|' read -r command option output more <<<"$work"
  rm -rf whole ./*.part kept "$output"
  mkdir whole
  # shellcheck disable=SC2086
  (cd whole && "$aureole" $command $option "$output" >/dev/null 2>said) ||
    { printf '| `%s` | | | | refused: %s |\n' "${command/"$source/"/}" "$(head -1 whole/said)"; status=1; continue; }
  rm whole/said
  killed=0 stopped=0 finished=0
  # A run that was not killed in time starts again, so that there are as many kills as asked for.
  for ((i = 0; i < each || !finished; ++i)); do
    # shellcheck disable=SC2086
    "$aureole" $command $option "$output" $more >/dev/null 2>&1 &
    if ((i < each)); then
      sleep "0.$(printf %03d $((RANDOM % 700)))"
      if ((RANDOM % 2)); then kill -KILL $! 2>/dev/null && ((++killed)); else kill -TERM $! 2>/dev/null && ((++stopped)); fi
      wait $! 2>/dev/null
      if [ $? = 0 ]; then diff -r -x '*-timings.csv' "whole/$output" "$output" >/dev/null || status=1 finished=-1; rm -rf "$output" kept; fi
    else
      wait $! && finished=1 || { status=1; break; }
    fi
  done
  left=$(find . -name '.aureole-*' | wc -l)
  if diff -r -x '*-timings.csv' "whole/$output" "$output" >/dev/null 2>&1 && [ $finished = 1 ]; then result=same; else result=**differs** status=1; fi
  printf '| `%s` | %d | %d | %d | %s |\n' "${command/"$source/"/}" $killed $stopped "$left" $result
done
# One rank of several, which ends the job; the same command goes on.
if [ -e "$(dirname "$aureole")/aureole-mpi.so" ] && command -v mpirun >/dev/null; then
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
  export ASAN_OPTIONS=detect_leaks=0:${ASAN_OPTIONS:-} # of MPI itself
  work="$render --spp 128"
  rm -rf whole.exr kept a.exr
  # shellcheck disable=SC2086
  "$aureole" $work -o whole.exr
  killed=0 told=0 result=same
  for ((i = 0; i <= each; ++i)); do
    # shellcheck disable=SC2086
    mpirun --bind-to none -n 3 "$aureole" $work -t 1 -o a.exr --checkpoint kept --checkpoint-every .05s --resume >/dev/null 2>said &
    job=$!
    if ((i < each)); then
      sleep "0.$((500 + RANDOM % 500))"
      mapfile -t ranks < <(pgrep -P $job)
      ((${#ranks[@]} == 3)) && kill -KILL "${ranks[RANDOM % 3]}" 2>/dev/null && ((++killed))
      wait $job 2>/dev/null && { cmp -s whole.exr a.exr || result=**differs** status=1; rm -f a.exr kept; }
      grep -q 'signal 9' said && ((++told))
    else
      wait $job && cmp -s whole.exr a.exr || result=**differs** status=1
    fi
  done
  printf '| `mpirun -n 3 aureole %s`, one rank | %d, %d told of by mpirun | 0 | %d | %s |\n' "${work/"$source/"/}" $killed $told \
    "$(find . -name '.aureole-*' | wc -l)" $result
fi
exit $status

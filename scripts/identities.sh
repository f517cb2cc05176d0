#!/usr/bin/env bash
# What must make the same bits: threads, parts, ranks, instruction sets, processors and builds. scripts/identities.sh PROGRAM
# [OTHER-BUILD...] prints a table; exit status 1 where a row that has to be the same is not. Points, measures and weights are the sums
# of scripts/bits.sh, with 256 points a set. "no FMA" is the C library's
# mathematics for processors without fused multiply-add, which is not expected to be the same.
set -uo pipefail
export AUREOLE_CACHE= # everything is made anew
aureole=$(realpath "${1:-build/release/aureole}")
shift
builds=("$@")
source=$(cd "$(dirname "$0")/.." && pwd)
for i in "${!builds[@]}"; do builds[i]=$(realpath "${builds[i]}"); done
for program in "$aureole" "${builds[@]}"; do
  [ -x "$program" ] || { echo "identities.sh: there is no program $program" >&2; exit 2; }
done
name() { basename "$(dirname "$1")"; } # of a build: its folder
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 2
scene=$source/scenes/cornell-box/glossy.xml
status=0
works=(path 'path:interleaved=true' direct 'ao:samples=16' depth 'aov:aovs=(n:sh_normal)'
       'finalgather:photons=5000,diffuse_samples=32,glossy_samples=16' radiosity volpath 'error')
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
ranks() { mpirun --bind-to none -n "$ranks" "$aureole" "$@"; }
# make PROGRAM WORK OUT OPTION...
make() {
  local program=$1 work=$2 out=$3
  shift 3
  if [ "$work" = error ]; then
    "$program" render "$scene" --width 48 --height 40 --error 20% -q -o "$out" "$@"
  elif [ "$work" = radiosity ]; then
    "$program" render "$source/scenes/keller/cube.xml" --width 48 --height 40 --spp 4 --integrator radiosity -q -o "$out" "$@"
  elif [ "$work" = volpath ]; then # of a medium whose density is a grid
    "$program" render "$source/bench/peers/plugins/medium-grid.xml" --width 48 --height 40 --spp 4 --integrator volpath -q -o "$out" "$@"
  else
    "$program" render "$scene" --width 48 --height 40 --spp 4 --integrator "$work" -q -o "$out" "$@"
  fi 2>said
}
declare -A cells
columns=()
cell() { # cell COLUMN WORK RESULT
  [[ " ${columns[*]} " == *" ${1// /_} "* ]] || columns+=("${1// /_}")
  cells[$2/${1// /_}]=$3
  [ "$3" = same ] || [ "$1" = 'no FMA' ] || status=1
}
row() { # row COLUMN WORK: compares b.exr with a.exr
  local result=same
  cmp -s a.exr b.exr || result=**differs**
  cell "$1" "$2" "$result"
  rm -f b.exr
}
kinds=(points measure weights)
numbers() { COUNT=256 bash "$source/scripts/bits.sh" "$1" numbers; }
sums() { # sums COLUMN PROGRAM: compares its numbers with those of the program
  local kind of other
  numbers "$2" >numbers.b
  for kind in "${kinds[@]}"; do
    of=$(grep -c "  $kind " numbers.a)
    other=$(grep "  $kind " numbers.a | grep -vcxFf numbers.b)
    cell "$1" "$kind" "$([ "$other" = 0 ] && echo same || echo "$other of $of differ")"
  done
  diff numbers.a numbers.b | sed -n "s/^< [0-9a-f]* */$1: /p" >&2
}
no_fma=glibc.cpu.hwcaps=-AVX2,-FMA
for work in "${works[@]}"; do
  make "$aureole" "$work" a.exr -t 1
  for threads in 2 3 8; do
    make "$aureole" "$work" b.exr -t $threads
    row "$threads threads" "$work"
  done
  if [ "$work" != error ]; then
    for i in 1 2 3; do make "$aureole" "$work" $i.part --shard $i/3 -t $i; done
    "$aureole" merge 2.part 3.part 1.part -o b.exr
    row "3 shards" "$work"
  fi
  for ranks in 1 2 4; do
    command -v mpirun >/dev/null || break
    make ranks "$work" b.exr -t 2
    row "$ranks rank$([ $ranks = 1 ] || echo s)" "$work"
  done
  rm -f kept
  make "$aureole" "$work" b.exr --checkpoint kept --checkpoint-every .02s &
  sleep 0.2
  kill -KILL $! 2>/dev/null
  wait $! 2>/dev/null
  make "$aureole" "$work" b.exr --checkpoint kept --resume
  row "killed and gone on" "$work"
  for build in "${builds[@]}"; do
    make "$build" "$work" b.exr -t 1
    row "$(name "$build")" "$work"
  done
  GLIBC_TUNABLES=$no_fma make "$aureole" "$work" b.exr -t 1
  row "no FMA" "$work"
done
numbers "$aureole" >numbers.a
for build in "${builds[@]}"; do sums "$(name "$build")" "$build"; done
GLIBC_TUNABLES=$no_fma sums "no FMA" "$aureole"
# Our own kernels against the portable ones; Embree's stay the same.
for isa in avx2 avx512; do
  for work in "${works[@]}"; do
    AUREOLE_ISA=portable AUREOLE_EMBREE_ISA=avx2 make "$aureole" "$work" a.exr -t 1
    AUREOLE_ISA=$isa AUREOLE_EMBREE_ISA=avx2 make "$aureole" "$work" b.exr -t 1
    row "$isa" "$work"
  done
  AUREOLE_ISA=$isa sums "$isa" "$aureole"
done
AUREOLE_ISA=portable sums portable "$aureole"
{
  printf '| |'; printf ' %s |' "${columns[@]//_/ }"; echo
  printf '|---|'; printf -- '---|%.0s' "${columns[@]}"; echo
  for work in "${works[@]}" "${kinds[@]}"; do
    printf '| `%s` |' "${work/#error/--error 20%}"
    for column in "${columns[@]}"; do printf ' %s |' "${cells[$work/$column]:-}"; done
    echo
  done
}
exit $status

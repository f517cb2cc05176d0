#!/usr/bin/env bash
# Several processes that mpirun starts do one job, to the bits of one process; what goes wrong with one of them is told.
set -uo pipefail
aureole=$1 source=$2
[ -e "$(dirname "$aureole")/aureole-mpi.so" ] && command -v mpirun >/dev/null ||
  { echo "skipped: built without MPI, or there is no mpirun"; exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export ASAN_OPTIONS=detect_leaks=0:${ASAN_OPTIONS:-} # of MPI itself
# What a rank after the first one says is kept from the log, so its sanitizer writes beside it.
ASAN_OPTIONS=$ASAN_OPTIONS:log_path=$PWD/sanitizer
rm -rf ranks ./sanitizer.*
mkdir -p ranks/empty
cd ranks || exit 2
status=0
fail() { echo "FAILED: $*"; status=1; }
many() { timeout 120 mpirun -n "$@" 2>said; }
scene=$source/scenes/cornell-box/glossy.xml
small="--width 40 --height 36 -q"

# same RANKS OPTION...: raw runs of the lab are left out, which several ranks do not store
same() {
  local ranks=$1
  shift
  "$aureole" "$@" -t 1 >one.txt 2>said || { fail "one process: $* ($(head -1 said))"; return; }
  rm -rf first && mkdir first && for f in out*; do [ ! -e "$f" ] || mv "$f" first; done
  many "$ranks" "$aureole" "$@" -t 1 >many.txt || fail "$ranks ranks: $* ($(head -3 said))"
  sed -i '/-runs\.npz$/d' one.txt
  cmp one.txt many.txt || fail "$ranks ranks print something else: $*"
  for f in first/*; do [ ! -e "$f" ] || diff -r -x '*-timings.csv' -x '*-runs.npz' "$f" "${f#first/}" >/dev/null || fail "$ranks ranks make another $f: $*"; done
  rm -rf out*
}
for work in path 'finalgather:photons=2000,diffuse_samples=16'; do
  same 3 render "$scene" $small --spp 2 --integrator "$work" -o out.exr
done
same 2 render "$source/scenes/keller/cube.xml" $small --spp 2 --integrator radiosity -o out.exr
same 2 render "$scene" $small --error 30% -o out.exr
same 2 render "$scene" $small --spp 3 --integrator ptracer -o out.exr
# Rays of all ranks are counted, and once what each does for itself.
for work in path finalgather:photons=2000 radiosity:paths=20000; do
  render=(render "$scene" $small --spp 2 --no-cache --integrator "$work" -t 1 --json -o out.exr)
  one=$("$aureole" "${render[@]}" | grep -o '"rays": [0-9]*')
  [ -n "$one" ] && [ "$one" = "$(many 3 "$aureole" "${render[@]}" | grep -o '"rays": [0-9]*')" ] || fail "$work: other rays by 3 ranks"
done
rm -f out.exr
same 2 measure spherical-fibonacci -n 200 -m energy,cap,cap-bound,voronoi-max,wce:1.5
same 2 measure spherical-fibonacci -n 100 --domain sphere -m spectrum
same 2 weights spherical-fibonacci -n 32 --lobe cosine --lobe2 phong:20 --n2 32 --angles 8 --rotations 2 --table out.table -q
same 2 lab run keller-1994-table2 --quick -o out -q

# Tables of weights and photon maps that ranks leave in the cache have the names and bits of one process's, so that each finds the other's; a metal
# of GGX has its own.
cat >metal.xml <<'SCENE'
<scene version="3.0.0">
  <sensor type="perspective"><transform name="to_world"><lookat origin="0, -4, 2" target="0, 0, 0" up="0, 0, 1"/></transform>
    <film type="hdrfilm"/></sensor>
  <shape type="rectangle"><bsdf type="roughconductor"><string name="material" value="Al"/><float name="alpha" value="0.2"/></bsdf></shape>
  <shape type="rectangle"><transform name="to_world"><rotate x="1" angle="90"/><translate y="1" z="1"/></transform>
    <bsdf type="twosided"><bsdf type="diffuse"/></bsdf></shape>
  <shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><scale value="0.3"/><translate z="2"/></transform>
    <emitter type="area"><rgb name="radiance" value="5"/></emitter></shape>
</scene>
SCENE
metal=(render metal.xml --width 12 --height 10 --spp 1 -q
       --integrator finalgather-lab:photons=20000,diffuse_samples=8,glossy_samples=8,weights=oswa)
rough=(render "$scene" --width 12 --height 10 --spp 1 -q
       --integrator finalgather-lab:weights=oswa,photons=100,diffuse_samples=4,glossy_samples=4,rotations=1)
for work in metal rough; do
  declare -n options=$work
  rm -rf cache-of-one cache-of-many one.exr many.exr
  AUREOLE_CACHE=$PWD/cache-of-one "$aureole" "${options[@]}" -o one.exr 2>said || fail "$work: $(cat said)"
  AUREOLE_CACHE=$PWD/cache-of-many many 2 "$aureole" "${options[@]}" -o many.exr || fail "$work: $(cat said)"
  cmp one.exr many.exr || fail "two ranks make another image of $work"
  [ -n "$(ls cache-of-one)" ] && diff -r cache-of-one cache-of-many || fail "two ranks keep other tables of $work"
done

# A rank that has not the files gets them from rank 0, and the log names the ranks.
"$aureole" render "$scene" --width 40 --height 36 --spp 2 -q -o one.exr
timeout 120 mpirun -n 1 "$aureole" render "$scene" --width 40 --height 36 --spp 2 -o many.exr : \
  -n 1 -wdir "$PWD/empty" "$aureole" render ../nowhere.xml --width 40 --height 36 --spp 2 -o many.exr 2>said || fail "$(cat said)"
cmp one.exr many.exr || fail "a rank without the files spoils the image"
grep -q '2 ranks: 0 to 1 on' said || fail "the log does not name the ranks: $(cat said)"
[ -z "$(ls empty)" ] || fail "a rank after the first one wrote $(ls empty)"

# One process loads nothing of MPI.
LD_DEBUG=files "$aureole" sets 2>&1 >/dev/null | grep -q 'libmpi' && fail "one process loads MPI"

# Checkpoints, parts, and going on.
many 2 "$aureole" render "$scene" $small --spp 2 --shard 1/2 -o 1.part || fail "$(cat said)"
many 2 "$aureole" render "$scene" $small --spp 2 --shard 2/2 -o 2.part || fail "$(cat said)"
"$aureole" merge 1.part 2.part -o parts.exr && cmp one.exr parts.exr || fail "parts by ranks make another image"
rm -f kept
many 2 "$aureole" render "$scene" $small --spp 2 --checkpoint kept -o many.exr || fail "$(cat said)"
rm many.exr
many 2 "$aureole" render "$scene" $small --spp 2 --checkpoint kept --resume -o many.exr || fail "$(cat said)"
cmp one.exr many.exr || fail "ranks that go on make another image"

# What cannot be.
refuses() { # refuses WORDS STATUS COMMAND...
  local words=$1 wanted=$2 got=0
  shift 2
  timeout 120 "$@" >/dev/null 2>said || got=$?
  [ "$got" = "$wanted" ] && grep -q "$words" said || fail "status $got for $wanted: $* ($(cat said))"
}
refuses 'the work of one process' 2 mpirun -n 2 "$aureole" points sobol -n 4
refuses 'cannot read' 2 mpirun -n 2 "$aureole" render none.xml
refuses 'AUREOLE_ISA' 2 mpirun -n 1 "$aureole" render "$scene" : -n 1 -x AUREOLE_ISA=portable "$aureole" render "$scene"
refuses 'launcher of another MPI' 2 env OMPI_COMM_WORLD_SIZE=2 "$aureole" render "$scene"
[ "$(grep -c aureole: said)" = 1 ] || fail "an error is told more than once: $(cat said)"

# A build without MPI.
mkdir bare
cp "$(dirname "$aureole")"/libaureole*.so.1 bare 2>/dev/null &&
  refuses 'built without MPI' 2 env LD_LIBRARY_PATH="$PWD/bare" OMPI_COMM_WORLD_SIZE=2 "$aureole" render "$scene"

# A rank that is killed ends the job, and the checkpoint is good. Where a fast machine ends before the kill, longer work follows.
for spp in 512 2048 8192; do
  rm -f kept many.exr
  long="render $scene --width 40 --height 36 --spp $spp -q"
  # shellcheck disable=SC2086
  timeout 120 mpirun -n 2 "$aureole" $long -t 1 --checkpoint kept --checkpoint-every .02s -o many.exr 2>said &
  job=$!
  for ((i = 0; i < 3000; ++i)); do [ -e kept ] && break; sleep 0.02; done
  child=$(pgrep -n -P "$(pgrep -P $job mpirun)") && kill -KILL "$child" 2>/dev/null
  wait $job || break
done
grep -qi 'signal 9' said || fail "nobody tells that a rank was killed: $(cat said)"
# shellcheck disable=SC2086
"$aureole" $long -o whole.exr
# shellcheck disable=SC2086
"$aureole" $long --checkpoint kept --resume -o many.exr || fail "the checkpoint is spoilt"
cmp whole.exr many.exr || fail "after a killed rank the image is another one"
! ls ../sanitizer.* 2>/dev/null || fail "a sanitizer spoke"
exit $status

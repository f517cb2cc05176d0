#!/usr/bin/env bash
# A render that is killed and goes on, and one that is made of parts, is the image of one render, to the bit.
set -euo pipefail
aureole=$1 source=$2
fail() { echo "$*" >&2; exit 1; }
rm -rf resume
mkdir resume
cd resume
cp -r "$source/scenes/cornell-box" box
scene=box/cornell-box.xml
size='--width 64 --height 48'
[ -z "${AUREOLE_SHORT_TESTS:-}" ] || size='--width 32 --height 24' # sanitizers take long enough to be stopped
# In the background the program is called by its name: a signal to a function would miss it.
# shellcheck disable=SC2086
render() { "$aureole" render "$scene" $size -q "$@"; }

refuses() { # WORDS STATUS COMMAND...
  local words=$1 wanted=$2 status=0
  shift 2
  "$@" 2>said || status=$?
  [ "$status" = "$wanted" ] || fail "'$*' ends with $status, not $wanted: $(cat said)"
  grep -q -e "$words" said || fail "'$*' says: $(cat said)"
}

# By both kinds of integrators, and rounds of samples: stopped soon after a few checkpoints, once by each signal.
for how in '--spp 64' '--spp 8 --integrator finalgather:photons=2000,diffuse_samples=256' '--error 4%'; do
  rm -f kept whole.exr parted.exr
  # shellcheck disable=SC2086
  render $how -o whole.exr
  for signal in KILL TERM; do
    # shellcheck disable=SC2086
    "$aureole" render "$scene" $size -q $how -o parted.exr --checkpoint kept --checkpoint-every .05s --resume -t 1 2>said &
    before=$(stat -c %Y%i kept 2>/dev/null || echo none)
    for ((i = 0; i < 600; ++i)); do
      [ "$(stat -c %Y%i kept 2>/dev/null || echo none)" = "$before" ] || break
      sleep 0.02
    done
    kill -$signal $! 2>/dev/null || true
    wait $! 2>/dev/null || true
  done
  # shellcheck disable=SC2086
  render $how -o parted.exr --checkpoint kept --resume -t 3
  cmp whole.exr parted.exr || fail "'$how' is another picture when it goes on"
  # From a checkpoint of all samples there is nothing to do.
  rm parted.exr
  # shellcheck disable=SC2086
  render $how -o parted.exr --checkpoint kept --resume
  cmp whole.exr parted.exr || fail "'$how' is another picture from its last checkpoint"
done

# What is of something else is refused, and the difference named; where there is nothing it begins, and says so.
render --spp 2 -o a.exr --checkpoint kept
refuses "'seed 0', this one is 'seed 1'" 2 render --spp 2 --seed 1 -o b.exr --checkpoint kept --resume
refuses "'samples_per_pixel 2'" 2 render --spp 4 -o b.exr --checkpoint kept --resume
refuses "'integrator of the scene', this one is 'integrator ao'" 2 render --spp 2 --integrator ao -o b.exr --checkpoint kept --resume
refuses "it was not made to an error" 2 render --error 9% -o b.exr --checkpoint kept --resume
cp box/meshes/red-wall.obj red-wall.obj
echo '# more' >>box/meshes/red-wall.obj
refuses "'meshes/red-wall.obj' has changed" 2 render --spp 2 -o b.exr --checkpoint kept --resume
cp red-wall.obj box/meshes/red-wall.obj
head -c 3000 kept >cut
refuses 'cut short' 2 render --spp 2 -o b.exr --checkpoint cut --resume
refuses 'another kind of file' 2 render --spp 2 -o b.exr --checkpoint a.exr --resume
refuses "needs '--checkpoint'" 2 render --spp 2 -o b.exr --resume
refuses 'needs' 2 render --spp 2 -o b.exr --checkpoint-every 5s
refuses "5min or 1h, not 'soon'" 2 render --spp 2 -o b.exr --checkpoint kept --checkpoint-every soon
refuses 'folder does not exist' 3 render --spp 2 -o b.exr --checkpoint none/kept
[ ! -e b.exr ] || fail "a refused render left an image"
"$aureole" render "$scene" --width 16 --height 16 --spp 1 -o b.exr --checkpoint new --resume 2>said
grep -q 'checkpoint new not found' said || fail "a render that begins anew says: $(cat said)"

# Parts.
for integrator in path finalgather:photons=2000,diffuse_samples=16; do
  render --spp 4 --integrator $integrator -o whole.exr
  for i in 1 2 3; do
    render --spp 4 --integrator $integrator --shard $i/3 -t $i
  done
  "$aureole" merge cornell-box.{3,1,2}-of-3.part -o parted.exr
  cmp whole.exr parted.exr || fail "three parts of $integrator are another picture"
done
render --spp 4 --integrator $integrator --shard 1/1 -o one.part
"$aureole" merge one.part -o parted.exr
cmp whole.exr parted.exr || fail "one part is another image"
merge() { "$aureole" merge "$@" -o none.exr; }
refuses 'part 2 of 3 is missing' 2 merge cornell-box.{1,3}-of-3.part
refuses 'part 1 of 3 is given twice: also cornell-box.1-of-3.part' 2 merge cornell-box.{1,1,2}-of-3.part
render --spp 4 --integrator $integrator --seed 9 --shard 3/3 -o other.part
refuses "other.part: of another render: it was made with 'seed 9', this one is 'seed 0'" 2 merge cornell-box.{1,2}-of-3.part other.part
render --spp 4 --integrator $integrator --shard 3/4 -o other.part
refuses 'one of 4 parts' 2 merge cornell-box.{1,2}-of-3.part other.part
refuses 'not a checkpoint' 2 merge whole.exr
printf 'AURCHKP1%064d' 0 >old.part
refuses 'another version of the program' 2 merge old.part
refuses "cannot read" 2 merge none.part
refuses "expected '-o FILE'" 2 "$aureole" merge one.part
refuses "such as 2/3, not '3/2'" 2 render --shard 3/2
refuses "such as 2/3, not '0/2'" 2 render --shard 0/2
refuses "such as 2/3, not 'half'" 2 render --shard half
refuses 'cannot be used with' 2 render --shard 1/2 --error 1%
[ ! -e none.exr ] || fail "refused parts left an image"
# Parts and checkpoints of rays that other instructions traced differ in the last bits.
if grep -qw avx2 /proc/cpuinfo; then
  traced() { AUREOLE_EMBREE_ISA=$1 render "${@:2}"; }
  traced avx2 --spp 1 --shard 1/2 -o wide.part
  traced portable --spp 1 --shard 2/2 -o narrow.part
  traced avx2 --spp 1 --shard 2/2 -o wide-too.part
  refuses "instructions portable.*AUREOLE_ISA=avx2" 2 merge wide.part narrow.part
  merge wide.part wide-too.part || fail "parts of the same instructions are refused"
  rm none.exr
  for method in '--spp 4' '--rounds 1'; do
    rm -f wide.kept
    # shellcheck disable=SC2086
    traced avx2 $method -o wide.exr --checkpoint wide.kept
    # shellcheck disable=SC2086
    refuses "instructions avx2" 2 traced portable $method -o narrow.exr --checkpoint wide.kept --resume
    # shellcheck disable=SC2086
    AUREOLE_ISA=portable traced avx2 $method -o wide.exr --checkpoint wide.kept --resume || fail "a checkpoint is refused for our own kernels"
  done
fi
# A part that was interrupted is refused until it has gone on.
"$aureole" render "$scene" --width 16 --height 32 --spp 100000 --shard 1/1 -o slow.part --checkpoint slow.kept -q 2>said &
sleep 1
kill -TERM $!
wait $! || true
refuses 'not finished' 2 merge slow.kept

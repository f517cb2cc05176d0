#!/usr/bin/env bash
# Limits that a service sets: memory, time, files outside of the scene's folder; and what a full disk leaves.
set -euo pipefail
aureole=$1 source=$2
fail() { echo "$*" >&2; exit 1; }
rm -rf limits
mkdir limits
cd limits
cp -r "$source/scenes/cornell-box" box
scene=box/cornell-box.xml

refuses() { # WORDS STATUS COMMAND...
  local words=$1 wanted=$2 status=0
  shift 2
  "$@" >/dev/null 2>said || status=$?
  [ "$status" = "$wanted" ] || fail "'$*' ends with $status, not $wanted: $(cat said)"
  grep -q -e "$words" said || fail "'$*' says: $(cat said)"
}

# A confined scene is read within its folder, however a file is named.
mkdir outside
cp box/meshes/red-wall.obj outside/
for way in ../outside/red-wall.obj "$PWD/outside/red-wall.obj" link.obj folder/red-wall.obj; do
  sed "s|meshes/red-wall.obj|$way|" $scene >box/escapes.xml
  ln -sf ../outside/red-wall.obj box/link.obj
  ln -sfn ../outside box/folder
  "$aureole" info box/escapes.xml >/dev/null || fail "$way is not found"
  refuses 'lies outside of the scene' 2 "$aureole" info --confine box/escapes.xml
  refuses 'lies outside of the scene' 2 "$aureole" render --confine box/escapes.xml -o no.exr
done
sed 's|<scene version="\(.*\)">|<scene version="\1"><include filename="../outside/more.xml"/>|' $scene >box/escapes.xml
echo '<scene version="3.0.0"/>' >outside/more.xml
refuses 'lies outside of the scene' 2 "$aureole" info --confine box/escapes.xml
"$aureole" info --confine $scene >/dev/null || fail "a scene in its own folder is refused"
(cd box && "$aureole" info --confine cornell-box.xml >/dev/null) || fail "a scene in the working folder is refused"
[ ! -e no.exr ] || fail "a refused scene left a picture"

# Time: the program ends, with words; an earlier picture stays.
echo old >p.exr
refuses 'the time limit is over' 3 "$aureole" render $scene --spp 1000000 -o p.exr -q --time-limit .5s
[ "$(cat p.exr)" = old ] || fail "a render that was out of time replaced the picture"
refuses 'is no time' 2 "$aureole" render $scene --time-limit soon
refuses 'is no size' 2 "$aureole" render $scene --memory-limit much

# Memory. Sanitizers reserve far more addresses than this.
if [ "$(nm "$aureole" 2>/dev/null | grep -c __asan_init)" = 0 ]; then
  refuses 'out of memory' 3 "$aureole" render $scene --width 16000 --height 16000 --spp 1 -t 2 -o p.exr -q --memory-limit 1G
  "$aureole" render $scene --width 16 --height 16 --spp 1 -t 2 -o small.exr -q --memory-limit 4G || fail "4 GB are too little"
fi

# A full disk: an error, and the file of before is whole. Needs the right to mount.
mkdir disk
if mount -t tmpfs -o size=256k none disk 2>/dev/null; then
  trap 'umount disk' EXIT
  echo old >disk/p.exr
  echo old >disk/kept
  refuses 'No space left' 3 "$aureole" render $scene --width 256 --height 256 --spp 1 -o disk/p.exr -q
  [ "$(cat disk/p.exr)" = old ] || fail "a full disk spoilt the picture"
  refuses 'No space left' 3 "$aureole" render $scene --width 128 --height 128 --spp 1 -o p2.exr --checkpoint disk/kept -q
  [ "$(cat disk/kept)" = old ] || fail "a full disk spoilt the checkpoint"
  [ "$(ls -A disk | tr '\n' ' ')" = 'kept p.exr ' ] || fail "left on the full disk: $(ls -A disk)"
fi

# One process of a job of several is one rank; ranks.sh has several.
env OMPI_COMM_WORLD_SIZE=1 "$aureole" --version >/dev/null || fail "one rank is refused"

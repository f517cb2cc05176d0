#!/usr/bin/env bash
# Photon maps and tables of weights that runs share through the cache folder: no bit depends on it, whatever is in it.
. "$(dirname "$0")/common.sh.inc"
rm -rf cache scene other-scene
cp -r "$source/scenes/cornell-box" scene
export AUREOLE_CACHE=$PWD/cache
photons=finalgather:photons=20000,diffuse_samples=8,glossy_samples=8
weights=finalgather-lab:weights=oswa,photons=100,diffuse_samples=4,glossy_samples=4,rotations=1
make() { # make INTEGRATOR OUT OPTION...
  "$aureole" render scene/glossy.xml -q --integrator "$1" --width 16 --height 16 --spp 1 -o "$2" "${@:3}" || fail "render $*"
}
same() { # same WHAT INTEGRATOR OPTION...: the picture is that of whole.exr
  make "$2" again.exr "${@:3}"
  cmp whole.exr again.exr || fail "$1: another picture by $2"
}
entries() { find cache -type f 2>/dev/null | wc -l; }

for integrator in $photons $weights; do
  rm -rf cache
  make $integrator whole.exr --no-cache
  [ -e cache ] && fail "--no-cache leaves a folder"
  same 'the first run' $integrator -t 1
  count=$(entries)
  [ "$count" -ge 1 ] || fail "$integrator: nothing is kept"
  find cache -name '.*' -type f | grep . && fail "temporary files are left"
  same 'a later run' $integrator -t 3
  same 'the cache of another folder' $integrator --no-cache
  [ "$(entries)" = "$count" ] || fail "$integrator: the same run leaves more"

  # Damaged, cut, emptied and replaced entries are made again.
  for file in cache/*; do printf x | dd of="$file" bs=1 seek=300 conv=notrunc status=none; done
  same 'damaged entries' $integrator
  for file in cache/*; do truncate -s 1000 "$file"; done
  same 'cut entries' $integrator
  for file in cache/*; do : >"$file"; done
  same 'empty entries' $integrator
  for file in cache/*; do mv "$file" kept; mkdir "$file"; done
  same 'folders in the place of entries' $integrator
  rmdir cache/*
  same 'no entries' $integrator

  # Runs at once, over a cache that is empty when they begin.
  rm -rf cache
  running=()
  for i in 1 2 3; do make $integrator at-once-$i.exr & running+=($!); done
  wait "${running[@]}"
  for i in 1 2 3; do cmp whole.exr at-once-$i.exr || fail "$integrator: run $i of three at once differs"; done
  [ "$(entries)" = "$count" ] || fail "$integrator: three runs at once leave $(entries) entries, not $count"
done

# What entries depend on: others are kept beside them, and images are those of runs without a cache.
rm -rf cache
make $photons whole.exr
count=$(entries)
for change in '--seed 1' '--integrator finalgather:photons=30000,diffuse_samples=8,glossy_samples=8'; do
  # shellcheck disable=SC2086
  make $photons a.exr $change --no-cache
  # shellcheck disable=SC2086
  make $photons b.exr $change
  cmp a.exr b.exr || fail "$change: an entry of other photons"
  [ "$(entries)" -gt "$count" ] || fail "$change: no entry of its own"
  count=$(entries)
done
sed -i 's/^v 552.8 /v 500 /' scene/meshes/red-wall.obj # a file that the scene names
make $photons a.exr --no-cache
make $photons b.exr
cmp a.exr b.exr || fail "a changed scene: an entry of the old one"
cmp -s a.exr whole.exr && fail "the change of the scene changes nothing"
[ "$(entries)" -gt "$count" ] || fail "a changed scene: no entry of its own"
count=$(entries)
AUREOLE_ISA=portable AUREOLE_EMBREE_ISA=avx2 make $photons b.exr
[ "$(entries)" -gt "$count" ] || fail "other instructions: no entry of their own"

# Few photons are traced faster than they are found.
rm -rf cache
make finalgather:photons=1000 a.exr
[ "$(entries)" = 0 ] || fail "a map of 1000 photons is kept"

# A folder that cannot be made is no error, nor is an empty name, which stands for none.
make $photons whole.exr --no-cache
for folder in /proc/aureole /dev/null/cache ''; do
  AUREOLE_CACHE=$folder same "a cache in '$folder'" $photons
done
exit $((failures > 0))

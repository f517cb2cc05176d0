#!/usr/bin/env bash
# A picture is the same to the bit for any number of threads, and its crop is a part of it.
. "$(dirname "$0")/common.sh.inc"
scene=$source/scenes/cornell-box/glossy.xml
for integrator in path finalgather:photons=20000,diffuse_samples=16,glossy_samples=16 \
                  finalgather:photons=20000,pattern=sobol,rotations=0; do
  name=${integrator%%[:,]*}
  for threads in 1 2 3; do
    "$aureole" render "$scene" -q -t $threads --integrator "$integrator" --width 48 --height 40 --spp 4 \
      -o $name-$threads.exr || fail "$integrator with $threads threads"
  done
  cmp $name-1.exr $name-2.exr || fail "$integrator: 1 and 2 threads differ"
  cmp $name-1.exr $name-3.exr || fail "$integrator: 1 and 3 threads differ"
  "$aureole" render "$scene" -q --integrator "$integrator" --width 48 --height 40 --spp 4 --seed 1 -o $name-seed.exr
  cmp -s $name-1.exr $name-seed.exr && fail "$integrator: the seed changes nothing"
  "$aureole" compare $name-1.exr $name-seed.exr --tolerance 1 >/dev/null || fail "$integrator: seeds too far apart"
done
"$aureole" render "$scene" -q --integrator path --width 48 --height 40 --spp 4 -t 2 -o again.exr
cmp again.exr path-1.exr || fail "the same command twice"
exit $((failures > 0))

#!/usr/bin/env bash
# Rays in packets of sixteen find what single rays find: pictures differ by rounding, and by the few hits that rounding
# moves to the next texel.
. "$(dirname "$0")/common.sh.inc"
for scene in "$source/scenes/cornell-box/glossy.xml" "$source/tests/render/furnace.xml"; do
  for options in decorrelation=blue decorrelation=random pattern=sobol,rotations=0; do
    for packets in true false; do
      "$aureole" render "$scene" -q --width 48 --height 40 --spp 4 -o packets-$packets.exr \
        --integrator "finalgather:photons=20000,diffuse_samples=16,glossy_samples=16,$options,packets=$packets" ||
        fail "$scene with $options: render"
    done
    off=$(figure relative_rmse packets-true.exr packets-false.exr)
    awk -v off="$off" 'BEGIN { exit !(off < 2e-3) }' || fail "$scene with $options: packets are off by $off"
  done
done
exit $((failures > 0))

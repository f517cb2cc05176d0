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

# Paths of sixteen pixels in lockstep are single paths of the same numbers, on plain surfaces and on others.
render() { # render FILE INTEGRATOR ARGUMENTS...
  local file=$1 integrator=$2
  shift 2
  "$aureole" render "$scene" -q -o "$file" --integrator "$integrator" "$@" || fail "$scene with $integrator: render"
}
for scene in "$source"/scenes/cornell-box/{cornell-box,glossy}.xml "$source"/tests/render/{furnace,sky,white_bodies}.xml; do
  for options in max_depth=-1 max_depth=2 rr_depth=1; do
    for packets in true false; do
      render path-$packets.exr path:packets=$packets,$options --width 40 --height 24 --spp 4
    done
    off=$(figure relative_rmse path-true.exr path-false.exr)
    awk -v off="$off" 'BEGIN { exit !(off < 1e-3) }' || fail "$scene with $options: paths in packets are off by $off"
  done
done

# Interleaved paths share numbers among pixels, and each pixel is as good as with its own: the error of 16 samples
# against 256 of another seed. Over many seeds the ratio has a standard deviation of .08.
scene=$source/scenes/cornell-box/glossy.xml
render path-reference.exr path --width 64 --height 64 --spp 256 --seed 99
for integrator in path path:interleaved=true; do
  render path-16.exr $integrator --width 64 --height 64 --spp 16
  figure rmse path-reference.exr path-16.exr
done | awk '{ rmse[NR] = $1 } END { print "interleaved over own:", rmse[2] / rmse[1]
                                     exit !(rmse[2] < 1.4 * rmse[1] && rmse[2] > 0.7 * rmse[1]) }' ||
  fail "interleaved paths are not as good as others"

# The bits are those of any processor.
for integrator in path path:interleaved=true; do
  for isa in portable avx2 avx512; do
    AUREOLE_ISA=$isa render path-$isa.exr $integrator --width 40 --height 24 --spp 4
  done
  cmp path-portable.exr path-avx2.exr || fail "$integrator: avx2 differs"
  cmp path-portable.exr path-avx512.exr || fail "$integrator: avx512 differs"
done
exit $((failures > 0))

#!/usr/bin/env bash
# Rays in packets of sixteen find what single rays find, to the bit, by each kind of Embree's kernels. Embree rounds
# hits of packets and of single rays alike, so equality can be asked for where both are shaded by the same code.
. "$(dirname "$0")/common.sh.inc"
render() { # render FILE INTEGRATOR ARGUMENTS...
  local file=$1 integrator=$2
  shift 2
  "$aureole" render "$scene" -q -o "$file" --integrator "$integrator" "$@" || fail "$scene with $integrator: render"
}
same_alone() { # same_alone INTEGRATOR ARGUMENTS...
  local integrator=$1
  shift
  render together.exr "$integrator,packets=true" "$@"
  render alone.exr "$integrator,packets=false" "$@"
  cmp together.exr alone.exr || fail "$scene with $integrator by ${AUREOLE_ISA:-all} instructions: packets differ"
}
for isa in portable avx2 avx512; do
  export AUREOLE_ISA=$isa
  for scene in "$source/scenes/cornell-box/glossy.xml" "$source/tests/render/driver/furnace.xml"; do
    for options in decorrelation=blue decorrelation=random pattern=sobol,rotations=0 \
                   direct=none,component=glossy,edges=0 direct=none,component=diffuse,edges=0; do
      same_alone "finalgather-lab:photons=20000,diffuse_samples=16,glossy_samples=16,$options" --width 48 --height 40 --spp 4
    done
  done
done
unset AUREOLE_ISA

# Paths of sixteen pixels in lockstep are single paths of the same numbers. Where no surface is plain, both are shaded by
# the same code and are equal to the bit. Plain surfaces are shaded by vector code, whose operations stand in another order:
# some 50 a bounce, each rounded by at most 2^-24 of its value. Hardly a path has more than 16 bounces, and 800 * 2^-24 is
# 5e-5. Such a rounding may also make a path keep another candidate, about once in a million choices: none of these images
# has one, and their bits are those of any processor. Embree's kernels are held to one instruction set, so that no processor's
# own hits send a path past an edge.
export AUREOLE_EMBREE_ISA=avx2
for scene in "$source"/scenes/cornell-box/{glossy,cornell-box}.xml "$source"/tests/render/driver/{furnace,white_bodies,sky,textures}.xml; do
  for options in max_depth=-1 max_depth=2 rr_depth=1 candidates=3 candidates=4,rr_depth=1; do
    for packets in true false; do
      render path-$packets.exr path:packets=$packets,$options --width 40 --height 24 --spp 4
    done
    case $scene in
    */cornell-box/*.xml | *sky.xml | *textures.xml)
      off=$(figure relative_rmse path-true.exr path-false.exr)
      awk -v off="$off" 'BEGIN { exit !(off < 5e-5) }' || fail "$scene with $options: paths in packets are off by $off"
      ;;
    *) cmp path-true.exr path-false.exr || fail "$scene with $options: paths in packets differ" ;;
    esac
  done
done
unset AUREOLE_EMBREE_ISA

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

# The bits are those of any processor, with Embree's kernels held to one instruction set, since its hits differ.
export AUREOLE_EMBREE_ISA=avx2
for integrator in path path:interleaved=true path:candidates=4; do
  for isa in portable avx2 avx512; do
    AUREOLE_ISA=$isa render path-$isa.exr $integrator --width 40 --height 24 --spp 4
  done
  cmp path-portable.exr path-avx2.exr || fail "$integrator: avx2 differs"
  cmp path-portable.exr path-avx512.exr || fail "$integrator: avx512 differs"
done
exit $((failures > 0))

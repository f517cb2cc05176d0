#!/usr/bin/env bash
# Irradiance shared over blocks of 4 x 4 pixels: less error with as many rays, little bias, exact under constant light,
# and no mixing of what other options need apart.
. "$(dirname "$0")/common.sh.inc"
scene=$source/scenes/cornell-box/cornell-box.xml
render() {
  "$aureole" render "$scene" -q --width 64 --height 64 --spp 4 --sampler sobol -o "$1.exr" \
    --integrator "finalgather:photons=20000,direct=none,pixel=centre,edges=0,$2" || fail "$1: render"
}
render reference diffuse_samples=4096
render alone diffuse_samples=8
render shared diffuse_samples=8,share=true
render near diffuse_samples=8,share=near
render many diffuse_samples=512,share=true
awk -v alone="$(figure rmse reference.exr alone.exr)" -v near="$(figure rmse reference.exr near.exr)" -v shared="$(figure rmse reference.exr shared.exr)" \
  -v many="$(figure rmse reference.exr many.exr)" 'BEGIN {
    printf "alone %g, shared with the nearest %g, shared %g, shared by many %g\n", alone, near, shared, many
    exit !(shared < 0.7 * alone && near < 0.8 * alone && many < 0.8 * shared) }' || fail "the errors are not in order"

for share in true near; do
  "$aureole" render "$source/tests/render/driver/furnace.xml" -q --width 16 --height 16 --spp 4 -o furnace.exr --integrator \
    finalgather-lab:direct=gather,incident=emitters,density=same,share=$share || fail "furnace, share=$share: render"
  awk -v mean="$(mean furnace.exr furnace.exr)" 'BEGIN { exit !(mean > 0.749999 && mean < 0.750001) }' ||
    fail "share=$share: constant light is not exact: $(mean furnace.exr furnace.exr)"
done

"$aureole" render "$scene" -q --width 16 --height 16 -o refused.exr --integrator finalgather-lab:share=true,adaptive=true 2>refused.log
[ $? -eq 2 ] || fail "share with adaptive: the status is not 2"
grep -q 'share does not go with adaptive=true' refused.log || fail "share with adaptive: $(cat refused.log)"
exit $((failures > 0))

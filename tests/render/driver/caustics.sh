#!/usr/bin/env bash
# Light through glass and off a mirror: gathered along specular chains, or from caustic photons, it is what paths find.
. "$(dirname "$0")/common.sh.inc"
scene=$source/tests/render/driver/caustic.xml
"$aureole" render "$scene" -q --spp "$(either 16 1024)" -o path.exr || fail "path: render"
for caustics in 0 40000; do
  "$aureole" render "$scene" -q --spp "$(either 1 16)" -o gather-$caustics.exr --integrator \
    "finalgather:photons=40000,diffuse_samples=256,caustic_photons=$caustics" || fail "$caustics: render"
  off=$(figure relative_rmse path.exr gather-$caustics.exr --downsample 8)
  echo "caustic_photons=$caustics: relative RMSE of means of 8 x 8 pixels $off"
  judge -v off="$off" -v path="$(mean path.exr path.exr)" -v mean="$(mean path.exr gather-$caustics.exr)" \
    'BEGIN { exit !(off < 0.04 && mean > 0.99 * path && mean < 1.01 * path) }' ||
    fail "caustic_photons=$caustics is off by $off"
done
# Rough glass and veils let light through to what is gathered: the furnace stays at 1, with 2 % for the photons behind them.
for material in frosted veil; do
  "$aureole" render "$source/tests/render/driver/furnace_faces.xml" -q --width 16 --height 16 --spp 16 -D material=$material \
    --integrator finalgather:photons=20000 -o $material.pfm || fail "$material: render"
  awk -v mean="$(mean $material.pfm $material.pfm)" 'BEGIN { exit !(mean > 0.98 && mean < 1.02) }' ||
    fail "$material: the furnace has $(mean $material.pfm $material.pfm)"
done
"$aureole" render "$source/scenes/cornell-box/cornell-box.xml" --width 16 --height 16 --spp 1 -o none.exr \
  --integrator finalgather:photons=1000,caustic_photons=1000 2>none.log || fail "no caustics: render"
grep -q 'caustic photons of' none.log || fail "no caustics: no warning"
exit $((failures > 0))

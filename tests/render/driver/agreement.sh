#!/usr/bin/env bash
# path and finalgather see the same Cornell boxes. Noise: both have 64 samples per pixel, and means over 48 x 48 pixels of
# them are good to about 0.3 %. Bias of the photon map (50,000 photons here): at most 1 % of the mean, stated; blocks of
# 8 x 8 pixels within 4 % RMSE, which a missing lobe (about 20 % of the light) or a light counted twice would break.
. "$(dirname "$0")/common.sh.inc"
for scene in cornell-box glossy; do
  file=$source/scenes/cornell-box/$scene.xml
  "$aureole" render "$file" -q --integrator path --width 48 --height 48 --spp 64 --sampler sobol --filter box -o $scene-path.exr &&
  "$aureole" render "$file" -q --integrator finalgather:photons=50000 --width 48 --height 48 --spp 64 --sampler sobol \
    --filter box -o $scene-gather.exr || fail "$scene: render"
  reference=$(mean $scene-path.exr $scene-path.exr)
  gathered=$(mean $scene-path.exr $scene-gather.exr)
  blocks=$(figure relative_rmse $scene-path.exr $scene-gather.exr --downsample 8)
  echo "$scene: path $reference, finalgather $gathered, relative RMSE of 8x8 means $blocks"
  awk -v a="$reference" -v b="$gathered" 'BEGIN { exit !(b > 0.987 * a && b < 1.013 * a) }' || fail "$scene: means"
  awk -v r="$blocks" 'BEGIN { exit !(r < 0.04) }' || fail "$scene: blocks"
done
exit $((failures > 0))

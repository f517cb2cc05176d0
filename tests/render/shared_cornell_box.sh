#!/usr/bin/env bash
# The public Cornell box of ../shared/scenes against Tungsten's picture of it, at its own size and with its own filter.
# Means of each channel must agree within 1 %; after averaging 8 x 8 pixels the relative RMSE of two seeds must be that of our
# noise, which the two tell (RMSE between them / sqrt 2), and 2 % for the edges and Tungsten's own noise.
. "$(dirname "$0")/common.sh.inc"
scenes=$source/../shared/scenes/cornell-box
[ -f "$scenes/scene.xml" ] || { echo "skipped: ../shared/scenes is not there"; exit 77; }
"$aureole" convert "$scenes/TungstenRender.exr" reference.pfm --downsample 8 || fail "convert"
for seed in 1 2; do
  "$aureole" render "$scenes/scene.xml" -q -Dintegrator=path -Dspp=1 --seed $seed -o large.pfm &&
    "$aureole" convert large.pfm $seed.pfm --downsample 8 || fail "render"
done
"$aureole" compare reference.pfm 1.pfm --tolerance inf
for channel in r g b; do
  ours=$(figure mean_$channel reference.pfm 1.pfm)
  theirs=$(figure reference_mean_$channel reference.pfm 1.pfm)
  awk -v a="$ours" -v b="$theirs" 'BEGIN { exit !(a > 0.99 * b && a < 1.01 * b) }' || fail "mean $channel: $ours, not $theirs"
done
between=$(figure relative_rmse 1.pfm 2.pfm)
against=$(awk -v a="$(figure relative_rmse reference.pfm 1.pfm)" -v b="$(figure relative_rmse reference.pfm 2.pfm)" \
  'BEGIN { print sqrt((a * a + b * b) / 2) }')
echo "noise $between / sqrt 2, against Tungsten $against"
awk -v n="$between" -v a="$against" 'BEGIN { exit !(a * a < n * n / 2 * 1.1 + 0.02 * 0.02) }' || fail "RMSE $against"
# The scene's own integrator is research code: to render with it is an error that names ours.
"$aureole" render "$scenes/scene.xml" -q -o none.exr 2>message.txt
[ $? -eq 2 ] && grep -q "scene.xml:[0-9]*:[0-9]*: unknown integrator 'path_guiding_integrator'" message.txt || fail "$(cat message.txt)"
exit $((failures > 0))

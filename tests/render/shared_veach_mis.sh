#!/usr/bin/env bash
# The public scene veach-mis of ../shared/scenes against Tungsten's picture of it, which has direct light only: path to
# depth 2, at its own size and with its own filter. Means of each channel must agree within 2 % (two seeds differ by 0.5 %);
# after averaging 8 x 8 pixels the relative RMSE must be that of our noise, which two seeds tell (RMSE between them /
# sqrt 2), and 5 % for the edges and Tungsten's own noise.
. "$(dirname "$0")/common.sh.inc"
scenes=$source/../shared/scenes/veach-mis
[ -f "$scenes/scene.xml" ] || { echo "skipped: ../shared/scenes is not there"; exit 77; }
"$aureole" convert "$scenes/TungstenRender.exr" reference.pfm --downsample 8 || fail "convert"
for seed in 1 2; do
  "$aureole" render "$scenes/scene.xml" -q --integrator path:max_depth=2 -Dspp=4 -Dintegrator=path --seed $seed -o large.pfm &&
    "$aureole" convert large.pfm $seed.pfm --downsample 8 || fail "render"
done
"$aureole" compare reference.pfm 1.pfm --tolerance inf
for channel in r g b; do
  ours=$(figure mean_$channel reference.pfm 1.pfm)
  theirs=$(figure reference_mean_$channel reference.pfm 1.pfm)
  awk -v a="$ours" -v b="$theirs" 'BEGIN { exit !(a > 0.98 * b && a < 1.02 * b) }' || fail "mean $channel: $ours, not $theirs"
done
between=$(figure relative_rmse 1.pfm 2.pfm)
against=$(figure relative_rmse reference.pfm 1.pfm)
echo "noise $between / sqrt 2, against Tungsten $against"
awk -v n="$between" -v a="$against" 'BEGIN { exit !(a * a < n * n / 2 * 1.1 + 0.05 * 0.05) }' || fail "RMSE $against"
exit $((failures > 0))

#!/usr/bin/env bash
# Final gathering at rough plastics, whose photons are seen through the whole BSDF: means of each channel against path
# tracing in a box of them, one bounce of indirect light and all. The noise of either mean is below .2 % (two seeds tell),
# the photons' .3 %; a base that counts twice makes 10 % and more.
. "$(dirname "$0")/common.sh.inc"
cat >box.xml <<'XML'
<scene version="3.0.0">
  <integrator type="path"/>
  <sensor type="perspective"><float name="fov" value="60"/>
    <transform name="to_world"><lookat origin="0.1, -0.1, -0.9" target="0, 0, 1" up="0, 1, 0"/></transform>
    <sampler type="independent"><integer name="sample_count" value="16"/></sampler>
    <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/><rfilter type="box"/></film>
  </sensor>
  <bsdf type="twosided" id="coated"><bsdf type="roughplastic">
    <rgb name="diffuse_reflectance" value="0.7, 0.5, 0.2"/><float name="alpha" value="0.3"/></bsdf></bsdf>
  <shape type="cube"><ref id="coated"/></shape>
  <shape type="rectangle"><transform name="to_world"><scale value="0.3"/><rotate x="1" angle="90"/>
    <translate y="0.98"/></transform><emitter type="area"><rgb name="radiance" value="9, 9, 9"/></emitter></shape>
</scene>
XML
for depth in 3 -1; do
  "$aureole" render box.xml -q --sampler sobol --spp "$(either 16 1024)" --integrator path:max_depth=$depth -o path.pfm &&
    "$aureole" render box.xml -q --sampler sobol --spp "$(either 1 64)" \
      --integrator finalgather:max_depth=$depth,photons=100000,diffuse_samples=64,glossy_samples=256 -o gathered.pfm || fail "render"
  for channel in r g b; do
    ours=$(figure mean_$channel path.pfm gathered.pfm)
    theirs=$(figure reference_mean_$channel path.pfm gathered.pfm)
    echo "depth $depth, $channel: $ours, path $theirs"
    judge -v a="$ours" -v b="$theirs" 'BEGIN { exit !(a > 0.99 * b && a < 1.01 * b) }' || fail "depth $depth: $ours, not $theirs"
  done
done
exit $((failures > 0))

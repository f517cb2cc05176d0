#!/usr/bin/env bash
# Bright texels drawn as lights, and several points on lights a sample: the same image with less error. A lamp that shines at
# the ceiling from close by, so that a small spot there has most of the indirect light.
. "$(dirname "$0")/common.sh.inc"
cat >lamp.xml <<'XML'
<scene version="3.0.0">
  <integrator type="path"/>
  <sensor type="perspective"><float name="fov" value="70"/>
    <transform name="to_world"><lookat origin="0.2, -0.1, -0.9" target="0, -0.2, 1" up="0, 1, 0"/></transform>
    <sampler type="independent"><integer name="sample_count" value="4"/></sampler>
    <film type="hdrfilm"><integer name="width" value="32"/><integer name="height" value="32"/><rfilter type="box"/></film>
  </sensor>
  <bsdf type="twosided" id="wall"><bsdf type="diffuse"><rgb name="reflectance" value="0.6, 0.5, 0.4"/></bsdf></bsdf>
  <bsdf type="twosided" id="coated"><bsdf type="roughplastic">
    <rgb name="diffuse_reflectance" value="0.5, 0.5, 0.2"/><float name="alpha" value="0.3"/></bsdf></bsdf>
  <shape type="cube"><ref id="wall"/></shape>
  <shape type="rectangle"><transform name="to_world"><scale value="0.5"/><rotate x="1" angle="-60"/>
    <translate y="-0.6" z="0.4"/></transform><ref id="coated"/></shape>
  <shape type="rectangle"><transform name="to_world"><scale value="0.1"/><rotate x="1" angle="-90"/>
    <translate y="0.85"/></transform><emitter type="area"><rgb name="radiance" value="90, 80, 70"/></emitter></shape>
</scene>
XML
render() {
  "$aureole" render lamp.xml -q --sampler sobol -o "$1.exr" \
    --integrator "finalgather:photons=50000,pixel=centre,edges=0,$2" "${@:3}" || fail "$1: render"
}
directions=$(either 128 4096)
render reference diffuse_samples=$((2 * directions)),glossy_samples=$directions
render other diffuse_samples=$directions,glossy_samples=$((directions / 2)),bright_samples=$((directions / 4)),light_samples=16
render plain diffuse_samples=64
render bright diffuse_samples=64,bright_samples=16
judge -v other="$(figure relative_rmse reference.exr other.exr)" -v mean="$(figure mean_g reference.exr other.exr)" \
  -v reference="$(figure reference_mean_g reference.exr other.exr)" -v plain="$(figure rmse reference.exr plain.exr)" \
  -v bright="$(figure rmse reference.exr bright.exr)" 'BEGIN {
    printf "many of both: relative RMSE %g, mean %g, without bright texels %g; 64 directions %g, and 16 bright texels %g\n",
      other, mean, reference, plain, bright
    exit !(other < 0.03 && mean > 0.997 * reference && mean < 1.003 * reference && bright < 0.5 * plain) }' ||
  fail "bright texels count otherwise, or gain nothing"
# Direct light alone, of a lamp that is seen: as exact by 16 points per sample as by many samples.
sed -e 's/angle="-90"/angle="90"/' -e 's/y="0.85"/y="0.9"/' -i lamp.xml
render truth max_depth=2 --spp "$(either 16 1024)"
render one max_depth=2 --spp 4
render many max_depth=2,light_samples=16 --spp 4
judge -v one="$(figure rmse truth.exr one.exr)" -v many="$(figure rmse truth.exr many.exr)" \
  -v mean="$(figure mean_g truth.exr many.exr)" -v truth="$(figure reference_mean_g truth.exr many.exr)" 'BEGIN {
    printf "one point a sample %g, sixteen %g; mean %g of %g\n", one, many, mean, truth
    exit !(many < 0.5 * one && mean > 0.998 * truth && mean < 1.002 * truth) }' || fail "points on lights are miscounted"
exit $((failures > 0))

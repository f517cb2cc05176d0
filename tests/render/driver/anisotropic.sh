#!/usr/bin/env bash
# Grooves run along growing texture u however the material is wrapped: a brushed metal seen from its front is the same
# image, to the bit, bare, two-sided and below a mask that hides nothing.
. "$(dirname "$0")/common.sh.inc"
metal='<bsdf type="roughconductor"><float name="alpha_u" value="0.02"/><float name="alpha_v" value="0.4"/></bsdf>'
picture() { # picture NAME BSDF
  cat >"$1.xml" <<XML
<scene version="3.0.0">
  <integrator type="path"/>
  <sensor type="perspective"><float name="fov" value="60"/>
    <transform name="to_world"><lookat origin="0.3, -2, 2" target="0, 0, 0" up="0, 0, 1"/></transform>
    <sampler type="sobol"><integer name="sample_count" value="4"/></sampler>
    <film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="24"/></film>
  </sensor>
  <shape type="rectangle"><transform name="to_world"><rotate z="1" angle="40"/></transform>$2</shape>
  <shape type="sphere"><float name="radius" value="0.3"/><point name="center" x="0" y="0.4" z="1"/>
    <emitter type="area"><rgb name="radiance" value="9"/></emitter></shape>
</scene>
XML
  "$aureole" render "$1.xml" -q -o "$1.pfm" || fail "$1: render"
}
picture bare "$metal"
picture twosided "<bsdf type=\"twosided\">$metal</bsdf>"
picture masked "<bsdf type=\"mask\"><float name=\"opacity\" value=\"1\"/>$metal</bsdf>"
cmp bare.pfm twosided.pfm || fail "twosided"
cmp bare.pfm masked.pfm || fail "masked"
exit $((failures > 0))

#!/usr/bin/env bash
# Paths between mirrors that absorb nothing never end. They are cut, and that is said: the light is missing.
. "$(dirname "$0")/common.sh.inc"

# A camera inside a sphere that reflects all, SHAPE beside it.
scene() {
  cat <<END
<scene version="3.0.0">
  <integrator type="finalgather"/>
  <sensor type="perspective">
    <transform name="to_world"><lookat origin="0, 0, 0.3" target="1, 0, 0" up="0, 0, 1"/></transform>
    <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/></film>
  </sensor>
  <emitter type="constant"><rgb name="radiance" value="1"/></emitter>
  $1
</scene>
END
}

scene '<shape type="sphere"><bsdf type="twosided"><bsdf type="conductor"><string name="material" value="none"/></bsdf></bsdf>
       </shape>' >mirror.xml
"$aureole" render mirror.xml --spp 2 -o mirror.exr 2>message.txt || fail "mirror.xml: render"
grep -q 'warning: 512 paths of 512 samples were cut' message.txt || fail "nothing is said of cut paths: $(cat message.txt)"

scene '<shape type="sphere"><bsdf type="diffuse"/></shape>' >plain.xml
"$aureole" render plain.xml --spp 2 -o plain.exr 2>message.txt || fail "plain.xml: render"
grep -q 'cut' message.txt && fail "paths are said to be cut where none is: $(cat message.txt)"
exit $((failures > 0))

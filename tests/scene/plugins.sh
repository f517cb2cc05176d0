#!/usr/bin/env bash
# Plugins of Mitsuba 3 in small scenes: each is loaded and rendered by `path` and by `finalgather`, which must agree within
# what their noise allows; what has no effect here is said once.
set -u
aureole=$1

scene() { # scene NAME BODY: a sphere with the material m before a bright surrounding
  cat >"$1.xml" <<XML
<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><float name="fov" value="20"/>
<transform name="to_world"><lookat origin="0,2,5" target="0,0,0" up="0,1,0"/></transform>
<sampler type="sobol"><integer name="sample_count" value="64"/></sampler><film type="hdrfilm"><integer name="width" value="16"/>
<integer name="height" value="16"/><rfilter type="box"/></film></sensor>
<emitter type="constant"><rgb name="radiance" value="0.5, 0.6, 0.7"/></emitter>
<shape type="sphere"><transform name="to_world"><scale value="0.2"/><translate x="1" y="1.5" z="1"/></transform>
<emitter type="area"><rgb name="radiance" value="20"/></emitter></shape>
$2</scene>
XML
}

# agree NAME: both integrators, 6 % apart at most: at 256 samples of 16 x 16 pixels their own noise is 1 %.
agree() {
  for integrator in path finalgather; do
    "$aureole" render "$1.xml" -q --integrator $integrator --seed 3 -o "$1-$integrator.exr" ||
      { echo "$1: $integrator fails"; exit 1; }
  done
  "$aureole" compare "$1-path.exr" "$1-finalgather.exr" --downsample 16 --metric relative-rmse --tolerance 0.06 >compared ||
    { echo "$1: path and finalgather differ"; cat compared; exit 1; }
}

body='<shape type="sphere"><ref id="m"/></shape>'
material() { # material NAME BSDF
  scene "$1" "$2 $body"
  agree "$1"
}

material principled '<bsdf type="principled" id="m"><rgb name="base_color" value="0.8,0.4,0.2"/><float name="metallic" value="0.3"/>
  <float name="roughness" value="0.4"/><float name="clearcoat" value="0.5"/></bsdf>'
material principled-glass '<bsdf type="principled" id="m"><float name="spec_trans" value="0.8"/><float name="roughness" value="0.3"/></bsdf>'
material principledthin '<bsdf type="principledthin" id="m"><float name="diff_trans" value="0.8"/><float name="spec_trans" value="0.3"/></bsdf>'
material blendbsdf '<bsdf type="blendbsdf" id="m"><float name="weight" value="0.3"/><bsdf type="diffuse"/>
  <bsdf type="roughconductor"><float name="alpha" value="0.3"/></bsdf></bsdf>'
material pplastic '<bsdf type="pplastic" id="m"><float name="alpha" value="0.2"/></bsdf>'

scene filters '<bsdf type="polarizer" id="a"/><bsdf type="retarder" id="b"/><bsdf type="circular" id="c"/><bsdf type="null" id="d"/>
  <shape type="rectangle"><transform name="to_world"><translate z="1"/></transform><ref id="a"/></shape>
  <shape type="rectangle"><transform name="to_world"><translate z="0.5"/></transform><ref id="b"/></shape>
  <shape type="rectangle"><transform name="to_world"><translate z="0.2"/></transform><ref id="c"/></shape>
  <shape type="rectangle"><ref id="d"/></shape>'
"$aureole" render filters.xml -o filters.exr 2>warnings || exit 1
[ "$(grep -c unpolarised warnings)" = 1 ] || { echo "that light is unpolarised is not said once:"; cat warnings; exit 1; }

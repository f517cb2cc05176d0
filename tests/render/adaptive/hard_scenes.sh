#!/usr/bin/env bash
# Renders to targets of scenes that leave little to measure end, and report what they can.
set -u
aureole=$1
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

scene() { # scene NAME BODY
  cat >"$1.xml" <<END
<scene version='3.0.0'><default name='stddev' value='.5'/><integrator type='path'/><sensor type='perspective'><float name='fov' value='60'/><transform
name='to_world'><lookat origin='0,-.95,0' target='0,1,-.2' up='0,0,1'/></transform><film type='hdrfilm'><integer
name='width' value='12'/><integer name='height' value='8'/><rfilter type='gaussian'><float name='stddev'
value='\$stddev'/></rfilter></film></sensor>$2</scene>
END
}
matte="<bsdf type='twosided'><bsdf type='diffuse'/></bsdf>"
room="<shape type='cube'>$matte</shape>"
lamp="<emitter type='point'><point name='position' x='0' y='0' z='.5'/><rgb name='intensity' value='1'/></emitter>"
scene black "$room"
scene dark_lamp "$room<shape type='sphere'><float name='radius' value='.1'/><emitter type='area'><rgb name='radiance' value='0'/></emitter></shape>"
scene outside "$room<shape type='cube'><transform name='to_world'><scale value='3'/></transform>$matte</shape><emitter type='point'><point name='position' x='0' y='0' z='2'/><rgb name='intensity' value='1'/></emitter>"
scene point "$room$lamp"
scene sky "<emitter type='constant'/>"
scene fog "$room<shape type='sphere'><point name='center' x='0' y='.3' z='0'/><float name='radius' value='.3'/><bsdf type='null'/><medium name='interior' type='homogeneous'><rgb name='albedo' value='.8'/><float name='sigma_t' value='3'/></medium></shape>$lamp"

check() { # check SCENE WORDS OPTION...: ends in time with status 0, and says the words
  local name=$1 words=$2
  shift 2
  timeout 60 "$aureole" render "$name.xml" -t 1 --no-cache -o out.exr "$@" 2>said.txt || fail "$name $*: $(tail -1 said.txt)"
  grep -q "$words" said.txt || fail "$name $*: $(cat said.txt)"
}
for target in '--error 10%' '--rays 1000' '--time .01s' '--error 5% --error-measure display'; do
  for name in black dark_lamp outside; do
    check $name 'out.exr is black: none of .* samples per pixel met light' $target
  done
  check sky 'an error of 0 %' $target
  check point 'has an error of' $target
  check fog 'by volpath' $target
done
# Photons on a large ground are too sparse near the camera: samples do not remove the noise of their maps, and another candidate takes over.
white="<bsdf type='diffuse'><rgb name='reflectance' value='.8'/></bsdf>"
cat >ground.xml <<END
<scene version='3.0.0'><integrator type='path'><integer name='max_depth' value='8'/></integrator><sensor type='perspective'><float name='fov'
value='50'/><transform name='to_world'><lookat origin='0,-4,1.5' target='0,0,.4' up='0,0,1'/></transform><film type='hdrfilm'><integer name='width'
value='48'/><integer name='height' value='36'/><rfilter type='box'/></film></sensor><emitter type='constant'/><shape type='rectangle'><transform
name='to_world'><scale value='20'/></transform>$white</shape><shape type='cube'><transform name='to_world'><scale value='.5'/><translate
z='.5'/></transform>$white</shape><shape type='rectangle'><transform name='to_world'><scale value='2'/><rotate x='1' angle='80'/><translate
y='1.5' z='1'/></transform><bsdf type='twosided'>$white</bsdf></shape></scene>
END
check ground 'rejected: more rays were left than the next one needs' --error 1% --error-measure mean -v
# A candidate is left after half of the next one's need is spent. A round takes up to four times that, and the need is predicted up to twice
# too large: four times, and path tracing itself.
rays_of() { "$aureole" render ground.xml -t 1 --no-cache -q --json -o out.exr --error 1% --error-measure mean "$@" 2>said.txt | tr , '\n' | sed -n 's/.*"rays": //p'; }
chosen=$(rays_of) path=$(rays_of --integrator path:max_depth=8)
[ "$chosen" -le $((5 * path)) ] || fail "the ground took $chosen rays, path tracing $path"
# One pixel, filters wider than the image, and filters with negative lobes.
check point 'has an error of' --error 10% --width 1 --height 1
check point 'has an error of' --error 10% --width 2 --height 1 -D stddev=3
check point 'has an error of' --error 10% --width 4 --height 3 --filter lanczos
# A light source in glass that few paths meet: an image is not black after a few dark samples.
scene glass "$room<shape type='sphere'><point name='center' x='0' y='0' z='.5'/><float name='radius' value='.3'/><bsdf type='dielectric'/></shape><shape type='sphere'><point name='center' x='0' y='0' z='.5'/><float name='radius' value='.05'/><emitter type='area'><rgb name='radiance' value='100'/></emitter></shape>"
check glass 'has an error of' --error 50% --width 1 --height 1
# Light below the smallest normal float ends with its first bounce.
scene faint "$room<shape type='sphere'><float name='radius' value='.1'/><emitter type='area'><rgb name='radiance' value='1e-38'/></emitter></shape>"
check faint 'is black' --error 30% --integrator finalgather:photons=1000
grep -q 'were cut' said.txt && fail "a faint light: $(cat said.txt)"

# A budget next to an error ends the render: no race, whose photons alone would take more.
"$aureole" render point.xml -t 1 --no-cache -q --json -o out.exr --error 1% --rays 1000 >out.json || fail "a budget next to an error"
rays=$(sed -n 's/.*"rays": \([0-9]*\).*/\1/p' out.json)
[ "${rays:-1000000}" -lt 10000 ] || fail "$rays rays in place of 1000"

refused() { # refused WORDS OPTION...
  local words=$1
  shift
  "$aureole" render point.xml -q -o out.exr "$@" 2>said.txt
  [ $? -eq 2 ] && grep -q -- "$words" said.txt || fail "$*: $(cat said.txt)"
}
refused 'at least 1e-6, what 32-bit images resolve' --error 1e-9
refused '--error: expected' --error 0
refused '--error: expected' --error 200%
refused '--error: expected' --error nan
refused '--time: expected' --time 0
refused 'above 0 seconds and finite' --time inf
refused "'--error-measure' needs" --error-measure mean
refused '--rays: expected' --rays 0
refused '--rays: expected' --rays 1e30
refused 'below the target error' --error 1% --bias 2% --integrator path
exit $((failures > 0))

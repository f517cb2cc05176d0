#!/usr/bin/env bash
# Keys of Mitsuba 3 that change no mean: each is taken, and the image has the same bytes as without it. Lists of keys name each once.
set -u
aureole=$1
cp "$2/bench/peers/plugins/picture.png" .

image() { # image NAME BODY: the bytes of a small image, or what is said
  echo "<scene version='3.0.0'><integrator type='path'/><sensor type='perspective'><float name='fov' value='60'/><transform name='to_world'>
    <lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform><film type='hdrfilm'><integer name='width' value='6'/>
    <integer name='height' value='6'/></film></sensor><emitter type='constant'/><shape type='sphere'/>$2</scene>" >"$1.xml"
  "$aureole" render "$1.xml" -q --spp 2 -o "$1.exr" 2>"$1.said" || { echo "$1 is refused:"; cat "$1.said"; return 1; }
}

same() { # same BODY-WITH-@ KEY
  image without "${1//@/}" && image with "${1//@/$2}" || exit 1
  cmp without.exr with.exr || { echo "another image with $2 in $1"; exit 1; }
}

# A weight changes how often the light is drawn beside the constant one, and so the noise.
weighs() { # weighs BODY-WITH-@
  image without "${1//@/}" && image with "${1//@/$weight}" || exit 1
  cmp -s without.exr with.exr && { echo "the weight has no effect in $1"; exit 1; }
}

weight="<float name='sampling_weight' value='2.5'/>"
for emitter in point spot directional; do
  weighs "<emitter type='$emitter'><transform name='to_world'><lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform>@</emitter>"
done
weighs "<emitter type='sun'><vector name='sun_direction' value='0,1,1'/>@</emitter>"
weighs "<shape type='rectangle'><transform name='to_world'><translate z='-3'/></transform><emitter type='area'>@</emitter></shape>"
weighs "<shape type='disk'><transform name='to_world'><translate z='-3'/></transform><emitter type='directionalarea'>@</emitter></shape>"
same "<shape type='rectangle'>@</shape>" "<float name='silhouette_sampling_weight' value='.1'/>"
for key in "<float name='theta' value='90'/>" "<spectrum name='theta' value='90'/>" "<rgb name='theta' value='90'/>" "<rgb name='theta' value='90 90 90'/>" \
  "<spectrum name='theta' type='uniform'><float name='value' value='.5'/></spectrum>"; do
  for filter in polarizer retarder circular; do
    same "<shape type='disk'><bsdf type='$filter'>@</bsdf></shape>" "$key"
  done
done

# Environments in place of the constant one. The only light is drawn as often with any weight.
for emitter in "type='envmap'><string name='filename' value='picture.png'/>" "type='sky'>"; do
  for key in "" "$weight" "<boolean name='mis_compensation' value='true'/>"; do
    [ "$emitter" = "type='sky'>" ] && [ "${key#<b}" != "$key" ] && continue
    image around "" || exit 1
    sed "s|<emitter type='constant'/>|<emitter $emitter$key</emitter>|" around.xml >environment.xml
    "$aureole" render environment.xml -q --spp 2 -o environment.exr || exit 1
    [ -n "$key" ] || cp environment.exr first.exr
    cmp first.exr environment.exr || { echo "another image with $key"; exit 1; }
  done
done

# What is of no effect and would be noticed where it had one is a warning; elsewhere the same name is read, or unknown.
sed "s|<film type='hdrfilm'>|<float name='shutter_open' value='0'/><float name='focus_distance' value='1'/>&<boolean name='banner' value='true'/>|" \
  without.xml >warned.xml
"$aureole" render warned.xml --spp 2 -o warned.exr 2>warned.said || { cat warned.said; exit 1; }
for name in "sensor 'perspective': 'shutter_open'" "sensor 'perspective': 'focus_distance'" "film 'hdrfilm': 'banner'"; do
  grep -q "warned.xml:[0-9]*:[0-9]*: $name has no effect: " warned.said || { echo "$name is not reported:"; cat warned.said; exit 1; }
done
sed -i "s|type='perspective'|type='thinlens'|; s|<film |<float name='aperture_radius' value='1'/>&|" warned.xml
"$aureole" render warned.xml --spp 2 -o warned.exr 2>warned.said || { cat warned.said; exit 1; }
grep -q focus_distance warned.said && { cat warned.said; exit 1; }
# A sampler's own keys are read.
sed "s|<film |<sampler type='golden-set'><float name='seed' value='.25'/><integer name='sample_count' value='2'/></sampler>&|" without.xml >golden.xml
"$aureole" render golden.xml -q -o golden.exr && "$aureole" render without.xml -q --spp 2 --sampler golden-set:seed=.25 -o without.exr &&
  cmp golden.exr without.exr || { echo "the seed of a golden set is not read"; exit 1; }
image wrong "<shape type='disk'><float name='shutter_open' value='0'/></shape>" >/dev/null && exit 1
grep -q "shape 'disk' has no 'shutter_open'" wrong.said || { cat wrong.said; exit 1; }
"$aureole" render without.xml --spp 2 --width 6 --integrator path:strict_normals=true -o strict.exr 2>strict.said || { cat strict.said; exit 1; }
grep -q "integrator 'path': 'strict_normals' has no effect: it is always so" strict.said || { cat strict.said; exit 1; }
"$aureole" render without.xml -q --spp 2 --width 6 --integrator ao:max_depth=4 -o strict.exr || exit 1
for integrator in finalgather finalgather-lab; do
  "$aureole" render without.xml -q --spp 2 --width 6 --integrator $integrator:photons=1000,max_depth=1 -o $integrator.exr || exit 1
done
cmp finalgather.exr finalgather-lab.exr || { echo "the lab's integrator does not read max_depth"; exit 1; }

unknown="<float name='wzwzwzwzwzwz' value='1'/>"
for body in "<shape type='serialized'><string name='filename' value='none'/>@</shape>" "<shape type='sphere'>@</shape>" \
  "<medium type='heterogeneous' id='m'>@</medium><shape type='sphere'><ref name='interior' id='m'/></shape>" \
  "<medium type='homogeneous' id='m'>@</medium><shape type='sphere'><ref name='interior' id='m'/></shape>" \
  "<emitter type='spot'>@</emitter>" "<shape type='disk'><bsdf type='principled'>@</bsdf></shape>" \
  "<shape type='disk'><bsdf type='roughdielectric'>@</bsdf></shape>" "<shape type='disk'><bsdf type='blendbsdf'><bsdf type='diffuse'/><bsdf type='diffuse'/>@</bsdf></shape>"; do
  image listed "${body//@/$unknown}" >/dev/null && exit 1
  grep -o 'it has: .*' listed.said | sed 's/it has: //; s/, /\n/g' | sort | uniq -d >twice
  grep -q 'it has: ' listed.said && [ ! -s twice ] || { echo "named twice, or nothing is listed:"; cat listed.said; exit 1; }
done
image advice "<medium type='homogeneous' id='m'><float name='sigma_b' value='1'/></medium><shape type='sphere'><ref name='interior' id='m'/></shape>" >/dev/null && exit 1
grep -q "has no 'sigma_b'; it has: sigma_" advice.said || { cat advice.said; exit 1; }

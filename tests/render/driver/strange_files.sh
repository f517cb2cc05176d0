#!/usr/bin/env bash
# What files in the wild have: degenerate geometry, numbers of old exporters, textures that lie, assets that are not there.
. "$(dirname "$0")/common.sh.inc"
scene() { # BODY: s.xml
  cat >s.xml <<XML
<scene version="3.0.0"><integrator type="path"><integer name="max_depth" value="4"/></integrator>
<sensor type="perspective"><transform name="to_world"><lookat origin="0.5,0.3,4" target="0,0,0" up="0,1,0"/></transform>
<film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/></film></sensor>
$1
</scene>
XML
}
good() { # NAME BODY: renders, every pixel finite
  scene "$2"
  "$aureole" render s.xml -q --spp 4 -o "$1.exr" 2>message.txt || { fail "$1: $(cat message.txt)"; return; }
  "$aureole" info "$1.exr" --format csv | awk -F, 'NR > 1 && $NF != 0 { bad = 1 } END { exit bad }' || fail "$1: a pixel is not finite"
}
bad() { # NAME PATTERN BODY: one line that says where and what, status 2
  scene "$3"
  "$aureole" render s.xml -q --spp 1 -o bad.exr 2>message.txt
  [ $? -eq 2 ] && [ "$(wc -l <message.txt)" -eq 1 ] && grep -Eq "^aureole: $2" message.txt && [ ! -e bad.exr ] || fail "$1: $(cat message.txt)"
}
sky='<emitter type="constant"/>'

# Triangles without area, vertices far apart, normals and texture coordinates of zero.
printf 'v 0 0 0\nv 0 0 0\nv 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1e-30 0 0\nv 1e20 1 0\nvn 0 0 0\nvt 0 0\nf 1/1/1 2/1/1 3/1/1\nf 1/1/1 4/1/1 5/1/1\nf 1/1/1 4/1/1 6/1/1\nf 1/1/1 7/1/1 6/1/1\nf 1/1/1 8/1/1 6/1/1\n' >thin.obj
for material in '<bsdf type="roughconductor"><float name="alpha_u" value="0.1"/><float name="alpha_v" value="0.3"/></bsdf>' \
  '<bsdf type="roughdielectric"/>' '<bsdf type="twosided"><bsdf type="roughplastic"/></bsdf>'; do
  good thin "<shape type='obj'><string name='filename' value='thin.obj'/>$material</shape>$sky"
done
good thin-light "<shape type='obj'><string name='filename' value='thin.obj'/><emitter type='area'/></shape>"
good inside-light "<shape type='sphere'><float name='radius' value='9'/><boolean name='flip_normals' value='true'/><emitter type='area'/></shape><shape type='sphere'><bsdf type='dielectric'/></shape>"
good light-on-surface "<shape type='rectangle'/><emitter type='point'><rgb name='intensity' value='1'/></emitter>"
printf 'v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n' >none.obj
good no-light "<shape type='obj'><string name='filename' value='none.obj'/><emitter type='area'/></shape>"
"$aureole" info s.xml 2>&1 | grep -Eq '^aureole: warning: s.xml:[0-9]+:[0-9]+: this light has no area and gives no light' || fail "a light without area says nothing"
bad "a scale of zero" 's.xml:[0-9]+:[0-9]+: .*must not be 0' "<shape type='rectangle'><transform name='to_world'><scale x='0'/></transform><emitter type='area'/></shape>"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 1000000000\n' >far.obj
bad "an index of 10^9" 'far.obj:4: index 1000000000 is not a vertex' "<shape type='obj'><string name='filename' value='far.obj'/></shape>"
printf 'v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n' >nan.obj
bad "a vertex that is NaN" 'nan.obj:2: .*not finite' "<shape type='obj'><string name='filename' value='nan.obj'/></shape>"

# The same room, 2^36 times as large: as bright up to the rounding of the rays' beginnings.
room() { # SCALE FAR: a box that a small square lights
  scene "<shape type='cube'><boolean name='flip_normals' value='true'/><transform name='to_world'><scale value='$1'/></transform></shape>
<shape type='rectangle'><transform name='to_world'><scale value='.5'/><rotate x='1' angle='90'/><translate y='.9'/><scale value='$1'/></transform>
<emitter type='area'><rgb name='radiance' value='9'/></emitter></shape>"
  sed -i "s|<lookat.*/>|<lookat origin='0 0 -.9' target='0,0,0' up='0,1,0'/><scale value='$1'/>|" s.xml
}
for integrator in path path:packets=false direct finalgather:photons=2000; do
  for scale in 1 68719476736; do
    room $scale
    "$aureole" render s.xml -q --spp 16 --integrator "$integrator" -o room$scale.exr 2>message.txt || fail "room $scale: $(cat message.txt)"
  done
  "$aureole" compare room1.exr room68719476736.exr --metric relative-rmse --tolerance 0.01 >message.txt || fail "$integrator, 2^36 times as large: $(cat message.txt)"
done
room 1e-8
"$aureole" render s.xml --spp 1 -o tiny.exr 2>&1 | grep -q 's.xml:1:1: the scene is .* wide' || fail "no warning of a tiny scene"

# Signs of eta and k do not matter; exponents with leading zeros are numbers.
metal() { echo "<shape type='cube'><bsdf type='conductor'><rgb name='eta' value='$1'/><rgb name='k' value='$2'/></bsdf></shape>$sky"; }
good metal "$(metal '0.2 0.9 1.1' '3.9 2.4 2.1')"
good negative "$(metal '-0.2 0.9 -1.1' '-3.9 -2.4 2.1')"
cmp metal.exr negative.exr || fail "negative eta and k change the image"
good exponent "<shape type='sphere'><point name='center' x='1.5e-008' y='-2E-008' z='0'/></shape><emitter type='point'><rgb name='intensity' value='2.5e+002'/><point name='position' value='0 3e000 5'/></emitter>"

# Textures: not there, or lying about their size.
texture() { echo "<shape type='cube'><bsdf type='diffuse'><texture type='bitmap' name='reflectance'><string name='filename' value='$1'/></texture></bsdf></shape>"; }
bad "a missing texture" "s.xml:[0-9]+:[0-9]+: cannot find 'sub/none.png'; looked in \./" "$(texture sub/none.png)"
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 60000 +X 60000\nabc' >lie.hdr
bad "an HDR that lies" '(\./)?lie.hdr: claims 60000 x 60000' "$(texture lie.hdr)"
printf 'PF\n30000 30000\n-1.0\nabc' >lie.pfm
bad "a PFM that lies" '(\./)?lie.pfm: ' "$(texture lie.pfm)"
printf '\211PNG\r\n\032\n\0\0\0\rIHDR\0\0\177\377\0\0\177\377\010\002\0\0\0' >lie.png
bad "a PNG that lies" '(\./)?lie.png: ' "$(texture lie.png)"

# Cycles, includes without end, ids given twice.
bad "a cycle" 's.xml:[0-9]+:[0-9]+: .*a cycle' "<bsdf type='twosided' id='a'><bsdf type='mask'><ref id='a'/></bsdf></bsdf><shape type='cube'><ref id='a'/></shape>"
echo "<scene version='3.0.0'><include filename='self.xml'/></scene>" >self.xml
bad "an include of itself" 'self.xml:1:[0-9]+: .*nested deeper than 15' "<include filename='self.xml'/>"
bad "an id given twice" "s.xml:[0-9]+:[0-9]+: id 'a' is given twice, first at s.xml" "<bsdf type='diffuse' id='a'/><bsdf type='diffuse' id='a'/>"
exit $((failures > 0))

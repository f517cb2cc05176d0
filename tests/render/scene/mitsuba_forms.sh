#!/usr/bin/env bash
# Plugins and keys of Mitsuba that say what others say too: the images are the same, to the byte where the same numbers are drawn.
set -u
aureole=$1
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
film="<film type='hdrfilm'><integer name='width' value='8'/><integer name='height' value='8'/><rfilter type='box'/></film>"
camera="<sensor type='perspective'><float name='fov' value='30'/><transform name='to_world'><lookat origin='0,-4,3' target='0,0,0' up='0,0,1'/></transform>$film</sensor>"
light="<emitter type='point'><point name='position' x='1' y='1' z='3'/></emitter>"
render() { # render NAME BODY [OPTION...]
  local name=$1
  echo "<scene version='3.0.0'>$2</scene>" >"$name.xml"
  "$aureole" render -q --spp 16 "$name.xml" -o "$name.pfm" "${@:3}" 2>said || fail "$name: $(cat said)"
}
same() { # same WHAT BODY BODY
  render a "$2"
  render b "$3"
  cmp -s a.pfm b.pfm || fail "$1: not the same picture"
}
refused() { # refused WORDS BODY
  echo "<scene version='3.0.0'>$2</scene>" >refused.xml
  "$aureole" render -q --spp 1 refused.xml -o refused.pfm 2>said && fail "this loads: $2"
  grep -qF -- "$1" said || fail "expected '$1', not '$(cat said)'"
}

# A spot inside a shape shines from its own place, and the shape is no light.
spot="<emitter type='spot'><transform name='to_world'><lookat origin='0,0,3' target='0,0,0' up='0,1,0'/></transform></emitter>"
ball="<shape type='sphere'><point name='center' x='0' y='0' z='5'/><float name='radius' value='.1'/><bsdf type='diffuse'/>"
same "a spot in a shape" "$camera<shape type='rectangle'/>$ball$spot</shape>" "$camera<shape type='rectangle'/>$ball</shape>$spot"
refused "emitter 'constant' is not allowed inside a shape" "$camera$ball<emitter type='constant'/></shape>"

# The textures `scale` and `gridtexture` of 0.6; an object below the surface is refused in a line that names it.
floor() { echo "$camera$light<shape type='rectangle'><bsdf type='diffuse'>$1</bsdf></shape>"; }
checks() { echo "<texture type='checkerboard' name='$1'><float name='color0' value='$2'/><float name='color1' value='$3'/></texture>"; }
same "a scaled texture" "$(floor "<texture type='scale' name='reflectance'><float name='scale' value='.5'/>$(checks inner .8 .5)</texture>")" \
  "$(floor "$(checks reflectance .4 .25)")"
same "a grid of broad lines" "$(floor "<texture type='gridtexture' name='reflectance'><float name='color1' value='.7'/><float name='line_width' value='.5'/></texture>")" \
  "$(floor "<float name='reflectance' value='.7'/>")"
refused "subsurface 'dipole' is not supported: 'homogeneous' inside" "$camera$light<shape type='rectangle'><subsurface type='dipole'/></shape>"

# A medium by scattering and absorption.
medium() { echo "<integrator type='volpath'/>$camera<emitter type='constant'/><shape type='sphere'><bsdf type='null'/><medium name='interior' type='homogeneous'>$1</medium></shape>"; }
same "sigma_s and sigma_a" "$(medium "<rgb name='sigma_s' value='1,2,3'/><rgb name='sigma_a' value='1,0,1'/>")" \
  "$(medium "<rgb name='sigma_t' value='2,2,4'/><rgb name='albedo' value='.5,1,.75'/>")"
same "sigma_a alone" "$(medium "<float name='sigma_a' value='2'/>")" "$(medium "<float name='sigma_t' value='2'/><float name='albedo' value='0'/>")"
refused "or 'sigma_t' and 'albedo', not both" "$(medium "<float name='sigma_s' value='1'/><float name='sigma_t' value='1'/>")"

# A volume that is the same everywhere may be moved.
volume() { medium "<volume name='albedo' type='constvolume'><float name='value' value='.5'/>$1</volume>"; }
same "constvolume with to_world" "$(volume "<transform name='to_world'><scale value='3'/></transform>")" "$(volume "")"

near() { # near WHAT BODY BODY: pictures of diffuse floors differ by rounding alone
  render a "$2"
  render b "$3"
  [ "$(wc -c <a.pfm)" -gt 200 ] || fail "$1: no picture"
  python3 - a.pfm b.pfm <<'PY' || fail "$1: the pictures differ"
import struct, sys
def values(name):
    data = open(name, "rb").read()[-8 * 8 * 3 * 4:]
    return struct.unpack("<192f", data)
a, b = (values(name) for name in sys.argv[1:])
sys.exit(not (max(b) > 0 and all(abs(x - y) <= 1e-5 * max(b) for x, y in zip(a, b))))
PY
}
# A radiancemeter sees what the middle of a camera sees, by either way of saying where it looks.
meter() { echo "$light<shape type='rectangle'/><sensor type='radiancemeter'>$1$film</sensor>"; }
aimed="<point name='origin' x='0' y='-4' z='3'/><vector name='direction' x='0' y='4' z='-3'/>"
turned="<transform name='to_world'><lookat origin='0,-4,3' target='0,0,0' up='0,0,1'/></transform>"
near "a radiancemeter" "$(meter "$aimed")" "$(meter "$turned")"
near "a radiancemeter and a camera" "$(meter "$aimed")" \
  "$light<shape type='rectangle'/><sensor type='perspective'><float name='fov' value='1e-4'/>$turned$film</sensor>"
refused "'origin' with 'direction'" "$(meter "<point name='origin' x='0' y='-4' z='3'/>")"

# An irradiance meter: pi everywhere in light of radiance 1, and pi R^2 / (R^2 + h^2) before a disk of radius R at h.
meters() { # meters EXACT ALLOWED BODY: all pixels are within a share of the exact value
  render a "$3" "${@:4}"
  python3 - "$1" "$2" <<'PY' || fail "an irradiance meter, $3"
import struct, sys
values = struct.unpack("<192f", open("a.pfm", "rb").read()[-768:])
exact, allowed = float(sys.argv[1]), float(sys.argv[2])
mean = sum(values) / len(values)
sys.exit(abs(mean - exact) > allowed * exact or max(values) > 2 * exact or min(values) < 0)
PY
}
meter="<sensor type='irradiancemeter'>$film</sensor>"
for shape in sphere rectangle cube disk cylinder; do
  meters 3.14159265 1e-6 "<shape type='$shape'>$meter<bsdf type='diffuse'><float name='reflectance' value='0'/></bsdf></shape><emitter type='constant'/>"
done
small="<transform name='to_world'><scale value='.001'/></transform>"
lit="<shape type='disk'><transform name='to_world'><rotate x='1' angle='180'/><translate z='2'/></transform><emitter type='area'/></shape>"
# 16 Sobol points in each of 64 pixels: all of them miss pi / 5 by less than 5 of a hundred.
meters 0.62831853 0.05 "<shape type='rectangle'>$small$meter</shape>$lit" --sampler sobol
meters 0.62831853 0.05 "<shape type='disk'>$small$meter</shape>$lit" --sampler sobol --integrator path:packets=false
refused "it must be inside a <shape>" "<sensor type='irradiancemeter'/>"
refused "takes no 'to_world'" "<shape type='sphere'><sensor type='irradiancemeter'><transform name='to_world'/></sensor></shape>"

# A texture may be called a spectrum; the shapes of a `merge` stand in its place.
check="name='reflectance'><float name='color0' value='.2'/>"
floor() { echo "$camera$light<shape type='rectangle'><bsdf type='diffuse'>$1</bsdf></shape>"; }
same "a spectrum that is a texture" "$(floor "<spectrum type='checkerboard' $check</spectrum>")" "$(floor "<texture type='checkerboard' $check</texture>")"
same "merge" "$camera$light<shape type='merge'><shape type='rectangle'/><shape type='sphere'/></shape>" "$camera$light<shape type='rectangle'/><shape type='sphere'/>"

# A volume as a texture: constant, it is a colour; else it is where the surface is, whatever paths go in packets.
inside() { floor "<texture type='volume' name='reflectance'><volume name='volume' $1</volume></texture>"; }
near "a constant volume as a texture" "$(inside "type='constvolume'><float name='value' value='.4'/>")" \
  "$(floor "<rgb name='reflectance' value='.4'/>")"
cp "$2/bench/peers/plugins/tint.vol" .
grid="type='gridvolume'><string name='filename' value='tint.vol'/><transform name='to_world'><translate x='-.5' y='-.5' z='-.5'/><scale value='2'/>"
render a "$(inside "$grid</transform>")"
render b "$(inside "$grid</transform>")" --integrator path:packets=false
cmp -s a.pfm b.pfm || fail "a volume as a texture: packets show another image"
# Moved with the volume by 10, the floor is the same; without it, it is not.
far() { inside "$grid$1</transform>" | sed "s|origin='0,-4,3' target='0,0,0'|origin='10,-4,3' target='10,0,0'|; s|x='1' y='1' z='3'|x='11' y='1' z='3'|
  s|<shape type='rectangle'>|&<transform name='to_world'><translate x='10'/></transform>|"; }
near "a volume that is moved" "$(inside "$grid</transform>")" "$(far "<translate x='10'/>")"
render a "$(inside "$grid</transform>")"
render b "$(far "")"
cmp -s a.pfm b.pfm && fail "a volume as a texture is not where the surface is"
refused "its radiance cannot be a texture 'volume'" "$camera<shape type='sphere'><emitter type='area'><texture type='volume' name='radiance'><volume name='volume' type='constvolume'/></texture></emitter></shape>"
refused "it needs a <volume>" "$(floor "<texture type='volume' name='reflectance'/>")"

# A mixture of Mitsuba 0.6 is blends of each material and the rest; what its weights lack is black, and too large ones are scaled.
grey() { echo "<bsdf type='diffuse'><float name='reflectance' value='$1'/></bsdf>"; }
mixture() { floor "<bsdf type='mixturebsdf'><string name='weights' value='$1'/>$2</bsdf>" | sed "s|<bsdf type='diffuse'><bsdf|<bsdf|; s|</bsdf></bsdf></shape>|</bsdf></shape>|"; }
near "a mixture of one" "$(mixture .5 "$(grey .8)")" "$camera$light<shape type='rectangle'>$(grey .4)</shape>"
near "a mixture of two" "$(mixture ".25 .75" "$(grey .8)$(grey .4)")" "$camera$light<shape type='rectangle'>$(grey .5)</shape>"
near "a mixture of three" "$(mixture ".25, .25, .25" "$(grey .8)$(grey .4)$(grey .2)")" "$camera$light<shape type='rectangle'>$(grey .35)</shape>"
near "weights above 1" "$(mixture "1 3" "$(grey .8)$(grey .4)")" "$camera$light<shape type='rectangle'>$(grey .5)</shape>"
near "weights of 0" "$(mixture "0 1 0" "$(grey .8)$(grey .4)$(grey .2)")" "$camera$light<shape type='rectangle'>$(grey .4)</shape>"
refused "'weights' must be one number for each of its 2 bsdfs (found '1')" "$(mixture 1 "$(grey .8)$(grey .4)")"
refused "'weights' must be one number for each of its 1 bsdfs (found '')" "$camera<bsdf type='mixturebsdf'><string name='weights'/>$(grey .8)</bsdf>"
refused "'weights' must be between 0 and 1 (found '-1')" "$(mixture -1 "$(grey .8)")"

# An integrator that is not known does not matter where another one takes its place, whatever stands inside.
others="<integrator type='statistical'><integrator type='path'/><integrator type='volpath'/></integrator>"
render a "$others$(floor "")" --integrator path
render b "$(floor "")"
cmp -s a.pfm b.pfm || fail "an integrator that is not known: not the same image"
refused "unknown integrator 'statistical'" "$others$(floor "")"
deep="<integrator type='OUTER'><integrator type='aov'><string name='aovs' value='d:depth'/><integrator type='path'/></integrator></integrator>"
render a "${deep/OUTER/statistical}$(floor "")" --integrator path
cmp -s a.pfm b.pfm || fail "an integrator around two: not the same image"
for outer in moment aov; do refused "a second <integrator> inside another" "${deep/OUTER/$outer}$(floor "")"; done

# Materials and textures that nothing refers to are not built, so that a file that they name need not be there.
same "materials that are not used" "$camera$light<shape type='rectangle'>$(grey .4)</shape><texture type='bitmap' id='t'><string name='filename' value='none.png'/></texture>
<bsdf type='diffuse' id='m'><texture type='bitmap' name='reflectance'><string name='filename' value='none.png'/></texture></bsdf>" "$camera$light<shape type='rectangle'>$(grey .4)</shape>"
refused "none.png" "$camera<bsdf type='diffuse'><texture type='bitmap' name='reflectance'><string name='filename' value='none.png'/></texture></bsdf>"

# What is not supported is refused by name, with the reason.
refused "integrator 'stokes' is not supported: light is unpolarised here" "<integrator type='stokes'><integrator type='path'/></integrator>$(floor "")"
refused "shape 'sdfgrid' is not supported: a mesh" "$camera<shape type='sdfgrid'/>"
refused "bsdf 'measured_polarized' is not supported: " "$camera<bsdf type='measured_polarized'/>"
refused "bsdf 'coating': it needs a nested bsdf that lets no light through" "$camera<bsdf type='coating'><bsdf type='dielectric'/></bsdf>"
refused "'int_ior' must be above 'ext_ior'" "$camera<bsdf type='coating'><float name='int_ior' value='.9'/><bsdf type='diffuse'/></bsdf>"
refused "integrator 'bdpt' is not supported: --integrator path" "<integrator type='bdpt'/>$(floor "")"
refused "film 'mfilm' is not supported: images are" "${camera/hdrfilm/mfilm}"

# Elements and types of Mitsuba 0.6.
colored() { floor "<rgb name='reflectance' value='$1'/>"; }
same "digits of rgb are linear" "$(colored '#ff8033')" "$(colored "1, .50196078431372548, .2")"
near "digits of srgb are what a screen is sent" "$(floor "<srgb name='reflectance' value='#8000ff'/>")" "$(colored ".2158605, 0, 1")"
near "numbers of srgb" "$(floor "<srgb name='reflectance' value='.5'/>")" "$(colored .2140411)"
refused "<srgb> needs a 'value'" "$(floor "<srgb name='reflectance' value='red'/>")"
same "blackbody" "$camera<shape type='rectangle'/><emitter type='constant'><blackbody name='radiance' temperature='5000K'/></emitter>" \
  "$camera<shape type='rectangle'/><emitter type='constant'><spectrum name='radiance' type='blackbody'><float name='temperature' value='5000'/></spectrum></emitter>"
refused "'temperature'" "$camera<emitter type='constant'><blackbody name='radiance'/></emitter>"
same "tiledhdrfilm" "${camera/hdrfilm/tiledhdrfilm}$light<shape type='rectangle'/>" "$camera$light<shape type='rectangle'/>"
same "volpath_simple" "<integrator type='volpath_simple'/>$(floor "")" "<integrator type='volpath'/>$(floor "")"
metal() { echo "$camera$light<shape type='rectangle'><bsdf type='roughconductor'><float name='alpha' value='.5'/>$1</bsdf></shape>"; }
near "a metal under water" "$(metal "<rgb name='eta' value='1.33'/><rgb name='k' value='2.66'/><string name='ext_eta' value='water'/>")" \
  "$(metal "<rgb name='eta' value='.9977494'/><rgb name='k' value='1.9954989'/>")"
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float r\nproperty float g\nproperty float b\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n-1 -1 0 .1 .2 .3\n1 -1 0 .3 .2 .1\n0 1 0 .5 .5 .5\n3 0 1 2\n' >colors.ply
painted() { echo "$camera$light<shape type='ply'><string name='filename' value='colors.ply'/><bsdf type='diffuse'><texture name='reflectance' $1</texture></bsdf></shape>"; }
same "vertexcolors" "$(painted "type='vertexcolors'>")" "$(painted "type='mesh_attribute'><string name='name' value='vertex_color'/>")"

# Files as Windows writes them.
mkdir -p Parts && echo "<scene version='3.0.0'>$(grey .4 | sed "s|'diffuse'|& id='m'|")</scene>" >Parts/m.xml
same "the other slash" "<include filename='Parts\\m.xml'/>$camera$light<shape type='rectangle'><ref id='m'/></shape>" "$camera$light<shape type='rectangle'>$(grey .4)</shape>"
for encoding in windows-1252 ASCII; do
  printf '\r\n<?xml version="1.0" encoding="%s"?>\r\n<!-- \xe9 -->\r\n%s' $encoding "$(cat b.xml)" >encoded.xml
  "$aureole" render -q --spp 16 encoded.xml -o a.pfm && cmp -s a.pfm b.pfm || fail "a scene in $encoding"
done

exit $((failures > 0))

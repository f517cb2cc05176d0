#!/usr/bin/env bash
# A cover just before a light hides it, by irradiance and by every integrator, one path at a time and sixteen: a black plate nearer
# to the light than a millionth of the way to it (3e-6 where both are tilted and stand far from the origin). The light itself never
# hides its points: without the plate its light is the same at all these places.
. "$2/tests/lighting/checks.sh.inc"
black='<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf>'
glow='<emitter type="area"/>'
flip='<boolean name="flip_normals" value="true"/>'

# scene LIGHT MOVE GAP: a floor at 0, a light at 1, a plate below it, and a lamp above the plate, for photons.
scene() {
  local place="<transform name=\"to_world\"><scale value=\".5\"/><translate z=\"1\"/>$2</transform>" light
  case $1 in
    rectangle) light="<shape type=\"rectangle\">$flip$place$glow</shape>" ;;
    textured)
      light="<shape type=\"rectangle\">$flip$place<emitter type=\"area\"><texture name=\"radiance\" type=\"checkerboard\"/></emitter>
        </shape>"
      ;;
    disk) light="<shape type=\"disk\">$flip$place$glow</shape>" ;;
    sphere) light="<shape type=\"sphere\"><vector name=\"center\" value=\"0 0 1\"/>$place$glow</shape>" ;;
    polygon) light="<shape type=\"polygon\"><string name=\"vertices\" value=\"-1 -1 0 -1.2 1 0 .2 1.4 0 1 1 0 1 -1 0\"/>$place$glow</shape>" ;;
    point)
      light="<emitter type=\"point\"><transform name=\"to_world\"><translate z=\"1\"/>$2</transform></emitter>" ;;
  esac
  cat <<XML
<scene version="3.0.0">$light<shape type="rectangle">$black<transform name="to_world"><scale value="3"/>
<translate z="$(awk "BEGIN { printf \"%.10g\", 1 - $3 }")"/>$2</transform></shape>
<shape type="rectangle"><transform name="to_world"><scale value="1"/>$2</transform></shape>
<emitter type="point"><transform name="to_world"><translate z="2.5"/>$2</transform></emitter>
<sensor type="perspective"><float name="fov" value="30"/><transform name="to_world"><lookat origin="1.2 0 .6" target="0 0 0"
up="0 0 1"/>$2</transform><film type="hdrfilm"><integer name="width" value="12"/><integer name="height" value="12"/>
<rfilter type="box"/></film></sensor></scene>
XML
}

# hidden LIGHT GAP NAME MOVE INTEGRATORS: nothing on the floor is lit.
hidden() {
  local integrator
  scene "$1" "$4" "$2" >hidden.xml
  "$aureole" irradiance -q hidden.xml --sensors "$3.pts" -n 256 -o hidden.csv || fail "irradiance $1 $2 $3"
  awk -F, 'NR > 1 && $4 != 0 { bad = 1 } END { exit bad || NR != 3 }' hidden.csv || fail "irradiance, $1 $2 $3: $(cat hidden.csv)"
  for integrator in $5; do
    "$aureole" render -q hidden.xml --integrator $integrator --spp 4 -o hidden.pfm || fail "$integrator $1 $2 $3"
    tail -c 1728 hidden.pfm | od -An -v -tx4 | grep -q '[1-9a-f]' && fail "$integrator, $1 $2 $3: light shines through"
  done
}

# Three unit axes that are those of the turn, and a place.
turn='<rotate x="1" y="2" z="-1" angle="40"/>'
far="$turn<translate x=\"2600000\" y=\"1200000\" z=\"400\"/>"
printf '0 0 0 0 0 1\n.3 .2 0 0 0 1\n' >here.pts
awk -v angle=40 'BEGIN {
  pi = atan2(0, -1); c = cos(angle * pi / 180); s = sin(angle * pi / 180); l = sqrt(6); x = 1 / l; y = 2 / l; z = -1 / l
  r[0] = c + x * x * (1 - c); r[1] = x * y * (1 - c) - z * s; r[2] = x * z * (1 - c) + y * s
  r[3] = y * x * (1 - c) + z * s; r[4] = c + y * y * (1 - c); r[5] = y * z * (1 - c) - x * s
  r[6] = z * x * (1 - c) - y * s; r[7] = z * y * (1 - c) + x * s; r[8] = c + z * z * (1 - c)
  for (i = 0; i < 2; ++i)
    printf "%.12f %.12f %.12f %.12f %.12f %.12f\n", 2600000 + i * (.3 * r[0] + .2 * r[1]), 1200000 + i * (.3 * r[3] + .2 * r[4]),
      400 + i * (.3 * r[6] + .2 * r[7]), r[2], r[5], r[8] }' >far.pts
for light in rectangle textured disk sphere polygon point; do
  hidden $light 1e-6 here '' "path path:packets=false direct finalgather:photons=2000 volpath"
  hidden $light 3e-5 here '' path
  hidden $light 3e-6 far "$far" "path path:packets=false"
  # Without the plate, which lies in the floor's plane: far away sensors stand off the floor by up to 1e-5.
  scene $light '' 1 | sed 's/2.5/-5/' >open.xml
  scene $light "$far" 1 | sed 's/2.5/-5/' >away.xml
  "$aureole" irradiance -q open.xml --sensors here.pts -n 4096 -o open.csv || fail "$light"
  "$aureole" irradiance -q away.xml --sensors far.pts -n 4096 -o away.csv || fail "$light, far away"
  paste -d, open.csv away.csv | awk -F, 'NR > 1 { d = $4 - $13; if (d * d > 25 * ($7 ^ 2 + $16 ^ 2) + 1e-8 * $4 ^ 2 || !($4 > .15)) bad = 1 }
    END { exit bad || NR != 3 }' || fail "$light is another one far away: $(cat open.csv away.csv)"
  # By its view factor 2 / pi a / sqrt(1 + a^2) atan(a / sqrt(1 + a^2)) with a = 1/2.
  [ $light = rectangle ] || continue
  awk -F, 'NR == 2 { a = .5 / sqrt(1.25); d = $4 - 4 * a * atan2(a, 1); exit !(d * d < 1e-10) }' open.csv ||
    fail "a rectangle that is flipped: $(cat open.csv)"
done

finish

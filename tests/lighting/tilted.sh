#!/usr/bin/env bash
# Light on and above large grounds that pass near the origin, however they are turned: above a ground of albedo 1 under a sky of
# radiance 1 every sensor gets pi, whichever way it looks. The mean of 8 seeds is within t standard errors of it, t = 7.89 the
# quantile of Student's t with 7 degrees of freedom for 1e-4; on the ground, where all directions see the sky, it is pi.
. "$2/tests/lighting/checks.sh.inc"
seeds=8
[ -n "${AUREOLE_SHORT_TESTS:-}" ] && seeds=2

# A shape whose point (0, 0, 0) is moved to `away`, with a map `own` before.
scene() { # scene SHAPE SIZE ANGLE AWAY
  printf '<scene version="3.0.0"><emitter type="constant"/>
%s<transform name="to_world">%s<scale value="%s"/><rotate x="1" y="2" z="-1" angle="%s"/><translate x="%s" y="%s"/></transform>
<bsdf type="diffuse"><rgb name="reflectance" value="1"/></bsdf></shape></scene>\n' "$1" "$5" "$2" "$3" "$4" "$4" >tilted.xml
}

# Sensors about the middle of a ground, HEIGHT of its size above it, looking DOWN or up.
sensors() { # sensors SIZE ANGLE AWAY HEIGHT DOWN
  awk -v size="$1" -v angle="$2" -v away="$3" -v height="$4" -v down="$5" '
    function turned(x, y, z, t, c, s, d) { # about (1, 2, -1)
      t = angle * 3.14159265358979323846 / 180; c = cos(t); s = sin(t); d = (x + 2 * y - z) / 6 * (1 - c); s /= sqrt(6)
      to[1] = x * c + (2 * z + y) * s + d; to[2] = y * c + (-x - z) * s + 2 * d; to[3] = z * c + (y - 2 * x) * s - d }
    BEGIN { print "x,y,z,nx,ny,nz"
      n = split("0 0 .01 0 0 .02 .001 -.003 .2 .1 -.03 .15", at, " ")
      for (i = 1; i < n; i += 2) {
        turned(at[i] * size, at[i + 1] * size, height * size)
        printf "%.17g,%.17g,%.17g,", to[1] + away, to[2] + away, to[3]
        turned(down * .6 * (i % 4 == 1), 0, down ? -.8 : 1)
        printf "%.17g,%.17g,%.17g\n", to[1], to[2], to[3] } }' >sensors.csv
}

judge() { # judge NAME: of the last runs
  awk -F, -v name="$1" -v seeds=$seeds '/^[-0-9]/ { ++count; sum += $4 } /^end/ { all += sum / count; squares += (sum / count) ^ 2; ++n; sum = count = 0 }
    END { mean = all / n; variance = (squares - n * mean * mean) / (n - 1); error = sqrt((variance > 0 ? variance : 0) / n)
          off = mean - 3.14159265358979323846
          printf "%s: off by %.6f +- %.6f\n", name, off, error
          exit !(n == seeds && off * off <= ((seeds > 2 ? 7.89 : 1e4) * error + 1e-5) ^ 2) }' runs || fail "$1"
}

look() { # look ARGUMENTS...: at sensors.csv, by all seeds
  for seed in $(seq $seeds); do
    "$aureole" irradiance tilted.xml --sensors sensors.csv -n 64 --to csv --seed $seed "$@" 2>said || fail "$(cat said)"
    echo end
  done >runs
}

rectangle='<shape type="rectangle">'
polygon='<shape type="polygon"><string name="vertices" value="-1 -1 0 1 -1 0 1 1 0 .4 1.3 0 -1 1 0"/>'
disk='<shape type="disk">'
instance='<shape type="shapegroup" id="g"><shape type="rectangle"><bsdf type="diffuse"><rgb name="reflectance" value="1"/></bsdf></shape></shape>
<shape type="instance"><ref id="g"/>'
off='<translate x="-.13" y=".21"/>'
for row in "rectangle .05 40 0" "rectangle 7.5 40 0" "polygon 7.5 200 0" "rectangle 1e3 -60 0" "polygon 1e5 40 0" "disk 1e4 40 0" \
           "rectangle 20 40 -5" "rectangle 20 130 1e6" "rectangle 1e3 .01 0"; do
  read -r shape size angle away <<<"$row"
  scene "${!shape}" "$size" "$angle" "$away" "$off"
  sensors "$size" "$angle" "$away" .01 1
  look
  judge "above $row"
  sensors "$size" "$angle" "$away" 0 0
  look
  judge "on $row"
  grep -q "6 of 6 sensors lie on surfaces" said || fail "on $row: $(cat said)"
done

# Copies have no material of their own.
scene "$instance" 7.5 40 0 "$off"
sed -i '$ s/<bsdf.*<\/bsdf><\/shape><\/scene>/<\/shape><\/scene>/' tilted.xml
sensors 7.5 40 0 .01 1
look
judge "above an instance"

# The top of a sphere that is far larger than the scene: sensors on it, and just above it.
for radius in 1e2 1e5 1e7; do
  scene '<shape type="sphere">' $radius 0 0 '<translate x="-.36" y="-.48" z="-.8"/>'
  printf '0 0 0 .36 .48 .8\n' >sensors.csv
  look
  judge "on a sphere of $radius"
  printf '.36 .48 .8 -.36 -.48 -.8\n3.6 4.8 8 .8 0 -.6\n' >sensors.csv
  [ $radius = 1e7 ] || look
  [ $radius = 1e7 ] || judge "above a sphere of $radius"
done

# Tables .01 mm to 2 cm above a level ground of 100 km, near its middle and far from it, hide the sky from the ground below, and look at
# the sky: within 6 standard errors (15 degrees of freedom: a chance of 2e-5). They are not in the ground's plane.
for height in .02 .001 1e-5; do
  table() { printf '<shape type="rectangle"><transform name="to_world"><scale value="3"/><translate x="%s" z="%s"/></transform>
<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf></shape>' "$1" $height; }
  cat >table.xml <<XML
<scene version="3.0.0"><emitter type="constant"/>
<shape type="rectangle"><transform name="to_world"><scale value="5e4"/></transform><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape>
$(table 0)$(table 4e4)</scene>
XML
  printf '%s 0 %s 0 0 1\n' 0 0 40000 0 0 $height 40000 $height >table.pts
  "$aureole" irradiance table.xml --sensors table.pts -n 256 --to csv 2>said |
    awk -F, 'NR > 1 { ++n; bad += NR < 4 ? $4 > .01 : ($4 - 3.14159265) ^ 2 > (6 * $7 + 1e-5) ^ 2 } END { exit bad > 0 || n != 4 }' ||
    fail "a table $height high: $(cat said)"
  ! grep -q "in the plane of others" said || fail "a table $height high: $(cat said)"
done

# From a camera, of grounds of +-50 and balls of radius 1000 that touch the origin: all of 768 values are not occluded, to the bit.
look_from() { # look_from CAMERA SHAPE
  cat >scene.xml <<XML
<scene version="3.0.0"><integrator type="ao"/><sensor type="perspective"><transform name="to_world"><lookat origin="$1" target="0, 0, 0"
  up=".3, .5, .1"/></transform><film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/></film>
  <sampler type="independent"><integer name="sample_count" value="4"/></sampler></sensor>$2<emitter type="constant"/></scene>
XML
  whole=$("$aureole" render scene.xml --no-cache -q -o ao.pfm && tail -c 3072 ao.pfm | od -An -v -tx4 -w4 | grep -c 3f800000)
  [ "$whole" = 768 ] || fail "from $1: $whole of 768 values are not occluded"
}
for tilt in ".1, 0, 1" "1, 1, 1" "2, -3, .5"; do
  look_from "$tilt" "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"50\"/><lookat origin=\"0, 0, 0\" target=\"$tilt\" up=\".3, .5, .1\"/></transform></shape>"
done
for ball in "0 0 -1000" "600 0 -800" "-480 600 -640"; do
  read -r x y z <<<"$ball"
  look_from "$(awk "BEGIN { printf \"%g, %g, %g\", -($x) / 500, -($y) / 500, -($z) / 500 }")" \
    "<shape type=\"sphere\"><point name=\"center\" x=\"$x\" y=\"$y\" z=\"$z\"/><float name=\"radius\" value=\"1000\"/></shape>"
done
# Below a rug nothing arrives, from 3e-7 above a floor 2 wide on, tilted and at map coordinates (below, it is in the floor's plane): two sensors on the floor and one
# on the rug's underside read 0; below a light pi times its radiance, and below only air (null) the sky, as beside the rug and on it.
rugs() { # rugs GAP ANGLE X Y RUG EXPECTED
  local map="<rotate x=\"1\" y=\"2\" z=\"-1\" angle=\"$2\"/><translate x=\"$3\" y=\"$4\"/>"
  cat >rug.xml <<XML
<scene version="3.0.0"><emitter type="constant"/>
<shape type="rectangle"><transform name="to_world">$map</transform><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></shape>
<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="180"/><scale value=".4"/><translate x="-.3" z="$1"/>$map</transform>$5</shape></scene>
XML
  awk -v gap="$1" -v angle="$2" -v x="$3" -v y="$4" 'function turned(a, b, c, t, k, s, d) { # about (1, 2, -1)
      t = angle * 3.14159265358979323846 / 180; k = cos(t); s = sin(t); d = (a + 2 * b - c) / 6 * (1 - k); s /= sqrt(6)
      return sprintf("%.17g %.17g %.17g", a * k + (2 * c + b) * s + d + m * x, b * k + (-a - c) * s + 2 * d + m * y, c * k + (b - 2 * a) * s - d) }
    function sensor(a, b, c, up, at) { m = 1; at = turned(a, b, c); m = 0; print at, turned(0, 0, up) }
    BEGIN { sensor(-.3, .1, 0, 1); sensor(-.4, -.23, 0, 1); sensor(-.3, .1, gap, -1); sensor(.4, .3, 0, 1); sensor(-.3, .1, gap, 1) }' >rug.pts
  "$aureole" irradiance rug.xml --sensors rug.pts -n 64 --to csv 2>said |
    awk -F, -v below="$6" 'NR > 1 { ++n; e = NR < 4 ? below : NR == 4 ? 0 : 3.14159265; d = $4 - e; bad += d * d > (7 * $7 + 1e-5) ^ 2 } END { exit bad > 0 || n != 5 }' ||
    fail "a rug $*: $(cat said)"
}
dark='<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf>'
for gap in 4e-7 1e-6 2.5e-6 1e-5 1e-3; do
  for place in "0 0 0" "40 0 0" "75 500000.25 5200000.5" "-130 2600000 1200000" "20 1e5 1e5" "33 30 40"; do
    rugs $gap $place "$dark" 0
  done
done
rugs 2e-6 75 500000.25 5200000.5 "$dark<emitter type=\"area\"><rgb name=\"radiance\" value=\"2\"/></emitter>" 6.2831853
rugs 2e-6 75 500000.25 5200000.5 '<bsdf type="null"/>' 3.14159265
# Of two disks in one place, which are no triangles, nothing tells which lies on the other: a warning names the first sensor.
disk='<shape type="disk"><transform name="to_world"><scale value="1"/></transform></shape>'
echo "<scene version=\"3.0.0\"><emitter type=\"constant\"/>$disk${disk/value=\"1/value=\".5}</scene>" >disks.xml
printf '.8 0 0 0 0 1\n.1 .1 0 0 0 1\n' >disks.pts
"$aureole" irradiance disks.xml --sensors disks.pts -n 64 2>&1 | grep -qF 'disks.pts:2: 1 of 2 sensors lie where surfaces are closer than the rounding of coordinates (the first is sensor 1)' ||
  fail "no warning of two disks in one place"
finish

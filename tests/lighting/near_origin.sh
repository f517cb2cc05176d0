#!/usr/bin/env bash
# A tilted ground far wider than the coordinates of the places that are looked at: rays that leave it never meet it. Under an even sky
# nothing is occluded, to the bit, and irradiances are pi: of 15 sensors none is off by more than 7 standard errors (16 randomisations:
# a chance below 1e-4 in all).
set -u
aureole=$1
failures=0

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# ground A B C: the square of +-50 turned to the normal (A, B, C), and sensors on it; leaves the normal in $normal.
ground() {
  awk -v a="$1" -v b="$2" -v c="$3" 'BEGIN {
    l = sqrt(a * a + b * b + c * c); a /= l; b /= l; c /= l
    m = sqrt(a * a + b * b); ux = -b / m; uy = a / m; vx = -c * uy; vy = c * ux; vz = a * uy - b * ux
    n = split("-50 -50 50 -50 50 50 -50 50", at, " ")
    for (i = 1; i < n; i += 2)
      printf "v %.17g %.17g %.17g\n", at[i] * ux + at[i+1] * vx, at[i] * uy + at[i+1] * vy, at[i+1] * vz >"ground.obj"
    print "f 1 2 3 4" >"ground.obj"
    n = split("0 0 1e-7 0 1 0 .3 .2 20 -31", at, " ")
    for (i = 1; i < n; i += 2)
      printf "%.17g %.17g %.17g %.17g %.17g %.17g\n", at[i] * ux + at[i+1] * vx, at[i] * uy + at[i+1] * vy, at[i+1] * vz, a, b, c >"s.pts"
    printf "%.17g, %.17g, %.17g", 2 * a + .3, 2 * b, 2 * c }'
}

# look CAMERA SHAPE: how much of a small picture of the origin is not occluded, of 768 values.
look() {
  cat >scene.xml <<XML
<scene version="3.0.0"><integrator type="ao"/><sensor type="perspective"><transform name="to_world"><lookat origin="$1" target="0, 0, 0"
  up=".3, .5, .1"/></transform><film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/></film>
  <sampler type="independent"><integer name="sample_count" value="4"/></sampler></sensor>$2<emitter type="constant"/></scene>
XML
  "$aureole" render scene.xml --no-cache -q -o ao.pfm && tail -c 3072 ao.pfm | od -An -v -tx4 -w4 | grep -c 3f800000
}

for tilt in ".1 0 1" "1 1 1" "2 -3 .5"; do
  whole=$(look "$(ground $tilt)" '<shape type="obj"><string name="filename" value="ground.obj"/></shape>')
  [ "$whole" = 768 ] || fail "normal $tilt: $whole of 768 values are not occluded"
  "$aureole" irradiance scene.xml --sensors s.pts -n 256 --max-depth 1 -q --to csv |
    awk -F, 'NR > 1 { d = $4 - 3.14159265358979; ++n; bad += !(d <= 7 * $7 && -d <= 7 * $7 && $4 > 0) } END { exit bad > 0 || n != 5 }' ||
    fail "normal $tilt: sensors"
done

# The same on balls of radius 1000 that touch the origin.
for ball in "0 0 -1000" "600 0 -800" "-480 600 -640"; do
  read -r x y z <<<"$ball"
  whole=$(look "$(awk "BEGIN { printf \"%g, %g, %g\", -($x) / 500, -($y) / 500, -($z) / 500 }")" \
    "<shape type=\"sphere\"><point name=\"center\" x=\"$x\" y=\"$y\" z=\"$z\"/><float name=\"radius\" value=\"1000\"/></shape>")
  [ "$whole" = 768 ] || fail "ball $ball: $whole of 768 values are not occluded"
done
exit $((failures > 0))

#!/usr/bin/env bash
# Surfaces in one plane: the first in the file wins, in irradiance, render and view factors, and a counted warning says so.
. "$2/tests/lighting/checks.sh.inc"

# --- irradiance: a small dark floor in the plane of a large bright one. Where it comes first it is what is seen: the same as
# a bright floor with a hole of its shape, four polygons about it. Where it comes second it is not there.
materials='void plastic dark 0 0 5 .1 .1 .1 0 0
void plastic bright 0 0 5 .9 .9 .9 0 0
void light glow 0 0 3 1 1 1
glow source sky 0 0 4 0 0 1 180'
dark='dark polygon small 0 0 12 -5 -5 Z 5 -5 Z 5 5 Z -5 5 Z'
over='dark polygon small 0 0 12 -5 -5 Z -5 5 Z 5 5 Z 5 -5 Z'
bright='bright polygon large 0 0 12 -7 -6 Z 8 -6 Z 8 9 Z -7 9 Z'
around='bright polygon south 0 0 12 -7 -6 Z 8 -6 Z 8 -5 Z -7 -5 Z
bright polygon north 0 0 12 -7 5 Z 8 5 Z 8 9 Z -7 9 Z
bright polygon west 0 0 12 -7 -5 Z -5 -5 Z -5 5 Z -7 5 Z
bright polygon east 0 0 12 5 -5 Z 8 -5 Z 8 5 Z 5 5 Z'
# scene NAME LINES...: moved to UTM where $moved is set. The sensors are 1 above the floor and look down.
scene() {
  local name=$1
  shift
  { echo "$materials"; printf '%s\n' "$@"; } | sed 's/Z/0/g' |
    awk -v x="${moved:+500000.25}" -v y="${moved:+5400000.5}" '
      $2 == "polygon" { for (i = 7; i <= NF; ++i) { if (i % 3 == 1) $i += x; if (i % 3 == 2) $i += y } }
      { print }' CONVFMT=%.12g OFMT=%.12g >"$name.rad"
  printf 'x,y,z,nx,ny,nz\n' >"$name.csv"
  for place in '0 0' '-2 3' '6.5 3' '-6 -5.5'; do
    awk -v place="$place" -v x="${moved:+500000.25}" -v y="${moved:+5400000.5}" \
      'BEGIN { split(place, p, " "); printf "%.12g,%.12g,1,0,0,-1\n", p[1] + x, p[2] + y }' >>"$name.csv"
  done
  "$aureole" irradiance "$name.rad" --sensors "$name.csv" -n 16384 --to csv >"$name.out" 2>"$name.said" ||
    fail "$name: $(cat "$name.said")"
}
# Two estimates agree: by five standard errors, for eight numbers a comparison and twelve comparisons once in 17,000 runs.
agree() {
  paste -d, "$1.out" "$2.out" | awk -F, 'NR > 1 { ++n; d = $4 - $13; if (d * d > 25 * ($7 * $7 + $16 * $16) + 1e-12) bad = 1 }
    END { exit bad || n != 4 }' || fail "$1 and $2 disagree: $(paste -d, "$1.out" "$2.out")"
}
warned() {
  grep -q "$2 triangles lie in the plane of others that come first in the file" "$1.said" || fail "$1 has no warning of $2: $(cat "$1.said")"
}
for moved in '' yes; do
  scene hole "$dark" "$around"
  scene large "$bright"
  scene first "$dark" "$bright"
  scene first-over "$over" "$bright"
  scene second "$bright" "$dark"
  scene second-over "$bright" "$over"
  scene twice "$bright" "$bright" "$over" "$dark"
  for name in first first-over; do agree $name hole; warned $name 2; done
  for name in second second-over twice; do agree $name large; done
  warned second 2
  warned twice 6
  [ ! -s hole.said ] && [ ! -s large.said ] || fail "neighbours in one plane are warned of: $(cat hole.said large.said)"
done
grep -q 'second.rad:6.*second.rad:5' second.said || fail "the first pair is not named by its lines: $(cat second.said)"

# --- a lamp in the plane of a ceiling: the first of both is there
lamp='glow polygon lamp 0 0 12 -1 -1 4 -1 1 4 1 1 4 1 -1 4'
ceiling='bright polygon ceiling 0 0 12 -7 -6 4 -7 9 4 8 9 4 8 -6 4'
lit() {
  { printf 'void light glow 0 0 3 1 1 1\nvoid plastic bright 0 0 5 .9 .9 .9 0 0\n'; printf '%s\n' "$@"; } >lamp.rad
  printf 'x,y,z,nx,ny,nz\n0,0,0,0,0,1\n' >lamp.csv
  "$aureole" irradiance lamp.rad --sensors lamp.csv -n 1024 --to csv 2>/dev/null | awk -F, 'NR == 2 { print ($4 > 0) }' # nothing where there is no light
}
[ "$(lit "$lamp" "$ceiling")" = 1 ] || fail "a lamp before a ceiling gives no light"
[ -z "$(lit "$ceiling" "$lamp")" ] || fail "a lamp behind a ceiling gives light"

# --- render: squares in one plane, the same shape twice, one in a group whose instances are cut as it is
square() {
  echo "<shape type='rectangle' id='$1'><transform name='to_world'><scale value='$3'/><rotate x='1' angle='20'/></transform><bsdf type='twosided'>
    <bsdf type='diffuse'><rgb name='reflectance' value='$2,$2,$2'/></bsdf></bsdf></shape>"
}
picture() {
  local name=$1
  shift
  {
    echo "<scene version='3.0.0'><integrator type='path'/><sensor type='perspective'>
      <transform name='to_world'><lookat origin='0,0,5' target='0,0,0' up='0,1,0'/></transform>
      <film type='hdrfilm'><integer name='width' value='16'/><integer name='height' value='16'/></film></sensor>
      <emitter type='constant'/>"
    printf '%s\n' "$@" '</scene>'
  } >"$name.xml"
  "$aureole" render "$name.xml" --spp 16 -o "$name.exr" 2>"$name.said" || fail "$name: $(cat "$name.said")"
}
mean() {
  "$aureole" info "$1.exr" 2>/dev/null | awk '$1 == "EXR" { print $6; exit }'
}
# Under a sky of 1 a square of reflectance .2 that fills the image is .2 everywhere.
picture one "$(square a .2 20)"
picture two "$(square a .2 20)" "$(square b .8 20)"
picture back "$(square b .8 20)" "$(square a .2 20)"
picture group "<shape type='shapegroup' id='g'>$(square a .2 20)$(square b .8 20)</shape>" \
  "<shape type='instance'><ref id='g'/><transform name='to_world'><translate z='-.5'/></transform></shape>"
# Copies come after shapes and after copies before them; the second of two copies of one group is cut alone: it is seen where it
# is moved to, beside the first.
grouped="<shape type='shapegroup' id='dark'>$(square a .2 20)</shape><shape type='shapegroup' id='light'>$(square b .8 20)</shape>"
copy() {
  echo "<shape type='instance'><ref id='$1'/><transform name='to_world'><scale value='${2:-1}'/></transform></shape>"
}
picture shape-copy "$grouped" "$(copy light)" "$(square c .2 20)"
picture copies "$grouped" "$(copy dark)" "$(copy light)"
picture mirrored "$grouped" "$(copy dark)" "$(copy light -1)"
picture copies-back "$grouped" "$(copy light)" "$(copy dark)"
picture small-first "$grouped" "$(copy dark .01)" "$(copy light .5)"
picture again "$grouped" "$(copy light)" "$(copy dark)" "$(copy dark)" "$(copy dark .5)"
for name in shape-copy copies mirrored copies-back; do warned $name 2; done
warned again 6
for name in copies-back small-first again; do
  awk -v m="$(mean $name)" 'BEGIN { exit !(m > .75 && m < .82) }' || fail "$name: the mean is $(mean $name), not about .8"
done
for name in one two group shape-copy copies mirrored; do
  awk -v m="$(mean $name)" 'BEGIN { exit !(m > .19 && m < .21) }' || fail "$name: the mean is $(mean $name), not .2"
done
awk -v m="$(mean small-first)" -v b="$(mean copies-back)" 'BEGIN { exit !(m < b - .002) }' || fail "a small dark copy in front is not seen"
awk -v m="$(mean back)" 'BEGIN { exit !(m > .78 && m < .82) }' || fail "back: the mean is $(mean back), not .8"
grep -q "two.xml:.* 2 triangles lie .* shape 'b', behind triangle 0 of 'a'" two.said || fail "no names: $(cat two.said)"
warned group 2
# Triangles are counted within their shapes: of these only the third of b and the second of a lie in one plane.
cat >a.obj <<'OBJ'
v 0 0 3
v 1 0 3
v 0 1 3
v 0 0 0
v 1 0 0
v 0 1 0
f 1 2 3
f 4 5 6
OBJ
cat >b.obj <<'OBJ'
v 0 0 5
v 1 0 5
v 0 1 5
v 0 0 7
v 1 0 7
v 0 1 7
v .1 .1 0
v 1 .1 0
v .1 1 0
f 1 2 3
f 4 5 6
f 7 8 9
OBJ
picture counted "<shape type='obj' id='a'><string name='filename' value='a.obj'/></shape>" "<shape type='obj' id='b'><string name='filename' value='b.obj'/></shape>"
grep -q "1 triangles lie .* the first is triangle 2 of shape 'b', behind triangle 1 of 'a' at " counted.said || fail "the first triangles: $(cat counted.said)"

# --- view factors: areas count what is covered once, with the first
cat >floors.obj <<'OBJ'
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v .5 0 0
v 2 0 0
v 2 1 0
v .5 1 0
v 0 0 1
v 0 1 1
v 2 1 1
v 2 0 1
g first
f 1 2 3 4
g second
f 5 6 7 8
g lid
f 9 10 11 12
OBJ
"$aureole" viewfactors floors.obj --group --radiosity .5 >floors.csv 2>floors.said || fail "floors: $(cat floors.said)"
awk -F, 'NR > 1 { area[NR] = $2 } END { exit !((area[2] - 1) ^ 2 < 1e-18 && (area[3] - 1) ^ 2 < 1e-18 && (area[4] - 2) ^ 2 < 1e-18) }' floors.csv ||
  fail "areas of floors: $(cat floors.csv)"
grep -q "floors.obj:16: 2 facets lie in the plane of others .* of 'second', behind facet . of 'first'" floors.said || fail "floors: $(cat floors.said)"
# Both floors together are the lid's size: Howell C-11 for 2 by 1 at distance 1.
"$aureole" viewfactors floors.obj --group --to csv -q | awk -F, '$1 == 2 && $2 >= 0 { sum += $3 } END { exit !((sum - .285875) ^ 2 < 1e-10) }' ||
  fail "the lid's factor: $("$aureole" viewfactors floors.obj --group --to csv -q)"
"$aureole" viewfactors floors.obj --to vs3 -q | grep -c '^S ' | grep -qx '[6-9]' || fail "vs3 of parts"

finish

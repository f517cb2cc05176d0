#!/usr/bin/env bash
# Sensors by --grid: where they stand, against counts by hand; maps; and the daylight factor as one command.
. "$2/tests/lighting/checks.sh.inc"
# An L of 4 x 4 less 2 x 2, as two surfaces whose common edge no margin keeps away from; a wall; all outside-in.
cat >room.rad <<'END'
void plastic grey 0 0 5 .5 .5 .5 0 0
grey polygon floor.1 0 0 12  0 0 0  0 2 0  4 2 0  4 0 0
grey polygon floor.2 0 0 12  0 2 0  0 4 0  2 4 0  2 2 0
grey polygon "a wall" 0 0 12  0 0 0  4 0 0  4 0 3  0 0 3
grey sphere ball 0 0 4  1 1 1 .1
END
# places FILE NAME...: x y z of the sensors, sorted.
places() { sed 1d "$1" | awk -F, '{ printf "%.6g %.6g %.6g\n", $1, $2, $3 }' | sort; }
run() { "$aureole" irradiance -q room.rad --sky uniform -n 16 "$@" || fail "$*"; }

run --grid 'floor.?:1@.5' --normals -o l.csv
for p in "0 0" "1 0" "2 0" "3 0" "0 1" "1 1" "2 1" "3 1" "0 2" "1 2" "0 3" "1 3"; do
  set -- $p
  echo "$1.5 $2.5 0.5"
done | sort >l.txt
places l.csv | cmp - l.txt || fail "an L of cells"
sed 1d l.csv | cut -d, -f4-6 | sort -u | grep -qx '0,0,1' || fail "sensors over a floor look up"
# A margin of .6 leaves what is .6 from the outline, by the distance to the L.
run --grid 'floor.*:.4' --margin .6 -o margin.csv
awk 'function far(x, y,   d) { d = x < y ? x : y; if (4 - x < d) d = 4 - x; if (4 - y < d) d = 4 - y
    if (x >= 2 && y >= 2) return -1
    e = x > 2 ? 2 - y : y > 2 ? 2 - x : sqrt((2 - x) ^ 2 + (2 - y) ^ 2); return e < d ? e : d }
  BEGIN { for (i = 0; i < 7; ++i) for (j = 0; j < 7; ++j) { x = .8 + .4 * i; y = .8 + .4 * j
    if (far(x, y) >= .6 - 1e-9) printf "%.6g %.6g %.6g\n", x, y, 0 } }' | sort >margin.txt
places margin.csv | cmp - margin.txt || fail "a margin: $(places margin.csv | wc -l) sensors, not $(wc -l <margin.txt)"
run --grid 'a wall:2@.25' -o wall.csv
printf '1 -0.25 1.5\n3 -0.25 1.5\n' | cmp - <(places wall.csv) || fail "a wall, whose normal is -y"
run --grid '0,0,2,1,.75:1' -o rectangle.csv
printf '0.5 0.5 0.75\n1.5 0.5 0.75\n' | cmp - <(places rectangle.csv) || fail "a level rectangle"
run --grid '5,0,1,0,0,1,0,3,0:1@.5' -o tall.csv
printf '4.5 0.5 1.5\n4.5 1.5 1.5\n4.5 2.5 1.5\n' | cmp - <(places tall.csv) || fail "a rectangle by its edges"
printf 'v 0 0 1\nv 2 0 1\nv 2 2 1\nv 0 2 1\nf 1 2 3 4\n' >desk.obj
run --grid desk.obj:1@.1 -o desk.csv
printf '0.5 0.5 1.1\n0.5 1.5 1.1\n1.5 0.5 1.1\n1.5 1.5 1.1\n' | cmp - <(places desk.csv) || fail "a mesh"
# The same by --sensors.
places desk.csv | sed 's/$/ 0 0 1/' >desk.pts
run --sensors desk.pts -o same.csv
sort same.csv | cmp - <(sort desk.csv) || fail "values of a grid and of a file of the same sensors"
# An id of XML, where +y is up.
printf '<scene version="3.0.0"><shape type="rectangle" id="floor"><transform name="to_world"><rotate x="1" angle="90"/></transform></shape></scene>' >y.xml
"$aureole" irradiance -q y.xml --grid floor:1@.5 --sky cie-overcast --daylight-factor -n 256 -o y.csv || fail "XML"
printf -- '-0.5 0.5 -0.5\n-0.5 0.5 0.5\n0.5 0.5 -0.5\n0.5 0.5 0.5\n' | sort | cmp - <(places y.csv) || fail "a floor of XML"
sed 1d y.csv | awk -F, '{ d = $4 - 100; if (d < 0) d = -d; if (d > 4 * $5) exit 1 }' || fail "an open floor has not 100 %: $(cat y.csv)"

for format in png svg pdf tex; do
  run --grid 'floor.*:.25@.1' --daylight-factor --plot df.$format -o df.csv
  [ -s df.$format ] || fail "no df.$format"
done
grep -q 'daylight factor' df.svg || fail "the scale has no label"
[ "$(grep -c '<path' df.svg)" -gt 3 ] && grep -q '\\draw\[thin\]' df.tex || fail "no contours"

refused "did you mean 'floor.1'" irradiance room.rad --sky uniform --grid flour.1:1
refused "has such a name" irradiance room.rad --sky uniform --grid ball:1
refused "expected a surface" irradiance room.rad --sky uniform --grid floor.1
refused "expected a surface" irradiance room.rad --sky uniform --grid floor.1:0
refused "expected a surface" irradiance room.rad --sky uniform --grid floor.1:1@high
refused "--sensors cannot be used with --grid" irradiance room.rad --sky uniform --grid floor.1:1 --sensors desk.pts
refused "--margin needs --grid" irradiance room.rad --sky uniform --sensors desk.pts --margin 1
refused "the margin leaves nothing" irradiance room.rad --sky uniform --grid floor.1:1 --margin 1
refused "a larger spacing expected" irradiance room.rad --sky uniform --grid floor.1:1e-5
refused "have no area" irradiance room.rad --sky uniform --grid 0,0,0,1,1:1
refused "none.obj" irradiance room.rad --sky uniform --grid none.obj:1
finish

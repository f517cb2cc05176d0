#!/usr/bin/env bash
# Measured lamps by option and in XML against intensity times cosine over the squared distance.
. "$2/tests/lighting/checks.sh.inc"
# 1000 cd straight down, 0 at 90 degrees, linear; in the plane of 90 degrees half of it.
printf 'IESNA:LM-63-1995\nTILT=NONE\n1 1000 100 2 2 1 2 0 0 0 1 1 9\n0 90\n0 90\n10 0\n5 0\n' >lamp.ies
printf 'void plastic black 0 0 5 0 0 0 0 0\nblack sphere far 0 0 4 0 0 -900 1\n' >open.rad
printf '0 0 0 0 0 1\n1 0 1 0 0 1\n0 1 1 0 0 1\n1 0 1 0 0 -1\n' >points.pts
near() { # FILE VALUES...
  local file=$1
  shift
  awk -F, -v all="$*" 'BEGIN { n = split(all, v, " ") } NR > 1 { d = $4 - v[NR - 1]; if (d < 0) d = -d
    if (!(d <= 4 * $5 + 2e-6 * v[NR - 1] + 1e-9)) { print $4 ", not " v[NR - 1]; bad = 1 } } END { exit bad || NR != n + 1 }' "$file" || fail "$file"
}
run() { "$aureole" irradiance -q open.rad --illuminance radiance -n 64 "$@" || fail "$*"; }
# At 2 m below, and at 1 m below and beside: half of the intensity at 45 degrees, over 2, times cos 45.
side=$(awk 'BEGIN { print 500 / 2 * sqrt(.5) }') half=$(awk 'BEGIN { print 250 / 2 * sqrt(.5) }')
run --sensors points.pts --lamp lamp.ies@0,0,2 -o down.csv
near down.csv 250 $side $half 0
run --sensors points.pts --lamp lamp.ies@0,0,2,0,0,-3,90 -o turned.csv
near turned.csv 250 $half $side 0
run --sensors points.pts --lamp lamp.ies@0,0,2 --lamp lamp.ies@0,0,2,0,0,-1 -o two.csv
near two.csv 500 $(awk "BEGIN { print 2 * $side, 2 * $half }") 0
printf '<scene version="3.0.0"><emitter type="photometric"><string name="filename" value="lamp.ies"/><transform name="to_world"><translate z="2"/></transform></emitter></scene>' >lamp.xml
"$aureole" irradiance -q open.rad lamp.xml --illuminance radiance -n 64 --sensors points.pts | cmp - down.csv || fail "XML"
sed 's|</emitter>|<float name="scale" value="0.5"/></emitter>|' lamp.xml >dimmed.xml
"$aureole" irradiance -q open.rad dimmed.xml --illuminance radiance -n 64 --sensors points.pts -o dimmed.csv
near dimmed.csv 125 $(awk "BEGIN { print $side / 2, $half / 2 }") 0
# Even light of 1 cd from 2 x 1 m, 1 m above: the mean of h^2 / r^4 times h over the opening; and its flux on a sphere of sensors.
printf 'TILT=NONE\n1 1000 1 2 1 1 2 1 2 0 1 1 9\n0 180\n0\n1 1\n' >panel.ies
printf '0 0 0 0 0 1\n' >one.pts
"$aureole" irradiance -q open.rad --illuminance radiance -n 65536 --sensors one.pts --lamp panel.ies@0,0,1 -o panel.csv
"$aureole" info panel.ies | grep -q '^lamp_lumens  *1000$' || fail "lumens of lamps"
sed 's/^1 1000/1 -1/' panel.ies >absolute.ies
"$aureole" info absolute.ies | grep -q '^lamp_lumens  *absolute' || fail "absolute photometry: $("$aureole" info absolute.ies)"
near panel.csv $(awk 'BEGIN { n = 400; for (i = 0; i < n; ++i) for (j = 0; j < n; ++j) { x = 2 * (i + .5) / n - 1; y = (j + .5) / n - .5
  s += 1 / (1 + x * x + y * y) ^ 1.5 } print s / n / n }')
# The lumens of a file arrive: 4 pi on a sphere about it, .1 %, whatever its opening.
awk 'BEGIN { n = 4000; for (i = 0; i < n; ++i) { z = 1 - (2 * i + 1) / n; a = 2.399963229728653 * i; r = sqrt(1 - z * z)
  printf "%.9g %.9g %.9g %.9g %.9g %.9g\n", 9 * r * cos(a), 9 * r * sin(a), 9 * z, -r * cos(a), -r * sin(a), -z } }' >sphere.pts
for file in panel lamp; do
  run --sensors sphere.pts --lamp $file.ies@0,0,0 -o sphere.csv
  # of `lamp`: the planes' mean is 750 (1 - 2 g / pi), whose integral is 2 pi 750 (1 - 2 / pi)
  awk -F, -v name=$file 'NR > 1 { s += $4 } END { pi = atan2(0, -1); flux = s / (NR - 1) * 4 * pi * 81
    want = name == "panel" ? 4 * pi : 2 * pi * 750 * (1 - 2 / pi); d = flux / want - 1; if (d < 0) d = -d
    if (d > .001) { print name ": " flux " lm, not " want; exit 1 } }' sphere.csv || fail "the flux of $file.ies"
done
# Particles and other estimators see the same light.
"$aureole" irradiance -q open.rad --illuminance radiance -n 64 --sensors points.pts --lamp lamp.ies@0,0,2 --reflected map --particles 1000 -o map.csv &&
  near map.csv 250 $side $half 0

# What a file is: the flux of 1 cd in all directions, of a lamp of 2000 lm by EULUMDAT (1 cd per 1000 lm), and of the first one by its planes.
{ printf 'Maker\n1\n1\n1\n0\n2\n180\nreport\nname\nnumber\nfile\ndate\n1200\n300\n80\n1200\n300\n0\n0\n0\n0\n100\n100\n1\n0\n1\n1\ntype\n2000\nwhite\n80\n20\n'
  printf '0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n180\n1\n1\n'; } >panel.ldt
# described FILE FORMAT SYMMETRY LUMENS LAMP_LUMENS PEAK OPENING LENGTH WIDTH
described() {
  "$aureole" info --format csv $1 >info.csv || fail "info $1"
  awk -F, -v want="$*" 'NR == 2 { split(want, w, " "); gsub(/ /, "_"); d = $7 / w[4] - 1
    exit !($1 == "luminaire" && $2 == w[2] && $3 == "C" && $4 == w[3] && d * d < 1e-12 && $8 == w[5] && $9 == w[6] && $10 == w[7] && $11 + 0 == w[8] && $12 + 0 == w[9]) }' info.csv || fail "$1: $(cat info.csv)"
}
sphere=12.566370614359172
described panel.ies IES_LM-63 rotational $sphere 1000 1 rectangle 2 1
described panel.ldt EULUMDAT rotational $(awk "BEGIN { printf \"%.12g\", 2 * $sphere }") 2000 2 rectangle 1.2 .3
described lamp.ies IES_LM-63 quadrants $(awk 'BEGIN { pi = atan2(0, -1); printf "%.12g", 2 * pi * 750 * (1 - 2 / pi) }') 1000 1000 point 0 0
head -20 panel.ldt >half.ldt
refused "half.ldt:20:" info half.ldt

refused "--lamp: must be a file and its position" irradiance open.rad --sensors one.pts --lamp lamp.ies
refused "--lamp: must be a file and its position" irradiance open.rad --sensors one.pts --lamp lamp.ies@1,2
refused "cannot find 'none.ies'" irradiance open.rad --sensors one.pts --lamp none.ies@1,2,3
refused "points.pts" irradiance open.rad --sensors one.pts --lamp points.pts@1,2,3
refused "it needs the string 'filename'" irradiance open.rad lamp.xml <(printf '<scene version="3.0.0"><emitter type="photometric"/></scene>') --sensors one.pts
# Radiance's spotlight on a small ring, rectangle or ball: radiance times projected area over (distance + focus)^2 within its cone. On the
# rectangle the axis is not its normal, and the edge of the cone is blurred within a degree; a mirror image has its axis mirrored.
printf 'void spotlight s 0 0 7 1e6 1e6 1e6 40 0 0 -2\ns ring r 0 0 8 0 0 3 0 0 -1 0 .001\n' >ring.rad
printf 'void spotlight s 0 0 7 1e6 1e6 1e6 40 .5 .7 -2\ns polygon r 0 0 12 -.001 -.002 3 -.001 .002 3 .001 .002 3 .001 -.002 3\n' >tilted.rad
printf 'void spotlight s 0 0 7 1e6 1e6 1e6 40 .5 .7 -2\ns sphere r 0 0 4 0 0 3 .001\n' >bulb.rad
printf '!xform -mx tilted.rad\n' >mirror.rad
awk 'BEGIN { for (x = -2; x <= 2; x += .5) for (y = -2; y <= 2; y += .5) print x, y, 0, 0, 0, 1 }' >floor.pts
spot() { # FILE AREA FOCUS AXIS: x y z. FLAT: the ring and the rectangle face down
  "$aureole" irradiance -q open.rad $1.rad --sensors floor.pts -n 256 --no-errors -o spot.csv || fail "$1"
  awk -F, -v area=$2 -v f=$3 -v ax=$4 -v ay=$5 -v az=$6 -v flat=$7 'NR > 1 { pi = atan2(0, -1); d = sqrt($1 ^ 2 + $2 ^ 2 + 9)
    c = ($1 * ax + $2 * ay - 3 * az) / d / sqrt(ax ^ 2 + ay ^ 2 + az ^ 2); angle = atan2(sqrt(1 - c * c), c) * 180 / pi
    e = angle < 20 ? 1e6 * area * (flat ? 3 / d : 1) * 3 / d / (d + f) ^ 2 : 0; inside += e > 0
    if (angle > 19 && angle < 21) next
    x = $4 - e; if (x < 0) x = -x; if (x > 1e-3 * e) { print FILENAME, $0, e; bad = 1 } } END { exit bad || inside < 3 }' spot.csv || fail "the spotlight of $1"
}
disk=$(awk 'BEGIN { print atan2(0, -1) * 1e-6 }') focus=$(awk 'BEGIN { print sqrt(4.74) }')
spot ring $disk 2 0 0 -2 1
spot tilted 8e-6 $focus .5 .7 -2 1
spot bulb $disk $focus .5 .7 -2 0
spot mirror 8e-6 $focus -.5 .7 -2 1
printf 'void spotlight s 0 0 7 1 1 1 40 0 0 0\ns ring r 0 0 8 0 0 3 0 0 -1 0 .001\n' >bad.rad
printf 'void spotlight s 0 0 7 1 1 1 40 0 0 1\ns ring r 0 0 8 0 0 3 0 0 -1 0 .001\n' >behind.rad
printf 'void spotlight s 0 0 7 1 1 1 40 0 0 -1\ns cone r 0 0 8 0 0 3 0 0 2 1 0\n' >cone.rad
refused "cone.rad:2: cone: a spotlight on a rectangle, a ring or a sphere expected" irradiance cone.rad --sensors floor.pts
refused "behind.rad:2: the cone of the spotlight is behind its surface" irradiance behind.rad --sensors floor.pts
# Luminaires are in metres: a room of 6 mm and one of 6 km are none.
for size in .001 1000; do
  printf 'void plastic black 0 0 5 0 0 0 0 0\n!genbox black b 6 4 3 | xform -s %s\n' $size >sized.rad
  "$aureole" irradiance sized.rad --sensors one.pts --lamp lamp.ies@0,0,-1 -n 16 2>&1 | grep -q "units wide and luminaires are in metres" || fail "a room of 6 x $size m"
done
refused "bad.rad:1: spotlight: R G B of 0 or more, an angle from" irradiance bad.rad --sensors floor.pts
# Radiance's ies2rad writes the same lamp as a pattern on a light: a rectangle, turned and moved; a disk; a ball.
printf 'IESNA:LM-63-1995\nTILT=NONE\n1 -1 1 4 2 1 2 0.6 0.3 0 1 1 9\n0 30 60 90\n0 90\n895 537 179 0\n895 358 89.5 0\n' >rectangle.ies
printf '2\n0 90 2\n0 0 4\n 0 30 60\n 90\n 5 3 1 0 5 2 .5 0\n' >rectangle.dat
printf "void brightdata d 5 flatcorr 'rectangle.dat' source.cal src_phi4 src_theta 0 1 5.555555555555556\nd light l 0 0 3 1 1 1\nl polygon p 0 0 12 -.15 -.3 2 -.15 .3 2 .15 .3 2 .15 -.3 2\n" >rectangle.rad
printf '!xform -t 0 0 -2 -rx 90 -t 1 2 3 rectangle.rad\n' >there.rad
printf 'IESNA:LM-63-1995\nTILT=NONE\n1 -1 1 3 1 1 2 -0.3 -0.3 0 1 1 9\n0 45 90\n0\n1790 895 0\n' >disk.ies
printf '1\n0 90 3\n10 5 0\n' >disk.dat
area=$(awk 'BEGIN { printf "%.15g", 1 / (atan2(0, -1) * .15 ^ 2) }')
printf "void brightdata d 4 flatcorr disk.dat source.cal src_theta 0 1 $area\nd light l 0 0 3 1 1 1\nl ring p 0 0 8 0 0 2 0 0 -1 0 .15\n" >disk.rad
sed 's/flatcorr/corr/; s/ring.*/sphere p 0 0 4 0 0 2 .15/' disk.rad >ball.rad
sed 's/-0.3 -0.3/0 0/' disk.ies >ball.ies
printf '0 0 0 0 0 1\n1 2 0 0 0 1\n3 1 1 0 0 1\n2 5 2 -1 -1 0\n' >about.pts
same() { # FILE.rad LAMP
  "$aureole" irradiance -q open.rad $1 --sensors about.pts -n 256 -o a.csv && "$aureole" irradiance -q open.rad --lamp $2 --sensors about.pts -n 256 -o b.csv || fail "$1"
  paste -d, a.csv b.csv | awk -F, 'NR > 1 { d = $4 - $13; if (d < 0) d = -d; sum += $4; if (!(d <= 1e-5 * $13)) bad = 1 } END { exit bad || !(sum > 0) }' || fail "$1 is not $2: $(paste a.csv b.csv)"
}
same rectangle.rad rectangle.ies@0,0,2
same there.rad rectangle.ies@1,2,3,0,1,0,0
same disk.rad disk.ies@0,0,2
same ball.rad ball.ies@0,0,2
sed 's/src_phi4/src_other/' rectangle.rad >bad.rad
refused "its modifier must be 'void', not 'd'" irradiance open.rad bad.rad --sensors about.pts
sed 's/polygon.*/sphere p 0 0 4 0 0 0 1/' rectangle.rad >bad.rad
refused "a measured luminaire is read on a polygon" irradiance open.rad bad.rad --sensors about.pts
head -c 20 rectangle.dat >short.dat && sed 's/rectangle.dat/short.dat/' rectangle.rad >bad.rad
refused "'short.dat':4: a table of 2 dimensions expected" irradiance open.rad bad.rad --sensors about.pts
finish

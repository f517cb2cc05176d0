#!/usr/bin/env bash
# Reflected light by a photon map or by radiosity, with their errors taken away, is that of paths: in three rooms, with so few
# particles that what they say by themselves is far off.
. "$2/tests/lighting/checks.sh.inc"
command=irradiance
# agree FILE FILE: every value of two tables (x y z r g b and three standard errors) is within 5 joint standard errors, and the
# mean square of their ratios is below 2.2. Errors of 16 randomisations have a Student's t of 15 degrees each: the mean of
# such squares is 1.15, its standard error .35, as if the 24 sensors were independent and their colours were not.
agree() {
  paste -d, "$1" "$2" | awk -F, 'NR > 1 { for (c = 4; c <= 6; ++c) { s = $(c + 3) ^ 2 + $(c + 12) ^ 2; d = ($c - $(c + 9)) ^ 2
      if (!($c > 0) || d > 25 * s) bad = 1; sum += d / s; ++n } }
    END { if (n < 72 || sum / n > 2.2) bad = 1; if (bad) print "mean square", sum / n; exit bad }' || fail "$1 and $2 differ"
}

# A room of 4 x 4 x 3 with a lamp under the ceiling: plain; with a block, two-sided, and a mirror; with a blackboard of a texture.
plane='<shape type="rectangle"><transform name="to_world">'
white='<bsdf type="diffuse"><rgb name="reflectance" value=".8,.6,.4"/></bsdf></shape>'
walls="$plane<scale value=\"2\"/></transform>$white
$plane<scale value=\"2\"/><rotate x=\"1\" angle=\"180\"/><translate z=\"3\"/></transform>$white
$plane<scale value=\"2\"/><rotate x=\"1\" angle=\"90\"/><translate y=\"2\" z=\"1\"/></transform>$white
$plane<scale value=\"2\"/><rotate x=\"1\" angle=\"-90\"/><translate y=\"-2\" z=\"1\"/></transform>$white
$plane<scale value=\"2\"/><rotate y=\"1\" angle=\"90\"/><translate x=\"-2\" z=\"1\"/></transform>$white"
wall="$plane<scale value=\"2\"/><rotate y=\"1\" angle=\"-90\"/><translate x=\"2\" z=\"1\"/></transform>"
lamp="$plane<scale value=\".3\"/><rotate x=\"1\" angle=\"180\"/><translate z=\"2.9\"/></transform>
<emitter type=\"area\"><rgb name=\"radiance\" value=\"20,20,20\"/></emitter></shape>"
block='<shape type="cube"><transform name="to_world"><scale value=".4"/><translate x="1" y=".5" z=".4"/></transform>
<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value=".5,.5,.5"/></bsdf></bsdf></shape>'
mirror='<bsdf type="conductor"><string name="material" value="none"/></bsdf></shape>'
board='<bsdf type="diffuse"><texture type="checkerboard" name="reflectance"><rgb name="color0" value=".1,.1,.1"/><rgb name="color1"
value=".9,.9,.9"/></texture></bsdf></shape>'
room() { echo "<scene version=\"3.0.0\">$walls$wall$2$lamp$3</scene>" >"$1.xml"; }
room plain "$white" ""
room mirror "$mirror" "$block"
room board "$board" "$block"
for x in -1.9 -.5 .9; do for z in .01 1 2.5 2.8; do echo "$x 1.9 $z 0 -1 .2"; echo "$x $x $z 0 0 1"; done; done >points.pts
for kind in plain mirror board; do
  "$aureole" irradiance -q $kind.xml --sensors points.pts -n 1024 -o $kind.csv || fail "$kind, paths"
  for how in map radiosity; do
    "$aureole" irradiance -q $kind.xml --sensors points.pts -n 1024 --seed 1 --reflected $how --particles 3000 -o $how.csv ||
      fail "$kind, $how"
    agree $kind.csv $how.csv
  done
done
agree plain.csv <("$aureole" irradiance -q plain.xml --sensors points.pts -n 512 --seed 2 --reflected map --particles 10)
for threads in 1 3; do
  "$aureole" irradiance -q board.xml --sensors points.pts -n 64 --reflected map --particles 999 --threads $threads -o $threads.csv
  "$aureole" irradiance -q board.xml --sensors points.pts -n 64 --reflected radiosity --particles 999 --threads $threads >>$threads.csv
done
cmp 1.csv 3.csv || fail "threads"
# As deep as paths: no more than one reflection.
for how in paths map radiosity; do
  "$aureole" irradiance -q plain.xml --sensors points.pts -n 1024 --max-depth 2 --seed ${#how} --reflected $how -o two-$how.csv
done
agree two-paths.csv two-map.csv
agree two-paths.csv two-radiosity.csv

printf '<scene version="3.0.0"><shape type="sphere"/>%s</scene>' "$lamp" >ball.xml
refused "ball.xml:1" ball.xml --sensors points.pts --reflected radiosity
printf '<scene version="3.0.0"><emitter type="constant"/>%s</scene>' "$plane</transform></shape>" >sky.xml
refused "light" sky.xml --sensors points.pts --reflected radiosity
refused "--particles needs --reflected" plain.xml --sensors points.pts --particles 9
refused "'maps'" plain.xml --sensors points.pts --reflected maps
refused "--reflected cannot be used with --weather" plain.xml --sensors points.pts --weather a.epw --reflected map
finish

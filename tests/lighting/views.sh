#!/usr/bin/env bash
# Views of Radiance's files: where a lit rectangle stands in the image, by its directions; luminances in cd/m2 and their maps.
. "$2/tests/lighting/checks.sh.inc"
command=render
# Seen from (1, 2, 3) along +y, 90 degrees across: x from .25 to .75 and z from .5 to .75 at the distance 1.
printf 'void light l 0 0 3 1 2 3\nl polygon p 0 0 12  1.25 3 3.5  1.75 3 3.5  1.75 3 3.75  1.25 3 3.75\n' >lamp.rad
printf '# a view\nVIEW= -vtv -vp 1 2 3 -vd 0 2 0 -vu 0 0 1 -vh 90 -vv 90 -vo 0 -va 0 -vs 0 -vl 0\n' >front.vf
lit() { # NAME: columns and rows of the lit pixels of 16 x 16, the top row first
  tail -c $((16 * 16 * 4)) "$1" | od -A n -t f4 -v -w4 | awk '$1 > .01 { printf "%d,%d:%.4g ", (NR - 1) % 16, 15 - int((NR - 1) / 16), $1 }'
}
"$aureole" render -q lamp.rad front.vf --width 16 --spp 16 --filter box -o front.pfm || fail "a view"
"$aureole" convert front.pfm luminance.pfm --luminance radiance || fail "luminance"
expected=
for row in 3 2; do for column in 10 11 12 13; do expected+="$column,$row:322.2 "; done; done # 179 (.265 + .670 * 2 + .065 * 3)
[ "$(lit luminance.pfm)" = "$expected" ] || fail "lit pixels: $(lit luminance.pfm), not $expected"
for word in rec709:332.9 photopic:1270; do # 179 and 683 times .2126 + .7152 * 2 + .0722 * 3
  "$aureole" convert front.pfm luminance.pfm --luminance ${word%:*} && lit luminance.pfm | grep -q ":${word#*:} " || fail "$word: $(lit luminance.pfm)"
done
# The words of rvu, and a view beside a scene whose camera it is; the shape of the image follows from both angles.
printf 'rvu -vtv -vp 0 0 0 -vd 0 1 0 -vh 90 -vv 53.13010235415598 -x 512\n' >wide.txt
"$aureole" render -q lamp.rad wide.txt --spp 1 -o wide.pfm && [ "$(sed -n 2p wide.pfm | tr -d '\0')" = "768 384" ] || fail "the shape of a view"
"$aureole" convert front.pfm map.svg --luminance radiance --falsecolor 500 && grep -q 'cd/m2' map.svg && grep -q '>500<' map.svg || fail "a map"
"$aureole" convert front.pfm map.png --luminance radiance --falsecolor 0 && [ "$(head -c 4 map.png | tail -c 3)" = PNG ] || fail "a map as PNG"
"$aureole" convert front.pfm lines.svg --luminance radiance --falsecolor 500 --contours && [ "$(wc -c <lines.svg)" -gt "$(wc -c <map.svg)" ] || fail "contours"
# Pages show luminances, and compare measures them: an image of double radiance differs by the luminance itself.
"$aureole" view front.pfm --luminance radiance -o page.html >path.txt && grep -q 'data-unit="cd/m2"' page.html || fail "a page of luminances"
"$aureole" view front.pfm -o plain.html >path.txt && ! grep -q 'data-unit=' plain.html || fail "a page of colours"
sed 's/ 1 2 3$/ 2 4 6/;s/0 0 3 1 2 3/0 0 3 2 4 6/' lamp.rad >bright.rad
"$aureole" render -q bright.rad front.vf --width 16 --spp 16 --filter box -o bright.pfm || fail "a brighter light"
"$aureole" compare front.pfm bright.pfm --luminance radiance --tolerance 1000 -o off.svg --html off.html --format csv >off.csv || fail "compare"
awk -F, -v y=322.235 'NR == 2 { d = $2 / (y * sqrt(8 / 256)) - 1; exit !(d * d < 1e-6) }' off.csv || fail "the RMSE in cd/m2: $(cat off.csv)"
grep -q 'cd/m2' off.svg && grep -q 'data-unit="cd/m2"' off.html || fail "a map of differences"
printf 'VIEW= -vta -vp 0 0 0\n' >bad.vf
refused "bad.vf:1: view: only perspective views" lamp.rad bad.vf
printf 'VIEW= -vtv -vp 0 0\n' >bad.vf
refused "bad.vf:1: view: 3 numbers expected after '-vp'" lamp.rad bad.vf
printf 'VIEW= -vtv -vh 180\n' >bad.vf
refused "bad.vf:2: view: -vh and -vv must be" lamp.rad bad.vf
printf 'VIEW= -vtv -vs .5\n' >bad.vf
refused "bad.vf:1: view: a view that is shifted" lamp.rad bad.vf
printf 'VIEW= -vd 0 0 0\n' >bad.vf
refused "view: -vd and -vu must not be 0" lamp.rad bad.vf
# The same view by options, also in place of the scene's cameras.
"$aureole" render -q -vtv -vp 1 2 3 -vd 0 2 0 lamp.rad wide.txt -vh 90 -vv 90 --width 16 --spp 16 --filter box -o options.pfm && cmp front.pfm options.pfm || fail "a view by options"
"$aureole" render -q lamp.rad --camera "-vp 1 2 3 -vh 90 -vv 90" --width 16 --spp 16 --filter box -o options.pfm -- && cmp front.pfm options.pfm || fail "--camera"
"$aureole" render -q -vf front.vf --width 16 --spp 16 --filter box -o options.pfm lamp.rad && cmp front.pfm options.pfm || fail "-vf"
printf '<scene version="3.0.0"><sensor type="perspective"/><shape type="rectangle"/></scene>' >camera.xml
"$aureole" render -q camera.xml lamp.rad -vp 1 2 3 -vh 90 -vv 90 -vd -0 +.5 0 --width 16 --spp 16 --filter box -o options.pfm && cmp front.pfm options.pfm || fail "a scene with a camera"
refused "view: only perspective views" lamp.rad -vta
refused "view: 3 numbers expected after '-vp'" lamp.rad -vp 1 2
refused "unknown option '-p'" lamp.rad -vp
command=convert
refused "--falsecolor is of --luminance" front.pfm map.png --falsecolor 5
refused "--contours needs --falsecolor" front.pfm map.png --contours
refused "map.what" front.pfm map.what --luminance radiance --falsecolor 5
finish

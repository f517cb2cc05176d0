#!/usr/bin/env bash
# aureole irradiance --modifier: the light of each group of sources adds up to all of it, and is that of the scene without the others.
. "$2/tests/lighting/checks.sh.inc"
command=irradiance
cat >room.rad <<'RAD'
void plastic white 0 0 5 .7 .6 .5 0 0
void light panel 0 0 3 10 8 6
void light bulb 0 0 3 3 9 4
void spotlight spot 0 0 7 90 80 70 60 0 0 -1
void alias other panel
white polygon floor 0 0 12  0 0 0  6 0 0  6 4 0  0 4 0
white polygon ceiling 0 0 12  0 0 3  0 4 3  6 4 3  6 0 3
white polygon north 0 0 12  0 4 0  6 4 0  6 4 3  0 4 3
panel polygon l 0 0 12  2 1 2.9  2 2 2.9  3 2 2.9  3 1 2.9
bulb sphere m 0 0 4  5 3 2 .1
spot ring s 0 0 8  4 1 2.5 0 0 -1 0 .1
other polygon o 0 0 12  5 1 2.9  5 2 2.9  5.5 2 2.9  5.5 1 2.9
RAD
printf '3 2 .8 0 0 1\n1 1 .8 0 0 1\n4 1 .8 0 0 1\n' >desk.pts
names="panel bulb spot other"
"$aureole" irradiance -q room.rad --sensors desk.pts -m panel --modifier bulb -m spot -m other -n 4096 -o each.csv || fail "each"
"$aureole" irradiance -q room.rad --sensors desk.pts -n 4096 -o all.csv || fail "all"
# Sums of four independent estimates: within 5 standard errors of all light, in each channel.
paste -d, each.csv all.csv | awk -F, 'NR == 1 { if ($0 !~ /^x,y,z,panel_r,panel_g,panel_b,panel_r_error,.*other_b_error,x,y,z,r,g,b/) { print; exit 1 } }
  NR > 1 { for (c = 0; c < 3; ++c) { sum = variance = 0; for (m = 0; m < 4; ++m) { sum += $(4 + 6 * m + c); variance += $(7 + 6 * m + c) ^ 2 }
    d = sum - $(31 + c); if (!(d * d < 25 * (variance + $(34 + c) ^ 2) && sum > 0)) { print NR, sum, $(31 + c); bad = 1 } } } END { exit bad }' || fail "the sum of the parts: $(cat each.csv all.csv)"
# The scene in which the others are black, by hand.
sed 's/^void light bulb.*/void light bulb 0 0 3 0 0 0/; s/^void spotlight.*/void spotlight spot 0 0 7 0 0 0 60 0 0 -1/; s/^other poly/dark poly/; s/^void alias.*/void light dark 0 0 3 0 0 0/' room.rad >panel.rad
"$aureole" irradiance -q panel.rad --sensors desk.pts -n 4096 -o panel.csv || fail "the panel"
cmp -s <(cut -d, -f4-6 each.csv | tail -n +2) <(cut -d, -f4-6 panel.csv | tail -n +2) || fail "the panel alone: $(cut -d, -f1-6 each.csv panel.csv)"
# Formats: as rcontrib's lines; lux; JSON.
"$aureole" irradiance -q room.rad --sensors desk.pts -m panel -m bulb -n 4096 --to rtrace -o each.txt
awk 'NF != 6 || !/\t$/ { exit 1 }' each.txt && paste -d, <(tail -n +2 each.csv) <(tr '\t' , <each.txt) | awk -F, '{ for (c = 0; c < 3; ++c) { a = $(28 + c) - $(4 + c); b = $(31 + c) - $(10 + c)
  if (a * a > 1e-12 * $(4 + c) ^ 2 || b * b > 1e-12 * $(10 + c) ^ 2) exit 1 } }' || fail "rcontrib's lines: $(cat each.txt)"
"$aureole" irradiance -q room.rad --sensors desk.pts -m panel -n 4096 --illuminance radiance -o lux.csv
paste -d, lux.csv each.csv | awk -F, 'NR == 1 { if ($4 != "panel_lux" || $5 != "panel_lux_error") exit 1 } NR > 1 { y = 179 * (.265 * $9 + .670 * $10 + .065 * $11); d = $4 / y - 1; if (d * d > 1e-12) exit 1 }' || fail "lux: $(cat lux.csv)"
"$aureole" irradiance -q room.rad --sensors desk.pts -m panel -n 64 --json | python3 -c 'import json, sys; assert len(json.load(sys.stdin)) == 3' || fail "JSON"
# A pattern of the sky is a source, too.
printf '!gensky -ang 40 0 -u -B 100\nskyfunc glow sky_glow 0 0 4 1 1 1 0\nsky_glow source sky 0 0 4 0 0 1 180\n' >sky.rad
printf '0 0 9 0 0 1\n' >roof.pts
"$aureole" irradiance -q room.rad sky.rad --sensors roof.pts -m sky_glow -m panel -n 256 --to rtrace | awk '{ exit !($1 > 99 && $1 < 101 && $4 == 0) }' || fail "the sky as a source"

args="room.rad --sensors desk.pts -n 16"
refused "no light source of the scene's Radiance files has the material 'white'" $args -m white
refused "no light source of the scene's Radiance files has the material 'none'" $args -m panel -m none
refused "--sky cannot be used with --modifier" $args -m panel --sky uniform
refused "writes csv, json or rtrace, not ply" $args -m panel --to ply
refused "names of light sources' materials expected" $args -m ""
finish

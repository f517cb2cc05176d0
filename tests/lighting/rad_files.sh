#!/usr/bin/env bash
# Scenes of Radiance in several files, as oconv reads them: the same bits as from one file, and messages with file and line.
. "$2/tests/lighting/checks.sh.inc"

mkdir parts
printf 'void plastic white 0 0 5 .7 .7 .7 0 0\nvoid light lamp 0 0 3 9 9 9\n' >parts/colours.mat
printf '# the room\nwhite polygon floor 0 0 12  -2 -2 0  2 -2 0  2 2 0  -2 2 0\nwhite bubble round 0 0 4  0 0 0 5\n' >parts/room.rad
printf 'lamp ring light\n0\n0\n8 0 0 3  0 0 -1  0 .5\n' >lamp.rad
printf '0 0 1 0 0 1\n1 1 0 0 0 1\n' >points.pts
cat parts/colours.mat parts/room.rad lamp.rad >whole.rad
"$aureole" irradiance -q whole.rad --sensors points.pts -n 256 -o whole.csv || fail "one file"

"$aureole" irradiance -q parts/colours.mat parts/room.rad lamp.rad --sensors points.pts -n 256 | cmp - whole.csv || fail "materials first"
# Kinds are told by content: names say nothing, and XML stands anywhere among them.
cp parts/colours.mat colours.txt && cp lamp.rad lamp
printf '<scene version="3.0.0"/>' >nothing.xml
for files in "colours.txt parts/room.rad lamp" "nothing.xml colours.txt nothing.xml parts/room.rad lamp" \
  "parts/colours.mat nothing.xml parts/room.rad lamp.rad"; do
  "$aureole" irradiance -q $files --sensors points.pts -n 256 | cmp - whole.csv || fail "$files"
done
printf 'void plastic "white paint" 0 0 5 .7 .7 .7 0 0\nvoid light %slamp%s 0 0 3 9 9 9\n' "'" "'" >quoted.mat
sed 's/^white /"white paint" /' parts/room.rad >quoted.rad
"$aureole" irradiance -q quoted.mat quoted.rad lamp.rad --sensors points.pts -n 256 | cmp - whole.csv || fail "quoted names"
# What xform moves is what stands there.
printf 'white polygon floor 0 0 12  -2 -2 0  2 -2 0  2 2 0  -2 2 0\nwhite bubble round 0 0 4  0 0 0 2.5\n' >small.rad
printf 'lamp ring light 0 0 8 -2 3 1  0 1 0  0 .5\n' >side.rad
printf '!xform -s .5 small.rad | xform -i 1 -s 2\n!xform -t 1 2 4 -rx 90 -ry 180 -mz -t -1 7 3 -I side.rad\n' >moved.rad
printf 'lamp ring light 0 0 8 0 6 8  0 0 -1  0 .5\n' >there.rad
printf '!xform -t 2 3 -7 -rx 90 -mz -rx -90 -t -2 -3 7 lamp.rad\n' >mirrored.rad
"$aureole" irradiance -q colours.txt small.rad lamp.rad --sensors points.pts -n 256 >small.csv || fail "a small room"
"$aureole" irradiance -q colours.txt lamp.rad moved.rad --sensors points.pts -n 256 >/dev/null || fail "moved"
printf 'white polygon a 0 0 9  0 0 0  1 0 0  0 1 0\n' >one.rad
printf '!xform -a 2 -t 0 0 2 -a 3 -t 4 0 0 -i 1 -t 1 1 1 one.rad\n' >array.rad
for z in 1 3; do for x in 1 5 9; do
  printf 'white polygon a 0 0 9  %s 1 %s  %s 1 %s  %s 2 %s\n' $x $z $((x + 1)) $z $x $z
done; done >spread.rad
printf 'void light red 0 0 3 1 0 0\n!xform -m red one.rad\n' >red.rad
printf 'white instance i 5 one.rad -t 0 0 1 0 0\n' >instance.rad
printf 'white polygon a 0 0 9  0 0 1  1 0 1  0 1 1\n' >lifted.rad
printf 'void light red 0 0 3 1 0 0\nred polygon a 0 0 9  0 0 0  1 0 0  0 1 0\n' >light.rad
printf '!xform -rz 90 -mx one.rad | xform -rz -90\n' >mirror.rad # (x, y) -> (x, -y), turned over twice
printf 'white polygon a 0 0 9  0 -1 0  1 0 0  0 0 0\n' >below.rad
for pair in "array spread" "red light" "instance lifted" "mirror below"; do
  set -- $pair
  for file in $1 $2; do
    "$aureole" irradiance -q colours.txt there.rad $file.rad --sensors points.pts -n 256 >$file.csv || fail "$file.rad"
  done
  cmp $1.csv $2.csv || fail "$pair"
done
"$aureole" viewfactors -q parts/colours.mat array.rad -o array.csv 2>/dev/null && "$aureole" viewfactors -q parts/colours.mat spread.rad -o spread.csv 2>/dev/null &&
  cmp array.csv spread.csv || fail "arrays of facets"
cp parts/colours.mat colours.rad
"$aureole" irradiance -q colours.rad parts/room.rad lamp.rad --sensors points.pts -n 256 | cmp - whole.csv || fail "three files"
printf '!cat parts/colours.mat   # materials\n!xform -n room parts/room.rad\n!xform lamp.rad\n' >all.rad
"$aureole" irradiance -q all.rad --sensors points.pts -n 256 | cmp - whole.csv || fail "included files"
printf '!cat colours.mat room.rad' >parts/first.rad
"$aureole" irradiance -q parts/first.rad lamp.rad --sensors points.pts -n 256 | cmp - whole.csv || fail "nested files"
"$aureole" viewfactors -q colours.rad parts/room.rad -o a.csv 2>/dev/null && fail "spheres are no facets"
printf 'white polygon a 0 0 9 0 0 1 0 1 1 1 0 1\n' >a.rad
printf 'white polygon b 0 0 9 0 0 0 1 0 0 0 1 0\n' >b.rad
cat colours.rad a.rad b.rad >ab.rad
"$aureole" viewfactors -q ab.rad -o ab.csv && "$aureole" viewfactors -q colours.rad a.rad b.rad -o three.csv &&
  cmp ab.csv three.csv || fail "facets of several files"
# An XML scene goes on in a file of Radiance's.
printf '<scene version="3.0.0"><emitter type="constant"/></scene>' >sky.xml
"$aureole" irradiance -q sky.xml whole.rad --sensors points.pts -n 16 >sky.csv || fail "XML and .rad"
# Materials of Radiance have no ids that a scene could have, too.
printf '<scene version="3.0.0"><emitter type="constant"/><bsdf type="diffuse" id="m0"/></scene>' >sky.xml
"$aureole" irradiance -q sky.xml whole.rad --sensors points.pts -n 16 | cmp - sky.csv || fail "an id of XML changes .rad"

printf 'white polygon p 0 0 10 0 0 0 1 0 0 2 0 0 1\n' >bad.rad
refused "bad.rad:1: " irradiance colours.rad lamp.rad bad.rad --sensors points.pts
printf '\n\n!cat bad.rad\n' >outer.rad
refused "bad.rad:1: " irradiance colours.rad outer.rad --sensors points.pts
refused "unknown material 'white'" irradiance parts/room.rad colours.rad --sensors points.pts
printf '!cat loop.rad\n' >loop.rad
refused "nested deeper than" irradiance loop.rad --sensors points.pts
refused "none.rad" irradiance colours.rad none.rad --sensors points.pts
finish

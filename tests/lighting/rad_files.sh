#!/usr/bin/env bash
# Scenes of Radiance in several files, as oconv reads them: the same bits as from one file, and messages with file and line.
set -u
aureole=$1
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}
# refused TEXT VERB ARGUMENTS...: status 2, and the text is said.
refused() {
  local text=$1 said
  shift
  said=$("$aureole" "$@" 2>&1 >/dev/null)
  [ $? = 2 ] || fail "$*: status is not 2: $said"
  grep -qF -- "$text" <<<"$said" || fail "$*: '$text' is not in: $said"
}

mkdir parts
printf 'void plastic white 0 0 5 .7 .7 .7 0 0\nvoid light lamp 0 0 3 9 9 9\n' >parts/colours.mat
printf '# the room\nwhite polygon floor 0 0 12  -2 -2 0  2 -2 0  2 2 0  -2 2 0\nwhite bubble round 0 0 4  0 0 0 5\n' >parts/room.rad
printf 'lamp ring light\n0\n0\n8 0 0 3  0 0 -1  0 .5\n' >lamp.rad
printf '0 0 1 0 0 1\n1 1 0 0 0 1\n' >points.pts
cat parts/colours.mat parts/room.rad lamp.rad >whole.rad
"$aureole" irradiance -q whole.rad --sensors points.pts -n 256 -o whole.csv || fail "one file"

"$aureole" irradiance -q parts/colours.mat parts/room.rad lamp.rad --sensors points.pts 2>/dev/null && fail "a .mat is no scene alone"
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
refused "no material 'white' above" irradiance parts/room.rad colours.rad --sensors points.pts
printf '!cat loop.rad\n' >loop.rad
refused "nested deeper than" irradiance loop.rad --sensors points.pts
refused "none.rad" irradiance colours.rad none.rad --sensors points.pts
exit $((failures > 0))

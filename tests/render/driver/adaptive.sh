#!/usr/bin/env bash
# Adaptive gathering: fewer rays than all levels everywhere, less error than the first level alone; constant light stops
# at the first level; and input that cannot serve is refused by name.
. "$(dirname "$0")/common.sh.inc"
scene=$source/scenes/cornell-box/glossy.xml
base=photons=20000,edges=0,pixel=centre,direct=none

# gather NAME KEYS: renders, and sets rays to what it took.
gather() {
  "$aureole" render "$scene" -q --stats --width 40 --height 32 --spp 1 -o "$1.exr" --integrator "finalgather-lab:$base,$2" \
    2>"$1.log" || fail "$1: render"
  rays=$(grep -oE '[0-9]+ rays' "$1.log" | grep -oE '[0-9]+')
}

directions=$(either 128 2048)
gather reference diffuse_samples=$directions,glossy_samples=$directions
gather first diffuse_samples=40,glossy_samples=20
gather all adaptive=true,diffuse_samples=40,glossy_samples=20,threshold=0
all=$rays
for criterion in variance entropy entropy-brightness entropy-histogram; do
  gather some adaptive=true,diffuse_samples=40,glossy_samples=20,criterion=$criterion
  [ "$rays" -lt "$all" ] || fail "$criterion: $rays rays, all levels take $all"
  judge -v first="$(figure rmse reference.exr first.exr)" -v some="$(figure rmse reference.exr some.exr)" \
    -v all="$(figure rmse reference.exr all.exr)" 'BEGIN { exit !(all < some && some < 0.8 * first) }' ||
    fail "$criterion: the errors are not in order"
  grep -q 'gathers ended at level 2' some.log || fail "$criterion: --stats does not count the levels"
done
# Any extensible set has levels; E-SFG by its name is what stands for spherical Fibonacci, and Sobol serves as well as for one size.
gather named "adaptive=true,diffuse_samples=40,glossy_samples=20,component=diffuse,pattern=(esfg:base=40,levels=2,progression=4)"
gather grid adaptive=true,diffuse_samples=40,glossy_samples=20,component=diffuse
[ "$(figure rmse named.exr grid.exr)" = 0 ] || fail "E-SFG by its name is another image"
gather net adaptive=true,diffuse_samples=40,glossy_samples=20,pattern=sobol,scramble=rotate
judge -v first="$(figure rmse reference.exr first.exr)" -v net="$(figure rmse reference.exr net.exr)" 'BEGIN { exit !(net < 0.8 * first) }' ||
  fail "levels of Sobol are not better than the first level"
gather optimal adaptive=true,diffuse_samples=40,glossy_samples=20,weights=osw
judge -v some="$(figure rmse reference.exr some.exr)" -v optimal="$(figure rmse reference.exr optimal.exr)" \
  'BEGIN { exit !(optimal < 1.3 * some && optimal > 0) }' || fail "optimal weights of the levels are worse"
"$aureole" info some.exr --format csv | grep -q directions || fail "the picture has no sampling map"

"$aureole" render "$source/tests/render/driver/furnace.xml" -q --stats --width 16 --height 16 --spp 1 -o furnace.exr --integrator \
  finalgather-lab:direct=gather,incident=emitters,density=same,adaptive=true 2>furnace.log || fail "furnace: render"
grep -q 'ended at level 1' furnace.log || fail "furnace: nothing ended at level 1"
grep -q 'ended at level 2' furnace.log && fail "constant light went on to level 2"

# refuses KEYS WORDS: fails with status 2 and a line that has the words.
refuses() {
  "$aureole" render "$scene" -q --width 16 --height 16 -o refused.exr --integrator "finalgather-lab:adaptive=true,$1" 2>refused.log
  [ $? -eq 2 ] || fail "$1: the status is not 2"
  grep -q "$2" refused.log || fail "$1: '$(cat refused.log)' does not say '$2'"
}
refuses diffuse_samples=100000,levels=7 'use fewer levels'
refuses level_factor=3 "'level_factor' is 2 or 4"
refuses pattern=hammersley "'hammersley' is not extensible"
refuses criterion=colour entropy
refuses weights=oswa "take osw"
refuses weights=osw,levels=5 'weights=ratio'
exit $((failures > 0))

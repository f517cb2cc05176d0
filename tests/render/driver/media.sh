#!/usr/bin/env bash
# Scenes with media by the program: the bundled haze, one image in shards and by an error that is asked for, and what says
# that it leaves media out or takes none.
. "$(dirname "$0")/common.sh.inc"
scene=$source/bench/peers/plugins/medium-grid.xml

"$aureole" render "$source/scenes/haze/haze.xml" --width 24 --spp 2 -o haze.exr 2>messages.txt || fail "haze: $(cat messages.txt)"
grep -q 'NaN' messages.txt && fail "haze: $(cat messages.txt)"
mean haze.exr haze.exr | awk '{ exit !($1 > 0.01 && $1 < 10) }' || fail "haze: mean $(mean haze.exr haze.exr)"

# Grids and colours: the same bits in one piece, in two shards, and on three threads.
render() { "$aureole" render "$scene" -q --integrator volpath --spp 4 "$@" || fail "volpath $*"; }
render -t 1 -o whole.exr
render -t 3 -o threads.exr
cmp whole.exr threads.exr || fail "volpath depends on threads"
for k in 1 2; do render --shard $k/2 -o shard-$k.part; done
"$aureole" merge shard-1.part shard-2.part -o merged.exr 2>messages.txt || fail "merging shards"
"$aureole" compare whole.exr merged.exr --tolerance 0 >compared || fail "shards of volpath are another image: $(cat compared)"

# --error takes volpath where media are, and comes as near as it says: .1 is asked, and 512 samples have half of that.
"$aureole" render "$scene" -q --error 10% -o asked.exr || fail "--error"
render --spp "$(either 4 512)" --seed 9 -o reference.exr
"$aureole" compare asked.exr reference.exr --metric relative-rmse --tolerance "$(either inf 0.14)" >compared || fail "--error renders something else: $(cat compared)"

"$aureole" render "$scene" --spp 1 --integrator path -o path.exr 2>messages.txt || fail "path"
grep -q "integrator 'path' leaves media out" messages.txt || fail "path does not say that it leaves media out"
for integrator in finalgather radiosity; do
  "$aureole" render "$scene" --spp 1 --integrator $integrator -o refused.exr 2>messages.txt
  [ $? = 2 ] && grep -q "$integrator.* takes no media" messages.txt || fail "$integrator: $(cat messages.txt)"
done
printf '0 0.5 3 0 1 0\n' >sensors.pts
"$aureole" irradiance "$scene" --sensors sensors.pts 2>messages.txt >/dev/null
[ $? = 2 ] && grep -q "takes no media" messages.txt || fail "irradiance: $(cat messages.txt)"
exit $((failures > 0))

#!/usr/bin/env bash
# `rays` is the number of rays that Embree traces: of every integrator, whatever it prepares itself with, of images to an error,
# of view factors, resumed and by several threads. Embree's calls are counted by a library that is loaded before it.
set -u
program=$1
source_tree=$2
counter=$(dirname "$program")/tests/ray_counter.so
[ -e "$counter" ] || { echo "skipped: $counter is not built"; exit 77; }
box=$source_tree/scenes/cornell-box/cornell-box.xml
status=0

# JSON on standard output; $1 is the command, whose summary says how many rays there were.
counted() {
  LD_PRELOAD=$counter RAY_COUNTER=counted.txt ASAN_OPTIONS=verify_asan_link_order=0:${ASAN_OPTIONS:-} \
    "$program" "$@" >summary.json 2>log.txt || { echo "failed: $*"; cat log.txt; exit 1; }
  said=$(tr ',' '\n' <summary.json | sed -n 's/.*"rays": *\([0-9.e+]*\).*/\1/p' | head -1)
  awk -v a="$said" -v b="$(cat counted.txt)" 'BEGIN { exit !(a + 0 == b + 0 && b > 0) }' ||
    { echo "$* says $said rays, Embree has $(cat counted.txt)"; status=1; }
}
picture() {
  counted render "$1" --width 24 --no-cache --json -o picture.exr "${@:2}"
}

# All integrators of the table, and keys that add rays of other kinds.
integrators=$("$program" help integrator | sed -n 's/^  \([a-z]\{2,\}\) .*/\1/p')
[ "$(echo "$integrators" | wc -l)" -ge 9 ] || { echo "read few integrators: $integrators"; exit 1; }
for integrator in $integrators \
  path:lamp_rays=0 path:candidates=2 path:hide_emitters=true,lamp_rays=4 \
  finalgather:photons=3000,caustic_photons=200 finalgather:photons=3000,share=near finalgather:photons=3000,bright_samples=2 \
  radiosity:paths=20000,randomizations=2 radiosity:share_neighbours=true radiosity:light_sampling=all; do
  case $integrator in
    finalgather) integrator=finalgather:photons=3000 ;;
    aov) integrator=aov:aovs=d:depth ;;
    radiosity) integrator=radiosity:paths=5000 ;;
  esac
  picture "$box" --spp 4 -t 2 --integrator "$integrator"
done
for scene in haze/haze keller/office keller/teapot-box; do # media, mirrors, other lights
  picture "$source_tree/scenes/$scene.xml" --spp 4
done

# Images to a target, by the automatic choice and by named integrators.
picture "$box" --error 15%
picture "$box" --error 30% --integrator finalgather:photons=3000
picture "$box" --rays 2e5
picture "$box" --rounds 2 -t 1
picture "$box" --rounds 2 --integrator radiosity:paths=5000

cat >plates.obj <<'OBJ'
o floor
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
f 1 2 3 4
o lid
v 0 0 1
v 0 1 1
v 1 1 1
v 1 0 1
f 5 6 7 8
OBJ
counted viewfactors plates.obj --rays 64 --json
counted viewfactors plates.obj --rays 64 --json --both-sides --rays-only
exit $status

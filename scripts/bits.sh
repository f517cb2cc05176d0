#!/usr/bin/env bash
# Checksums of pictures, points, weights and measures, a line each. A change that only moves code leaves every line as it
# was: scripts/bits.sh PROGRAM > before; ...; scripts/bits.sh PROGRAM > after; diff before after
# The sums of pictures are of this machine: Embree's hits differ in the last bits between processors. The others, which
# scripts/bits.sh PROGRAM numbers gives alone, are those of every processor. COUNT is the number of points a set (64).
set -euo pipefail
export AUREOLE_CACHE= # everything is made anew
aureole=$(realpath "${1:-build/release/aureole}")
source=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

sum() { # sum NAME FILE
  printf '%s  %s\n' "$(sha256sum <"$2" | cut -c 1-16)" "$1"
}

picture() { # picture SCENE INTEGRATOR ARGUMENTS...
  local scene=$1 integrator=$2
  shift 2
  "$aureole" render "$source/$scene" -q --width 40 --height 24 --spp 2 --integrator "$integrator" -o p.exr "$@" 2>/dev/null ||
    { echo "refused  $scene $integrator $*"; return; }
  sum "$scene $integrator $*" p.exr
}

if [ "${2:-}" != numbers ]; then
gather=finalgather:photons=20000,diffuse_samples=16,glossy_samples=8
for scene in scenes/cornell-box/cornell-box.xml scenes/cornell-box/glossy.xml tests/render/{furnace,sky,white_bodies,caustic}.xml; do
  for integrator in path path:packets=false path:interleaved=true path:max_depth=2 direct "$gather" "$gather,packets=false"; do
    picture "$scene" "$integrator"
  done
done
box=scenes/cornell-box/glossy.xml
for keys in weights=oswa weights=osw weights=mis weights=oswa-solve weights=equal adaptive=true adaptive=true,criterion=entropy \
            share=true pattern=sobol,rotations=0 decorrelation=random decorrelation=none direct=gather direct=none,component=glossy \
            component=diffuse incident=emitters bright_samples=4 light_samples=4 clip=false max_depth=3; do
  picture "$box" "$gather,$keys"
done
for scene in tests/render/weights.xml tests/render/furnace_faces.xml scenes/occlusion/occlusion.xml; do
  [ "$scene" = scenes/occlusion/occlusion.xml ] && [ ! -e "$source/scenes/generated/temple.ply" ] && continue
  picture "$scene" "$gather"
  picture "$scene" ao
done
picture "$box" ao
picture "$box" ao --sampler sobol
picture "$box" depth
picture "$box" 'aov:aovs=(d:depth,n:sh_normal,p:position)'
picture scenes/keller/cube.xml radiosity
for keys in light_sampling=all share_neighbours=true oversampling=4; do
  picture scenes/keller/teapot-box.xml "radiosity:$keys"
done
for sampler in random sobol halton jittered golden-set faure; do
  picture "$box" path --sampler "$sampler"
done
for scene in bench/peers/plugins/medium{,-glass,-phases,-grid}.xml; do picture $scene volpath; done
picture "$box" path --filter gaussian --crop 3,17,5,20
picture "$box" "$gather" --filter mitchell --seed 7
fi

for set in $("$aureole" sets --format csv | awk -F, 'NR > 1 { print $1 }'); do
  for options in '' '--domain hemisphere' '--domain sphere --scramble rotate3d --seed 3' '--domain square --scramble owen --seed 3' \
                 '--domain square --scramble digit' '--lobe phong:20' '--lobe ggx:0.3:40 --density optimal' '--dim 5 --domain cube'; do
    # shellcheck disable=SC2086
    "$aureole" points "$set" -n "${COUNT:-64}" $options --format npy -o p.npy -q 2>/dev/null || continue
    sum "points $set $options" p.npy
  done
done
for set in sobol spherical-fibonacci random; do
  for metric in $("$aureole" measure --list --format csv | awk -F, 'NR > 1 { print $1 }'); do
    "$aureole" measure "$set" -n 64 -m "$metric" --format csv -q -t 2 >m.csv 2>/dev/null || continue
    sum "measure $set $metric" m.csv
  done
done
for method in osw oswa mis mis-power equal ratio; do
  for set in sobol random spherical-fibonacci; do
    "$aureole" weights "$set" -n 40 --lobe cosine --lobe2 phong:20 --angle 40 --n2 20 --clip --method "$method" -q -o w.csv 2>/dev/null || continue
    sum "weights $set $method" w.csv
  done
done
"$aureole" weights sobol -n 64 --lobe cosine --density optimal -q -o w.csv && sum "weights sobol optimal" w.csv
"$aureole" weights sobol -n 20 --lobe cosine --lobe2 phong:20 --n2 10 --table t.wt --angles 8 --rotations 2 -q && sum "weights table" t.wt

#!/usr/bin/env bash
# Checksums of images, points, weights and measures, a line each. A change that only moves code leaves every line as it
# was: scripts/bits.sh PROGRAM > before; ...; scripts/bits.sh PROGRAM > after; diff before after
# The sums of images are of this machine: Embree's hits differ in the last bits between processors. The others, which
# scripts/bits.sh PROGRAM numbers gives alone, are those of every processor. COUNT is the number of points a set (64).
#   scripts/bits.sh PROGRAM record [numbers]  stores all of them, or numbers alone, in scripts/bits.txt; images by AVX2, with the processor's name
#   scripts/bits.sh PROGRAM check [numbers]   counts how many are as recorded, perhaps by another processor; exit status 1 where numbers are not
set -euo pipefail
export AUREOLE_CACHE= # everything is made anew
aureole=$(realpath "${1:-build/release/aureole}")
source=$(cd "$(dirname "$0")/.." && pwd)
status=0
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

pictures() {
  local gather box scene integrator keys sampler
  gather=finalgather:photons=20000,diffuse_samples=16,glossy_samples=8
  study=finalgather-lab:${gather#*:}
  for scene in scenes/cornell-box/cornell-box.xml scenes/cornell-box/glossy.xml tests/render/driver/{furnace,sky,white_bodies,caustic}.xml; do
    for integrator in path path:packets=false path:interleaved=true path:max_depth=2 direct "$gather" "$study,packets=false"; do
      picture "$scene" "$integrator"
    done
  done
  box=scenes/cornell-box/glossy.xml
  for keys in weights=oswa weights=osw weights=mis weights=oswa-solve weights=equal adaptive=true adaptive=true,criterion=entropy \
              pattern=sobol,rotations=0 decorrelation=random decorrelation=none direct=none,component=glossy \
              component=diffuse incident=emitters clip=false; do
    picture "$box" "$study,$keys"
  done
  for keys in share=true share=near direct=gather bright_samples=4 light_samples=4 max_depth=3; do
    picture "$box" "$gather,$keys"
  done
  for scene in tests/render/driver/weights.xml tests/render/driver/furnace_faces.xml scenes/occlusion/occlusion.xml; do
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
}

numbers() {
  local set options metric method
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
}

record=$source/scripts/bits.txt
case ${2:-} in
  '') pictures; numbers ;;
  numbers) numbers ;;
  record)
    export AUREOLE_ISA=avx2
    COUNT=64
    if [ "${3:-}" = numbers ]; then
      grep -vE '^[0-9a-f]+  (points|measure|weights)' "$record" >recorded
      numbers >>recorded
    else
      { echo "# scripts/bits.sh PROGRAM record: $(getconf GNU_LIBC_VERSION), pictures by AVX2 on: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)"
        pictures; numbers; } >recorded
    fi
    cp recorded "$record" ;;
  check)
    COUNT=64
    { [ "${3:-}" = numbers ] || AUREOLE_ISA=avx2 pictures; numbers; } >found
    for kind in points measure weights '[^pmw]'; do
      [ "$kind" != '[^pmw]' ] || [ "${3:-}" != numbers ] || continue
      grep "^[0-9a-f]*  $kind" "$record" >kept
      same=$(grep -cxFf found kept || true)
      [ "$kind" = '[^pmw]' ] && kind=pictures || [ "$same" = "$(wc -l <kept)" ] || { status=1; grep -vxFf found kept | sed 's/^[0-9a-f]*/not as recorded:/'; }
      echo "$kind: $same of $(wc -l <kept) as recorded"
    done
    [ "$(grep -cE '^[0-9a-f]*  (points|measure|weights)' found)" = "$(grep -cE '^[0-9a-f]*  (points|measure|weights)' "$record")" ] ||
      { echo "other sets or measures than recorded: scripts/bits.sh PROGRAM record numbers"; status=1; } ;;
  *) sed -n '2,8p' "$0" >&2; exit 2 ;;
esac
exit $status

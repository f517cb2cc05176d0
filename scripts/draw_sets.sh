#!/usr/bin/env bash
# Draws every set that the program lists, and writes the page that shows them side by side:
#   scripts/draw_sets.sh [PROGRAM [FOLDER]]        (build/release/aureole, docs)
set -eu
cd "$(dirname "$0")/.."
program=${1:-build/release/aureole}
folder=${2:-docs}
n=128
mkdir -p "$folder/sets"
page=$folder/sets.md

# One field of the program's CSV, whose texts in quotes may hold commas.
fields() { # line -> array `field`
  field=()
  local rest=$1 text
  while [ -n "$rest" ]; do
    if [ "${rest:0:1}" = '"' ]; then
      text=${rest#\"}
      text=${text%%\"*}
      rest=${rest:$((${#text} + 2))}
    else
      text=${rest%%,*}
      rest=${rest:${#text}}
    fi
    rest=${rest#,}
    field+=("$text")
  done
}

draw() { # file, then the arguments of `aureole points`
  local file=$1
  shift
  "$program" points "$@" -q --format svg -o "$folder/sets/$file"
  echo "<img src=\"sets/$file\" height=\"180\">"
}

{
  cat <<'HEAD'
# Point sets

`aureole sets` lists every set; `scripts/draw_sets.sh` draws this page from it, with 128 points each. On the sphere the points are shown from the side and from the pole;
points on the far side are pale. Sets of the square are mapped by Lambert's cylindrical map. Of rotations the vector part of the quaternion is shown.

Not sure which to take? On the sphere `spherical-fibonacci`, for rotations `super-fibonacci`, on the square `sobol` with `--scramble owen`
([by job](choosing.md)).

| set | square | sphere |
|---|---|---|
HEAD
  "$program" sets --format csv | tail -n +2 | while IFS= read -r line; do
    fields "$line"
    set=${field[0]} keys=${field[1]} domains=${field[2]} sizes=${field[3]} extensible=${field[4]}
    source=${field[5]} summary=${field[6]}
    square="" sphere="" n=128
    [ "$set" = healpix ] && n=192 # 12 k^2
    [ "$set" = t-design ] && n=122
    [ "$set" = lebedev ] && n=110
    [ "$set" = icosahedral ] && n=162
    [ "$set" = max-determinant ] && n=121
    case $set in
      matrices | file) square="your own" sphere="your own" ;;
      *)
        case $domains in
          *square*)
            square=$(draw "$set-square.svg" "$set" -n $n)
            sphere=$(draw "$set-sphere.svg" "$set" -n $n --domain sphere)
            ;;
          *sphere*) sphere=$(draw "$set-sphere.svg" "$set" -n $n) ;;
          *rotations*) sphere=$(draw "$set-rotations.svg" "$set" -n $n) ;;
          *) square=$(draw "$set-square.svg" "$set" -n $n) ;;
        esac
        ;;
    esac
    [ -n "$keys" ] && keys="; keys: \`$keys\`"
    [ "$extensible" = yes ] && extensible="extensible" || extensible="not extensible"
    summary=${summary//|/\\|} # a bar would end the cell
    echo "| **\`$set\`** $summary. Sizes $sizes, $extensible$keys. *$source* | $square | $sphere |"
  done
  cat <<'MAPS'

The maps from the square to the sphere, with Hammersley's points:

| lambert | concentric | azimuthal | polar |
|---|---|---|---|
MAPS
  cells=""
  for map in lambert concentric azimuthal polar; do
    cells="$cells| $(draw "map-$map.svg" hammersley -n $n --domain sphere --map $map) "
  done
  echo "$cells|"
  cat <<'LOBES'

Lobes on the hemisphere, with spherical Fibonacci points: the densities themselves, and the optimal density of cos^20, where
the area of a point is its weight.

| cosine | phong:20 | phong:20, optimal density | ggx:0.3:60 |
|---|---|---|---|
LOBES
  echo "| $(draw lobe-cosine.svg spherical-fibonacci -n $n --lobe cosine)" \
    "| $(draw lobe-phong.svg spherical-fibonacci -n $n --lobe phong:20)" \
    "| $(draw lobe-optimal.svg spherical-fibonacci -n $n --lobe phong:20 --density optimal)" \
    "| $(draw lobe-ggx.svg spherical-fibonacci -n $n --lobe ggx:0.3:60) |"
} > "$page.new"
mv "$page.new" "$page"

#!/usr/bin/env bash
# Renders models and scenes of other authors, which are not in this tree, and writes docs/gallery-models.md with the images. FOLDER
# has one folder for each source named below, with the files of its repository (git clone). With names only these are rendered; the
# page keeps what it has of the others.
#
#     scripts/gallery_models.sh FOLDER [NAME...]
set -euo pipefail
folder=$(realpath "$1")
shift
cd "$(dirname "$0")/.."
aureole=$PWD/build/release/aureole out=$PWD/out/gallery-models images=docs/gallery page=docs/gallery-models.md
mkdir -p "$out" "$images"

# source | address
sources() {
  cat <<ROWS
samples|https://github.com/KhronosGroup/glTF-Sample-Models
bevy|https://github.com/bevyengine/bevy
trimesh|https://github.com/mikedh/trimesh
bitterli|https://benedikt-bitterli.me/resources
ROWS
}

model="--width 480 --height 360 --samples 64"
# name | source | file | options | title | credit
gallery() {
  cat <<ROWS
flight-helmet|bevy|assets/models/FlightHelmet/FlightHelmet.gltf|$model|Flight helmet|Microsoft, conversion by Gary Hsu, CC0
avocado|samples|2.0/Avocado/glTF/Avocado.gltf|$model|Avocado|Microsoft, CC0
boombox|samples|2.0/BoomBox/glTF/BoomBox.gltf|$model|Boom box|Microsoft, CC0
bottle|samples|2.0/WaterBottle/glTF/WaterBottle.gltf|$model|Water bottle|Microsoft, CC0
fox|bevy|assets/models/animated/Fox.glb|$model --environment sky --tone filmic|Fox|PixelMannen, CC0; rig: @tomkranis, conversion: @AsoboStudio and @scurest, CC-BY 4.0
morph|bevy|assets/models/animated/MorphStressTest.gltf|$model --at 1.2|Morph targets at 1.2 s|Ed Mackey, Analytical Graphics, CC-BY 4.0
alien|bevy|assets/models/AlienCake/alien.glb|$model --camera 205,12 --background '#203040'|Alien|Kenney, CC0
cake|bevy|assets/models/AlienCake/cakeBirthday.glb|$model --camera 20,25|Cake|Kenney, CC0
speeder|bevy|assets/models/ship/craft_speederD.gltf|$model --camera 35,20 --environment sky:4|Speeder|Kenney, CC0
alpha|trimesh|models/AlphaBlendModeTest.glb|$model --camera 10,10|Alpha modes|Ed Mackey, Analytical Graphics, CC-BY 4.0
box|bitterli|cornell-box/scene.xml|--integrator finalgather --width 400 --height 400 --samples 16 --exposure 1 --tone filmic|Cornell box|Benedikt Bitterli, CC0
veach-mis|bitterli|veach-mis/scene.xml|--integrator path --width 480 --height 270 --samples 128 --tone filmic|Veach, MIS|Benedikt Bitterli, CC0
veach-bidir|bitterli|veach-bidir/scene.xml|--integrator path --clamp 2 --width 320 --height 320 --samples 256 --tone filmic|Veach, bidirectional room|Benedikt Bitterli, CC0
modern-hall|bitterli|staircase2/scene.xml|--integrator finalgather --width 400 --height 400 --samples 16 --exposure 0.5 --tone filmic|Modern hall|NewSee2l035, CC-BY
grey-room|bitterli|living-room/scene.xml|--integrator path --width 480 --height 270 --samples 256 --tone filmic|The grey and white room|Wig42, CC-BY
staircase|bitterli|staircase/scene.xml|--integrator finalgather --width 270 --height 480 --samples 32 --tone filmic|The wooden staircase|Wig42, CC-BY
ROWS
}

# The section of an image: from its render, else that of the page.
section() {
  local name=$1 file=$2 options=$3 title=$4 credit=$5
  if [ ! -s "$out/$name.seconds" ]; then
    awk -v title="## $title" '/^## / { inside = $0 == title } inside' "$page"
    return
  fi
  printf '## %s\n\n![%s](gallery/%s.jpg)\n\n' "$title" "$title" "$name"
  printf '    aureole render %s %s -o %s.png\n\n' "$(basename "$file")" "$options" "$name"
  printf '%s. %s CPU seconds.\n\n' "$credit" "$(cat "$out/$name.seconds")"
}

while IFS='|' read -r name source file options title credit; do
  if [ $# -gt 0 ] && [[ " $* " != *" $name "* ]]; then continue; fi
  words=()
  eval "words=($options)"
  TIMEFORMAT='%U %S'
  { time "$aureole" render "$folder/$source/$file" -q "${words[@]}" -o "$out/$name.png" </dev/null >&2; } 2>"$out/time"
  awk 'END { printf "%.0f", $1 + $2 }' "$out/time" >"$out/$name.seconds"
  "$aureole" convert "$out/$name.png" "$images/$name.jpg"
done < <(gallery)

{
  echo "# Gallery of models and scenes by others"
  echo
  echo "Rendered by \`scripts/gallery_models.sh\`. CPU seconds are those of the whole program on shared processors. Sources:"
  echo
  sources | while IFS='|' read -r source address; do echo "- $source: <$address>"; done
  echo
  while IFS='|' read -r name source file options title credit; do
    section "$name" "$file" "$options" "$title" "$credit ($source)"
  done < <(gallery)
} >"$out/page.md"
cat -s "$out/page.md" | sed '$ { /^$/ d }' >"$page"

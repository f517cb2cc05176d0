#!/usr/bin/env bash
# Renders the bundled scenes by --error and writes docs/gallery.md with the images, from what the run itself reports. With names as
# arguments only these images are rendered; the page keeps its other sections, and the one that bench/peers/equal_time.py writes.
#
#     scripts/gallery.sh [NAME...]
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/scenes.sh >/dev/null
[ -x build/release/aureole ] || cmake --build --preset release -j "$(nproc)" --target aureole-program
aureole=build/release/aureole
out=out/gallery images=docs/gallery page=docs/gallery.md
mkdir -p "$out" "$images"

radiosity="--integrator radiosity:epsilon=1e-4,sequence=halton,walk=paper"
# name | scene | options | exposure | tone | title
gallery() {
  cat <<ROWS
room|room/room.xml|--width 960 --error 10% --error-measure mean|0.9|filmic|Tea and fruit by a window
statue|statue/statue.xml|--width 960 --error 7% --error-measure mean|0.5|filmic|A gilded figure under the sky
parade|parade/parade.xml|--width 960 --error 9% --error-measure mean|1.3|filmic|A parade of toy cars
figure|cornell-box/figure.xml|--width 960 --error 3% --error-measure mean|1.6|filmic|A carved hare in the Cornell box
sphere|sphere/sphere.xml|--width 960 --error 8% --error-measure mean|0.5|filmic|A glossy sphere among seeds
occlusion|occlusion/occlusion.xml|--width 960 --error 2% --error-measure mean|0|srgb|Ambient occlusion among columns
atrium|atrium/atrium.xml|--integrator finalgather --width 480 --samples 96|3.5|filmic|A court below sun and sky
shop|shop/shop.xml|--integrator finalgather --width 540 --samples 96|0.8|filmic|A shop window and its 130 bulbs
shafts|shafts/shafts.xml|--width 330 --samples 1024|1|filmic|Shafts of sun in a dusty shed
caustics|caustics/caustics.xml|--integrator ptracer --width 540 --samples 1024|0|filmic|Caustics of glass and gold, by light tracing
plates|plates/plates.xml|--width 960 --error 6% --error-measure mean|1|filmic|Four plates and seven lights
cornell-box|cornell-box/cornell-box.xml|--width 960 --error 1% --error-measure mean|0.5|srgb|The measured Cornell box
glossy|cornell-box/glossy.xml|--width 960 --error 3% --error-measure mean|1|srgb|A teapot in a glossy Cornell box
living-room|keller/living-room.xml|$radiosity --width 960 --error 7% --error-measure mean|0.5|srgb|Keller's living room, by radiosity
office|keller/office.xml|$radiosity --width 960 --error 5% --error-measure mean|0.5|srgb|Keller's office
teapot|keller/teapot-box.xml|$radiosity --width 960 --error 7% --error-measure mean|0.5|srgb|Keller's teapot
ROWS
}

# CPU seconds of a command, user and system time of all its threads; its messages go to $said.
cpu_seconds() {
  local TIMEFORMAT='%U %S'
  { time "$@" </dev/null >/dev/null 2>"$said"; } 2>&1 | awk '{ printf "%.0f", $1 + $2 }'
}

# Of the old page the section with a title, if it has one.
old_section() {
  awk -v title="## $1" '/^## / { inside = $0 == title } inside' "$page"
}

# The section of an image, from what its render reported.
new_section() {
  local name=$1 scene=$2 options=$3 exposure=$4 tone=$5 title=$6 triangles size error
  triangles=$("$aureole" info "scenes/$scene" -q | awk '$1 == "triangles" { print $2 }')
  size=$("$aureole" info "$out/$name.exr" | awk '$1 == "EXR" { print $2 " x " $3; exit }')
  error=$(sed -n -e 's/.* has an error of \(.*\) % of the image mean (mean), between \(.*\) and \(.*\) (95 %).*/\1 % (\2 to \3)/p' \
    -e 's/.* has an error of at most about \(.*\) % of its mean.*/at most \1 %/p' "$said")
  printf '## %s\n\n[![%s](gallery/%s.jpg)](gallery/%s.jpg)\n\n' "$title" "$title" "$name" "$name"
  printf '    aureole render scenes/%s %s -o %s.exr\n' "$scene" "$options" "$name"
  printf '    aureole convert %s.exr %s.jpg --exposure %s --tone %s\n\n' "$name" "$name" "$exposure" "$tone"
  printf '%s triangles, %s pixels, %s%s CPU seconds.\n\n' "$triangles" "$size" "${error:+error $error, }" "$(cat "$out/$name.seconds")"
}

while IFS='|' read -r name scene options exposure tone title; do
  if [ $# -gt 0 ] && [[ " $* " != *" $name "* ]]; then continue; fi
  echo "$name: $scene $options"
  said=$out/$name.said
  read -ra words <<<"$options"
  cpu_seconds "$aureole" render "scenes/$scene" "${words[@]}" -o "$out/$name.exr" >"$out/$name.seconds"
  "$aureole" convert "$out/$name.exr" "$images/$name.jpg" --exposure "$exposure" --tone "$tone"
done < <(gallery)

{
  echo "# Gallery"
  echo
  echo "The bundled scenes ([how to build them](scenes.md)), rendered by \`scripts/gallery.sh\`, which writes this page. The error is the root mean"
  echo "square error relative to the mean of the image, with its 95 % interval, as the program reports it. CPU seconds are those of the whole"
  echo "program on shared processors ($(awk -F': ' '/^model name/ { print $2; exit }' /proc/cpuinfo)). Images link to their full size."
  echo "Models and scenes by others have [their own page](gallery-models.md)."
  echo
  old_section "At equal time"
  while IFS='|' read -r name scene options exposure tone title; do
    said=$out/$name.said
    if [ -s "$out/$name.seconds" ]; then
      new_section "$name" "$scene" "$options" "$exposure" "$tone" "$title"
    else
      old_section "$title"
      echo
    fi
  done < <(gallery)
} | cat -s >"$page.new"
mv "$page.new" "$page"

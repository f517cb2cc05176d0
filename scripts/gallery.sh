#!/usr/bin/env bash
# Renders the bundled scenes at a good size and writes docs/gallery.md with small copies of the pictures, from what the run
# itself measured. Full size pictures go to out/gallery. Names of pictures as arguments render these only, again.
#
#     scripts/gallery.sh [NAME...]
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/scenes.sh >/dev/null
[ -x build/release/aureole ] || cmake --build --preset release -j "$(nproc)" --target aureole-program
aureole=build/release/aureole
out=out/gallery small=docs/gallery
mkdir -p "$out" "$small"

# name | scene | integrator | samples a pixel | exposure | tone | small copy: downsampled by | title
gallery() {
  cat <<'ROWS'
room|room/room.xml|finalgather:diffuse_samples=128,glossy_samples=128|64|0.9|filmic|1|Tea and fruit by a window
statue|statue/statue.xml|finalgather:diffuse_samples=128,glossy_samples=128|64|0.5|filmic|2|A gilded figure under the sky
parade|parade/parade.xml|finalgather:diffuse_samples=128,glossy_samples=128,photons=1500000|64|1.3|filmic|2|A parade of toy cars
figure|cornell-box/figure.xml|finalgather:diffuse_samples=128,glossy_samples=128|64|1.6|filmic|2|A carved hare in the Cornell box
sphere|sphere/sphere.xml|finalgather:diffuse_samples=128,glossy_samples=128|64|0.5|filmic|2|A glossy sphere among seeds
occlusion|occlusion/occlusion.xml|ao:samples=128|16|0|srgb|2|Ambient occlusion among columns
plates|plates/plates.xml|finalgather:diffuse_samples=64,glossy_samples=64|128|1|filmic|2|Four plates and seven lights
cornell-box|cornell-box/cornell-box.xml|path|48|0.5|srgb|2|The measured Cornell box
glossy|cornell-box/glossy.xml|finalgather:diffuse_samples=128,glossy_samples=128|64|1|srgb|2|A teapot in a glossy Cornell box
living-room|keller/living-room.xml|radiosity:epsilon=1e-4,sequence=halton,directions=uniform_angle,emission=area,gather_samples=8,share_neighbours=true|4|0.5|srgb|2|Keller's living room, by radiosity
office|keller/office.xml|radiosity:epsilon=1e-4,sequence=halton,directions=uniform_angle,emission=area,gather_samples=8,share_neighbours=true|4|0.5|srgb|2|Keller's office
teapot|keller/teapot-box.xml|radiosity:epsilon=1e-4,sequence=halton,directions=uniform_angle,emission=area,gather_samples=8,share_neighbours=true|4|0.5|srgb|2|Keller's teapot
ROWS
}

# CPU seconds of a command: user and system time of all its threads.
cpu_seconds() {
  local TIMEFORMAT='%U %S'
  { time "$@" </dev/null >/dev/null 2>&3; } 3>&2 2>&1 | awk '{ printf "%.0f", $1 + $2 }'
}

while IFS='|' read -r name scene integrator spp exposure tone shrink title; do
  if [ $# -gt 0 ] && [[ " $* " != *" $name "* ]]; then continue; fi
  echo "$name: $scene, $integrator, $spp samples"
  seconds=$(cpu_seconds "$aureole" render "scenes/$scene" -q --integrator "$integrator" --spp "$spp" -o "$out/$name.exr")
  "$aureole" convert "$out/$name.exr" "$out/$name.png" --exposure "$exposure" --tone "$tone"
  "$aureole" convert "$out/$name.exr" "$small/$name.png" --exposure "$exposure" --tone "$tone" --downsample "$shrink"
  echo "$seconds" >"$out/$name.seconds"
done < <(gallery)

{
  echo "# Gallery"
  echo
  echo "The bundled scenes ([how they are made](scenes.md)), rendered by \`scripts/gallery.sh\`, which writes this page. CPU seconds"
  echo "are those of the whole program on all threads, loading the scene and its photon map included, on"
  echo "$(awk -F': ' '/^model name/ { print $2; exit }' /proc/cpuinfo) while other work ran:"
  echo "$(cat "$out"/*.seconds | awk '{ sum += $1 } END { print sum }') in all. The first picture is of full size, the others are halved copies."
  while IFS='|' read -r name scene integrator spp exposure tone shrink title; do
    [ -f "$out/$name.seconds" ] || continue
    triangles=$("$aureole" info "scenes/$scene" -q | awk '$1 == "triangles" { print $2 }')
    size=$("$aureole" info "$out/$name.exr" | awk '$1 == "EXR" { print $2 " x " $3; exit }')
    printf '\n## %s\n\n![%s](gallery/%s.png)\n\n' "$title" "$title" "$name"
    printf '| scene | triangles | integrator | samples a pixel | size | CPU seconds |\n|---|---|---|---|---|---|\n'
    printf '| `scenes/%s` | %s | `%s` | %s | %s | %s |\n' "$scene" "$triangles" "$integrator" "$spp" "$size" "$(cat "$out/$name.seconds")"
  done < <(gallery)
} >docs/gallery.md.new
mv docs/gallery.md.new docs/gallery.md

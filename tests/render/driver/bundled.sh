#!/usr/bin/env bash
# The bundled scenes with both kinds of materials, each by an integrator: no sample is NaN, infinite or negative, and the image
# is not black. Scenes whose meshes are made at first use are rendered where they have been made (scripts/scenes.sh), and
# plates always, from a mesh made here.
. "$(dirname "$0")/common.sh.inc"
scenes=$(dirname "$1")/aureole-scenes

rm -rf made && mkdir -p made
cp -r "$source/scenes/plates" made/
"$scenes" --folder made/generated plate.ply >/dev/null || fail "making a plate"

render_as() { # FILE MATERIALS INTEGRATOR
  "$aureole" render "$1" -D materials="$2" --integrator "$3" --width 24 --height 18 --spp 2 -o picture.exr 2>messages.txt ||
    fail "$1 $2 $3: $(cat messages.txt)"
  grep -q 'NaN' messages.txt && fail "$1 $2 $3: $(cat messages.txt)"
  mean picture.exr picture.exr | awk '{ exit !($1 > 0.01 && $1 < 10) }' || fail "$1 $2 $3: mean $(mean picture.exr picture.exr)"
}

render_both() { # FILE
  render_as "$1" phong_lobe finalgather:photons=20000,diffuse_samples=4,glossy_samples=4
  render_as "$1" rough path
}

render_both made/plates/plates.xml
skipped=
for scene in cornell-box/figure room/room parade/parade statue/statue sphere/sphere occlusion/occlusion; do
  if "$aureole" info "$source/scenes/$scene.xml" >/dev/null 2>missing.txt; then
    render_both "$source/scenes/$scene.xml"
  elif grep -q 'scripts/scenes.sh' missing.txt; then
    skipped="$skipped $scene"
  else
    fail "$(cat missing.txt)"
  fi
done
[ -z "$skipped" ] || echo "not made, so not rendered:$skipped"
exit $((failures > 0))

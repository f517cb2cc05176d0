#!/usr/bin/env bash
# Renders every bundled scene by every integrator, small, and prints a table: "finite" where all values of the image are, and no
# sample was NaN or infinite on the way; "refused" where the integrator does not take the scene, with the reason below.
#   scripts/finite.sh [PROGRAM]
# Scenes whose meshes have not been made (scripts/scenes.sh) are named and left out. Exit status 1 where something is not finite.
set -uo pipefail
aureole=$(realpath "${1:-build/release/aureole}")
source=$(cd "$(dirname "$0")/.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 2
export AUREOLE_CACHE=
mapfile -t integrators < <("$aureole" help integrator --format csv | awk -F, 'NR > 1 && !/another name of/ { print $1 }')
declare -A keys=([finalgather]=:photons=20000,diffuse_samples=4,glossy_samples=4 [radiosity]=:paths=65536 [ao]=:samples=4
                 [aov]=':aovs=(a:albedo,n:sh_normal,p:position)')
status=0
cell() { # cell SCENE INTEGRATOR
  "$aureole" render "$1" "${define[@]}" --integrator "$2${keys[$2]:-}" --width 24 --height 18 --spp 2 -o picture.exr >said 2>&1
  local result=$?
  if [ $result = 0 ] && ! grep -qi 'nan\b\|infinite' said && "$aureole" info picture.exr --format csv >said 2>&1 &&
    awk -F, 'NR == 1 { for (c = 1; c <= NF; ++c) if ($c == "not_finite") column = c; next } { sum += $column; ++rows }
             END { exit !(column && rows && sum == 0) }' said; then
    echo -n ' finite |'
  elif [ $result = 2 ]; then
    echo -n ' refused |'
    echo "- \`$2\`: $(sed -n 's/.*aureole: *//; s/^[^ ]*\.xml[:0-9]* *//; $p' said)" >>refused
  else
    echo -n ' **not finite** |'
    sed "s|^|$1 $2: |" said >&2
    status=1
  fi
}
printf '| |'; printf ' `%s` |' "${integrators[@]}"; echo
printf '|---|'; printf -- '---|%.0s' "${integrators[@]}"; echo
for scene in "$source"/scenes/*/*.xml; do
  [[ $scene != */materials-* && $scene != *-camera.xml ]] || continue # parts of scenes
  name=${scene#"$source"/scenes/}
  "$aureole" info "$scene" >/dev/null 2>said || { echo "$name: $(tail -1 said)" >&2; continue; }
  for materials in rough phong_lobe; do
    define=(-D materials=$materials)
    grep -q '"materials"' "$scene" || { [ $materials = rough ] || continue; define=(); }
    echo -n "| \`$name\`${define[*]/#-D/} |"
    for integrator in "${integrators[@]}"; do cell "$scene" "$integrator"; done
    echo
  done
done
[ ! -e refused ] || { echo; sort -u refused; }
exit $status

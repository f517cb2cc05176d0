#!/usr/bin/env bash
# Keller's scenes are what their program makes, with the published numbers of triangles.
set -u
program=$1
source=$2
keller=$(dirname "$1")/keller
rm -rf made && mkdir -p made/meshes
"$keller" made || exit 1
for file in made/*.xml made/meshes/*.obj; do
  cmp "$file" "$source/scenes/keller/${file#made/}" ||
    { echo "make it again: cmake --build --preset release --target scene-meshes"; exit 1; }
done
for scene in cube:12 teapot-box:1572 office:276 living-room:3604 corridor:12; do
  for form in "" -analytic; do
    file=$source/scenes/keller/${scene%:*}$form.xml
    [ -e "$file" ] || [ "${scene%:*}" = corridor ] || { echo "no $file"; exit 1; }
    [ -e "$file" ] || continue
    "$program" info "$file" --format csv >info.csv || exit 1
    awk -F, -v wanted="${scene#*:}" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "triangles") at = i }
                                     NR == 2 { found = $at } END { exit found != wanted }' info.csv ||
      { echo "$file: $(cat info.csv)"; exit 1; }
  done
done
# It writes whole files or none.
"$keller" missing-folder 2>message && { echo "wrote into a folder that does not exist"; exit 1; }
grep -q missing-folder message || { echo "the message does not name the folder: $(cat message)"; exit 1; }
"$keller" 2>/dev/null && { echo "ran without a folder"; exit 1; }
exit 0

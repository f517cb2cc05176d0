#!/usr/bin/env bash
# From a fresh clone to an image in a few minutes: installs what is needed, builds the program alone, makes the room's
# meshes, and renders the README's room until its error is 10 % of its mean. The image goes to out/room.png.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/deps.sh
cmake --preset release --log-level=WARNING
cmake --build --preset release -j "$(nproc)" --target aureole-program aureole-scenes

run() {
  echo "+ $*"
  "$@" </dev/null
}
mkdir -p out
mapfile -t meshes < <(grep -oh 'generated/[^"]*' scenes/room/*.xml | sort -u | sed 's|generated/||')
run scripts/scenes.sh "${meshes[@]}"
run build/release/aureole render scenes/room/room.xml --width 960 --error 10% --error-measure mean -o out/room.exr
run build/release/aureole convert out/room.exr out/room.png --exposure 0.9 --tone filmic
echo "the image is out/room.png, and out/room.exr in full range"

#!/usr/bin/env bash
# Makes the large meshes and the environments of the bundled scenes in scenes/generated, once: what is there is left as it
# is. Builds the program that makes them where there is none. Arguments go to it: --again, or names of files.
set -euo pipefail
cd "$(dirname "$0")/.."

if [ ! -x build/release/aureole-scenes ]; then
  bash scripts/deps.sh
  cmake --preset release --log-level=WARNING
  cmake --build --preset release -j "$(nproc)" --target aureole-scenes
fi
exec build/release/aureole-scenes --folder scenes/generated "$@"

#!/usr/bin/env bash
# Set-up, build, and the main job: a glossy Cornell box by final gathering, then the experiment that compares the patterns
# it can gather with. The first and only command after a clone; the results go to out/.
set -euo pipefail
cd "$(dirname "$0")/.."

bash scripts/deps.sh
cmake --preset release --log-level=WARNING
cmake --build --preset release -j "$(nproc)"
aureole=build/release/aureole
mkdir -p out

run() {
  echo "+ $*"
  "$@" </dev/null
}
run "$aureole" render scenes/cornell-box/glossy.xml -v -o out/cornell-glossy.exr
run "$aureole" convert out/cornell-glossy.exr out/cornell-glossy.png --exposure 1
run "$aureole" lab run marques-2013-gather -o out/lab

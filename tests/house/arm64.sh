#!/usr/bin/env bash
# Points, a measure, weights and an image by the build for arm64, under qemu-user: the numbers have the bits of this build,
# and the image differs by roundings of rays. scripts/arm64.sh makes that build and asks more; without it this is skipped.
set -u
aureole=$1 source=$2 root=$2/build/arm64-root
[ -x "$source/build/arm64/aureole" ] || { echo "skipped: no build for arm64 (scripts/arm64.sh makes it)"; exit 77; }
command -v qemu-aarch64 >/dev/null || { echo "skipped: qemu-aarch64 is missing (Debian: qemu-user)"; exit 77; }
cmake --build "$source/build/arm64" --target aureole-program >log 2>&1 || { tail log; exit 1; }
same() { # same ARGUMENTS...
  "$aureole" "$@" -q >here || { echo "aureole $*: fails"; exit 1; }
  qemu-aarch64 -L "$root" "$source/build/arm64/aureole" "$@" -q >there || { echo "aureole $*: fails on arm64"; exit 1; }
  cmp here there || { echo "aureole $*: differs on arm64"; exit 1; }
}
for set in sobol spherical-fibonacci larcher-pillichshammer halton; do
  same points $set -n 64 --domain hemisphere --format csv
done
same points sobol -n 64 --scramble owen --seed 3 --lobe ggx:0.3:40 --format csv
same measure spherical-fibonacci -n 64 -m energy --format csv
same weights sobol -n 40 --lobe cosine --lobe2 phong:20 --angle 40 --n2 20
picture=(render "$source/scenes/cornell-box/glossy.xml" -q --width 16 --height 16 --spp 1 --integrator path:max_depth=3)
"$aureole" "${picture[@]}" -o here.exr || exit 1
qemu-aarch64 -L "$root" "$source/build/arm64/aureole" "${picture[@]}" -t 1 -o there.exr || exit 1
"$aureole" compare here.exr there.exr --format csv --tolerance inf |
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "relative_rmse") at = i } NR == 2 { exit !($at < 1e-5) }' ||
  { echo "the image differs on arm64"; exit 1; }

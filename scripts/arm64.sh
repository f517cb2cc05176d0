#!/usr/bin/env bash
# scripts/arm64.sh: the tree for arm64 on a Debian x86-64 machine: libraries of arm64 in build/arm64-root, a cross build in
# build/arm64 (preset arm64), and what is asked of it under qemu-user: tests of core, of points and directions, of the sampler
# and of rays in packets; and that points, measures and weights have the bits of the build for this machine (build/release).
# Exit 77 where a tool is missing, which is named.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD/build/arm64-root

command -v aarch64-linux-gnu-g++ >/dev/null || { echo "arm64.sh: skipped: aarch64-linux-gnu-g++ is missing (Debian: g++-aarch64-linux-gnu)"; exit 77; }
bash scripts/arm64_root.sh || exit $?
cmake --preset arm64 --log-level=WARNING
tests=(sampling_stream scene_packet pointset_generators pointset_net_2d pointset_runs sphere_fibonacci sphere_inverse linear_cholesky)
for file in tests/points/base/test_*.c; do
  name=${file##*/test_}
  tests+=("base_${name%.c}")
done
cmake --build --preset arm64 --target aureole-program "${tests[@]/#/test_}"
names=${tests[*]/_//}
ctest --test-dir build/arm64 -j "$(nproc)" --output-on-failure -R "^(${names// /|})\$"

run=build/arm64/run-aureole
printf '#!/bin/sh\nexec qemu-aarch64 -L "%s" "%s" "$@"\n' "$root" "$PWD/build/arm64/aureole" >"$run"
chmod +x "$run"
bash scripts/bits.sh build/release/aureole numbers >build/arm64/bits-here
bash scripts/bits.sh "$run" numbers >build/arm64/bits-arm64
diff build/arm64/bits-here build/arm64/bits-arm64 || { echo "arm64.sh: these numbers differ"; exit 1; }
echo "arm64.sh: $(wc -l <build/arm64/bits-here) sums of points, measures and weights are those of $(uname -m)"

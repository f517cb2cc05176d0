#!/usr/bin/env bash
# scripts/arm64.sh: the tree for arm64 on a Debian x86-64 machine: libraries of arm64 in build/arm64-root, a cross build in
# build/arm64 (preset arm64), and what is asked of it under qemu-user: tests of core, of points and directions, of the sampler
# and of rays in packets; and that points, measures and weights have the bits of the build for this machine (build/release).
# Exit 77 where a tool is missing, which is named.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD/build/arm64-root

for tool in aarch64-linux-gnu-gcc:gcc-aarch64-linux-gnu aarch64-linux-gnu-g++:g++-aarch64-linux-gnu qemu-aarch64:qemu-user \
            apt-get:apt dpkg-deb:dpkg; do
  command -v "${tool%%:*}" >/dev/null || { echo "arm64.sh: skipped: ${tool%%:*} is missing (Debian: ${tool#*:})"; exit 77; }
done

# Debian's packages for arm64, unpacked beside the build: nothing of the system is changed. apt keeps its lists here, too.
if [ ! -e "$root/complete" ]; then
  mkdir -p "$root"/apt/{state/lists,cache/archives}/partial
  : >"$root/apt/status"
  apt=(apt-get -qq -y --no-install-recommends -o Debug::NoLocking=1 -o APT::Sandbox::User="$(id -un)" -o "Dir::State=$root/apt/state"
       -o "Dir::Cache=$root/apt/cache" -o "Dir::State::status=$root/apt/status" -o APT::Architecture=arm64 -o APT::Architectures=arm64)
  "${apt[@]}" update && "${apt[@]}" --download-only install libembree-dev libopenexr-dev libpng-dev libstb-dev libexpat1-dev zlib1g-dev liblapacke-dev \
    libopenblas-serial-dev libmicrohttpd-dev libcmocka-dev libc6-dev libstdc++-12-dev >/dev/null ||
    { echo "arm64.sh: skipped: Debian's packages for arm64 are not to be had"; exit 77; }
  for package in "$root"/apt/cache/archives/*.deb; do
    dpkg-deb -x "$package" "$root"
  done
  # Links to files of the root system lead into this one; BLAS and LAPACK are alternatives, which no script sets here.
  find "$root/usr/lib" "$root/lib" -type l -lname '/*' | while read -r link; do
    ln -sfn "$root$(readlink "$link")" "$link"
  done
  libraries=$root/usr/lib/aarch64-linux-gnu
  for file in libblas.so libblas.so.3 liblapack.so liblapack.so.3 libopenblas.so libopenblas.so.0; do
    ln -sfn "openblas-serial/$file" "$libraries/$file"
  done
  for name in blas lapack; do
    ln -sfn "../openblas-serial/pkgconfig/$name-openblas.pc" "$libraries/pkgconfig/$name.pc"
  done
  ln -sfn ../openblas-serial/pkgconfig/openblas.pc "$libraries/pkgconfig/openblas.pc"
  rm -rf "$root/apt"
  : >"$root/complete"
fi

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

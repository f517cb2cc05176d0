#!/usr/bin/env bash
# scripts/arm64_root.sh: libraries and Python of Debian for arm64, unpacked into build/arm64-root for scripts/arm64.sh and
# scripts/wheel_arm64.sh; nothing of the system is changed. Exit 77 where a tool is missing, which is named.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD/build/arm64-root
for tool in aarch64-linux-gnu-gcc:gcc-aarch64-linux-gnu qemu-aarch64:qemu-user apt-get:apt dpkg-deb:dpkg; do
  command -v "${tool%%:*}" >/dev/null || { echo "arm64_root.sh: skipped: ${tool%%:*} is missing (Debian: ${tool#*:})"; exit 77; }
done

# apt keeps its lists here, too.
if [ ! -e "$root/complete" ]; then
  mkdir -p "$root"/apt/{state/lists,cache/archives}/partial
  : >"$root/apt/status"
  apt=(apt-get -qq -y --no-install-recommends -o Debug::NoLocking=1 -o APT::Sandbox::User="$(id -un)" -o "Dir::State=$root/apt/state"
       -o "Dir::Cache=$root/apt/cache" -o "Dir::State::status=$root/apt/status" -o APT::Architecture=arm64 -o APT::Architectures=arm64)
  "${apt[@]}" update && "${apt[@]}" --download-only install libembree-dev libopenexr-dev libpng-dev libstb-dev libexpat1-dev zlib1g-dev liblapacke-dev \
    libopenblas-serial-dev libmicrohttpd-dev libcmocka-dev libc6-dev libstdc++-12-dev python3 libpython3-dev >/dev/null ||
    { echo "arm64_root.sh: skipped: Debian's packages for arm64 are not to be had"; exit 77; }
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

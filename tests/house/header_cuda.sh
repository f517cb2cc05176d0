#!/usr/bin/env bash
# aureole_sampling.h in CUDA: nvcc and clang compile every function of it for a device, without an operation that would be rounded
# otherwise than on the host; by nvcc the host has the library's points, and the example's device those of its host.
set -u
build=$(dirname "$1")
source_tree=$2
tests=$source_tree/tests/house
status=77
fail() { echo "$*"; exit 1; }
# In the device's assembly all operations on numbers are rounded to nearest, and none are fused.
check() {
  grep -q 'sqrt\.rn\.f64' "$1" || fail "$1 has no code"
  ! grep -E '\b(fma|mad)\.[a-z.]*f(32|64)|\.approx|\.ftz|\b(mul|add|sub|div|sqrt)\.f(32|64)' "$1" || fail "$1: rounded otherwise than on the host"
}
if clang --print-targets 2>/dev/null | grep -q nvptx64; then
  status=0
  clang -x cuda --cuda-device-only -nocudalib -nocudainc --cuda-gpu-arch=sm_60 -Wno-unknown-cuda-version -DWITHOUT_TOOLKIT -O2 \
    -ffp-contract=off -Wall -Wextra -Werror -I "$source_tree/include" -S "$tests/header_cuda/every.cu" -o clang.ptx || fail "clang"
  check clang.ptx
fi
nvcc=$(command -v nvcc || echo /usr/local/cuda/bin/nvcc)
if [ -x "$nvcc" ]; then
  status=0
  nvcc=("$nvcc" -O2 -fmad=false -Xcompiler -ffp-contract=off -Werror all-warnings -I "$source_tree/include")
  "${nvcc[@]}" -DWITHOUT_POW -ptx "$tests/header_cuda/every.cu" -o nvcc.ptx || fail "nvcc"
  check nvcc.ptx
  "${nvcc[@]}" "$source_tree/examples/cuda/sampling.cu" -o sampling || fail "sampling.cu does not compile"
  ./sampling >sampling.txt || fail "$(cat sampling.txt)"
  awk '$1 == "host" { good = $3 + 0 < 0.6 * $7 } $1 == "device" && $2 != "none" && $2 != 0 { bad = 1 } END { exit bad || !good }' sampling.txt ||
    fail "$(cat sampling.txt)"
  if [ -e "$build/libaureole.so" ] && ! grep -q '^AUREOLE_SANITIZE:[^=]*=[a-z]' "$build/CMakeCache.txt"; then
    "${nvcc[@]}" -x cu "$tests/header_single/points.c" -o points -L "$build" -laureole -Xlinker -rpath,"$build" && ./points || fail "points"
  fi
fi
[ "$status" = 0 ] || echo "skipped: there is no nvcc, and no clang that knows NVIDIA's devices"
exit $status

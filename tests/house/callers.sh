#!/usr/bin/env bash
# The callers of examples/ in other languages give the integral of their closed form and the program's points, where their compilers are.
set -u
build=$(dirname "$1")
source_tree=$2
[ -e "$build/libaureole.so" ] || { echo "skipped: the libraries are static"; exit 77; }
! grep -q '^AUREOLE_SANITIZE:[^=]*=[a-z]' "$build/CMakeCache.txt" || { echo "skipped: a sanitizer must be there before the program"; exit 77; }
fail() { echo "$*"; exit 1; }
point=$("$1" points sobol -n 4096 --dim 4 --scramble owen --seed 3 --first 7 --count 1 | tail -1)
status=77
# The error of 16 independent estimates; the integral is within five of it.
check() {
  status=0
  awk -v point="$point" '
    $1 == "integral" { off = $2 - 1; good = $4 > 0 && $4 < 1e-3 && off < 5 * $4 && off > -5 * $4 }
    /^point 7/ { sub(/.*\[/, ""); sub(/\].*/, ""); split($0, found, ", "); split(point, expected, ",")
                 for (i = 1; i <= 4; ++i) same += found[i] + 0 == expected[i] + 0 }
    /^a wrong name: .*did you mean .sobol/ { named = 1 }
    END { exit !(good && same == 4 && named) }' "$1" || fail "$1: $(cat "$1")"
}
if rustc --version >rustc.txt 2>&1; then
  rustc -O -D warnings "$source_tree/examples/rust/integral.rs" -L "$build" -l aureole -o integral || fail "integral.rs does not compile"
  LD_LIBRARY_PATH=$build ./integral >rust.txt || fail "integral.rs failed"
  check rust.txt
fi
if command -v julia >/dev/null; then
  AUREOLE=$build/libaureole.so julia "$source_tree/examples/julia/integral.jl" >julia.txt || fail "integral.jl failed"
  check julia.txt
fi
[ "$status" = 0 ] || echo "skipped: neither Rust nor Julia is here"
exit $status

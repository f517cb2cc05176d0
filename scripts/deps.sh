#!/usr/bin/env bash
# Installs what Aureole needs on Debian 12, from the one list below; deps.sh --all also what it can do without. Does nothing,
# and says so, when all is there.
set -euo pipefail

packages=(
  # tools
  ca-certificates clang-format cmake g++ gcc git ninja-build pkg-config
  # ray tracing, images, scene files, models, linear algebra, the page of a render
  libembree-dev libopenexr-dev libpng-dev libstb-dev libexpat1-dev libassimp-dev zlib1g-dev liblapacke-dev libopenblas-serial-dev
  libmicrohttpd-dev
  # unit tests
  libcmocka-dev
)
# many machines; the Python package and engines for SciPy; the pages for a browser; tests of the binary interface, of terminals, and of
# the header and the library in other languages
[ "${1:-}" != --all ] || packages+=(libopenmpi-dev openmpi-bin python3-numpy python3-cffi python3-dev python3-scipy python3-pytest python3-markdown-it
  chromium abigail-tools xz-utils bsdutils clang rustc)

command -v dpkg-query >/dev/null || {
  echo "deps.sh: not a Debian system; install the equivalents of: ${packages[*]}" >&2
  exit 1
}

# The packages of the list that are not installed, one a line.
missing_packages() {
  local package
  for package in "${packages[@]}"; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || echo "$package"
  done
}

mapfile -t missing < <(missing_packages)
if [ ${#missing[@]} -eq 0 ]; then
  echo "deps.sh: all ${#packages[@]} packages are installed, nothing to do"
  exit 0
fi

echo "deps.sh: installing ${missing[*]}"
as_root=()
if [ "$(id -u)" != 0 ]; then
  command -v sudo >/dev/null || {
    echo "deps.sh: run as root, or install sudo; missing: ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi
install=(env DEBIAN_FRONTEND=noninteractive apt-get -o Acquire::Retries=3 -o DPkg::Lock::Timeout=120 -qq)
"${as_root[@]}" "${install[@]}" update </dev/null
"${as_root[@]}" "${install[@]}" install -y --no-install-recommends "${missing[@]}" </dev/null >/dev/null

mapfile -t missing < <(missing_packages)
if [ ${#missing[@]} -gt 0 ]; then
  echo "deps.sh: still missing: ${missing[*]}" >&2
  exit 1
fi
echo "deps.sh: done"

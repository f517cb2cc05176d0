#!/usr/bin/env bash
# wheel_bare.sh [FOLDER]: installs the wheels that scripts/wheel.sh made (build/wheel) in a bare Debian 12, which has python3-pip and neither a
# compiler nor a library of ours, by `pip install aureole[render]`, and makes points and an image there. As root; needs debootstrap, or BARE,
# the folder of a bare system that is copied. Packages of PyPI are fetched here, so that pip needs no network in there.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$(realpath "${1:-build/wheel}")
ls "$folder"/aureole-[0-9]*manylinux*.whl "$folder"/aureole_render-[0-9]*manylinux*.whl >/dev/null || { echo "wheel_bare.sh: run scripts/wheel.sh first" >&2; exit 2; }
root=$(mktemp -d "${TMPDIR:-/var/tmp}/bare.XXXXXX")
trap 'umount "$root/proc" 2>/dev/null || true; rm -rf --one-file-system "$root"' EXIT
if [ -n "${BARE:-}" ]; then
  cp -a "$BARE/." "$root/"
else
  debootstrap --variant=minbase --include=ca-certificates bookworm "$root" >/dev/null
fi
mount -t proc proc "$root/proc"
cp /etc/resolv.conf /etc/hosts "$root/etc/"
mkdir "$root/wheels"
cp "$folder"/*.whl "$root/wheels"
cp -r scenes/cornell-box "$root/scene"
python3 -m pip -q download -d "$root/wheels" --only-binary :all: --python-version 3.11 numpy cffi
inside() { env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive chroot "$root" "$@" </dev/null; }
inside apt-get -qq update
inside apt-get -qq install -y --no-install-recommends python3-pip >/dev/null 2>&1
for name in cc gcc clang cmake; do
  ! inside sh -c "command -v $name" || { echo "wheel_bare.sh: $name is there, so this is no bare system" >&2; exit 1; }
done
inside pip -q install --break-system-packages --root-user-action ignore --no-warn-script-location --no-index --find-links /wheels 'aureole[render]'
cat >"$root/try.py" <<'PYTHON'
import aureole
print(aureole.points("spherical-fibonacci", 1000).shape, aureole.render_library())
picture = aureole.render("/scene/cornell-box.xml", width=128, spp=16, threads=1)
aureole.write_image("/picture.png", picture)
assert picture.shape == (128, 128, 3) and 0.1 < picture.mean() < 1, picture.mean()
print(picture.shape, "mean", picture.mean())
PYTHON
inside python3 /try.py
[ -z "${PICTURE:-}" ] || cp "$root/picture.png" "$PICTURE"

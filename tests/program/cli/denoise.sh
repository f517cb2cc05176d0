#!/usr/bin/env bash
# Denoising: what is called and with what, by a stand-in for Open Image Denoise, and the words where there is none.
set -u
aureole=$1
source=$2
scene=$source/scenes/cornell-box/cornell-box.xml
stub=$(dirname "$aureole")/tests/oidn_stub.so
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
render() { "$aureole" render "$scene" --width 40 -q "$@"; }
AUREOLE_OIDN=$PWD/nowhere.so render -o none.exr --denoise 2>message.txt
[ $? -eq 2 ] && grep -q -- '--denoise: the library that AUREOLE_OIDN names: .*nowhere.so' message.txt || fail "no library: $(cat message.txt)"
AUREOLE_OIDN=libz.so.1 render -o none.exr --denoise 2>message.txt
[ $? -eq 2 ] && grep -q -- '--denoise: the library is no Open Image Denoise' message.txt || fail "another library: $(cat message.txt)"
AUREOLE_OIDN=$stub render -o none.exr --denoise --shard 1/2 2>message.txt
[ $? -eq 2 ] && grep -q -- "'--denoise' does not go with '--shard'" message.txt || fail "a part: $(cat message.txt)"

# What the camera sees of the lamp, as the features tell it: by the samples alone.
render -o lights.exr --integrator path:max_depth=1,lamp_rays=0 --sampler sobol --spp 16 && "$aureole" convert lights.exr lights.pfm --channels R,G,B || fail "no lights"

check() { # check NAME OPTION...: NAME.exr is made of what stands in it, and its noisy channels are the picture without --denoise
  local name=$1
  shift
  render -o plain.exr "$@" && AUREOLE_OIDN=$stub render -o "$name.exr" --denoise "$@" || { fail "$name: no picture"; return; }
  "$aureole" convert plain.exr plain.pfm --channels R,G,B
  for part in R,G,B noisy.R,noisy.G,noisy.B albedo.R,albedo.G,albedo.B normal.X,normal.Y,normal.Z; do
    "$aureole" convert "$name.exr" "${part%%.*}.pfm" --channels "$part" || fail "$name: no channels $part"
  done
  rm -f error.pfm
  "$aureole" info "$name.exr" | grep -q 'error\.R' && "$aureole" convert "$name.exr" error.pfm --channels error.R,error.G,error.B
  cmp plain.pfm noisy.pfm || fail "$name: the noisy picture has other bits"
  python3 - <<'END' || fail "$name: not what the library makes"
import array, math, os
def values(name):
    with open(name, "rb") as file:
        return array.array("f", file.read().split(b"\n", 3)[3])
out, noisy, albedo, normal, lights = [values(n) for n in ("R,G,B.pfm", "noisy.pfm", "albedo.pfm", "normal.pfm", "lights.pfm")]
assert len(out) == 4800 and max(albedo) > 0.5 and min(normal) < -0.5
errors = values("error.pfm") if os.path.exists("error.pfm") else len(out) * [math.inf]
width, height = 40, 40
def largest(picture, x, y):
    return max(picture[3 * (y * width + x):][:3])
def around(x, y):
    return max(largest(lights, u, v) for v in range(max(y - 1, 0), min(y + 2, height)) for u in range(max(x - 1, 0), min(x + 2, width)))
bright = 4 * sum(largest(noisy, x, y) for y in range(height) for x in range(width)) / (width * height)
kept = bound = 0
for i, (o, c, a, n) in enumerate(zip(out, noisy, albedo, normal)):
    x, y = i // 3 % width, i // 3 // width
    if largest(lights, x, y) > bright or largest(noisy, x, y) > bright and around(x, y) > bright:
        kept += 1
        assert o == c, (o, c)
        continue
    wanted = c / 2 + a / 4 + n / 8
    least, most = c - 2 * errors[i], c + 2 * errors[i]
    bound += not least <= wanted <= most
    # The sum and the bounds have two roundings each.
    assert abs(o - min(max(wanted, least), most)) <= 1e-6 * (abs(c) + 1), (o, c, a, n, errors[i])
assert 0 < kept < 480 and (bound > 0) == os.path.exists("error.pfm"), (kept, bound)
END
}
command -v python3 >/dev/null || { echo "no python3: the values are not tested"; exit $((failures > 0 ? 1 : 77)); }
check a --spp 2
check b --rounds 2
# Where the picture has such channels of its own they stay what they are.
AUREOLE_OIDN=$stub render -o c.exr --denoise --spp 2 --integrator aov && "$aureole" convert c.exr c.pfm --channels noisy.R,noisy.G,noisy.B &&
  [ "$("$aureole" info c.exr | grep -o 'albedo\.R' | wc -l)" -eq 1 ] || fail "a picture with an albedo"
AUREOLE_OIDN=$stub render -o d.png --denoise --spp 2 && [ -s d.png ] && render -o plain.exr --spp 2 && cmp d.noisy.exr plain.exr || fail "a PNG and what stands beside it"
exit $((failures > 0))

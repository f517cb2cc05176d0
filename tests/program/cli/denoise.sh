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
[ $? -eq 2 ] && grep -q -- '--denoise: the library in AUREOLE_OIDN: .*nowhere.so' message.txt || fail "no library: $(cat message.txt)"
AUREOLE_OIDN=libz.so.1 render -o none.exr --denoise 2>message.txt
[ $? -eq 2 ] && grep -q -- '--denoise: the library is not Open Image Denoise' message.txt || fail "another library: $(cat message.txt)"
AUREOLE_OIDN=$stub render -o none.exr --denoise --shard 1/2 2>message.txt
[ $? -eq 2 ] && grep -q -- "'--denoise' cannot be used with '--shard'" message.txt || fail "a part: $(cat message.txt)"

# What the camera sees of the lamp, as the features tell it: by the samples alone.
lights() { render -o lights.exr --filter box --integrator path:max_depth=1,lamp_rays=0 --sampler sobol --spp "$1" && "$aureole" convert lights.exr lights.pfm --channels R,G,B || fail "no lights"; }

check() { # check NAME OPTION...: NAME.exr is made of what stands in it, and its noisy channels are the picture by the filter box without --denoise
  local name=$1
  shift
  render -o plain.exr --filter box "$@" && AUREOLE_OIDN=$stub render -o "$name.exr" --denoise "$@" || { fail "$name: no picture"; return; }
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
def sees(x, y):
    return largest(lights, x, y) > bright or largest(noisy, x, y) > bright and around(x, y) > bright
def wanted(i):
    return noisy[i] / 2 + albedo[i] / 4 + normal[i] / 8
def squares(x, y): # of the changes and of the standard errors, in a pixel
    values = [] if sees(x, y) else range(3 * (y * width + x), 3 * (y * width + x) + 3)
    return sum((wanted(i) - noisy[i]) ** 2 for i in values), sum(errors[i] ** 2 for i in values)
def part(x, y): # of the change that the 5 x 5 pixels around allow
    near = [squares(u, v) for v in range(max(y - 2, 0), min(y + 3, height)) for u in range(max(x - 2, 0), min(x + 3, width))]
    change, error = math.sqrt(sum(n[0] for n in near)), 2 * math.sqrt(sum(n[1] for n in near))
    return error / change if change > error else 1
kept = bound = 0
for i, (o, c, a, n) in enumerate(zip(out, noisy, albedo, normal)):
    x, y = i // 3 % width, i // 3 // width
    if sees(x, y):
        kept += 1
        assert o == c, (o, c)
        continue
    share = part(x, y) if i % 3 == 0 else share
    bound += share < 1
    # The sum and the change have two roundings each.
    assert abs(o - (c + share * (wanted(i) - c))) <= 2e-6 * (abs(c) + 1), (o, c, a, n, errors[i])
assert 0 < kept < 480 and (bound > 0) == os.path.exists("error.pfm"), (kept, bound)
END
}
command -v python3 >/dev/null || { echo "no python3: the values are not tested"; exit $((failures > 0 ? 1 : 77)); }
lights 16
check a --spp 2
lights 8 # the fewest, where rays are counted
check b --rounds 2 --error-map
# Four samples per pixel leave pixels far from all around them: the denoiser takes them away, and the limit brings none back.
export STUB_BLURS=1
render -o plain.exr --filter box --width 64 --rounds 2 && AUREOLE_OIDN=$stub render -o e.exr --width 64 --rounds 2 --error-map --denoise || fail "no blurred image"
unset STUB_BLURS
"$aureole" convert plain.exr plain.pfm --channels R,G,B && "$aureole" convert e.exr e.pfm --channels R,G,B || fail "no channels"
isolated() { python3 "$source/tests/program/cli/isolated.py" "$1"; }
noisy=$(isolated plain.pfm) clean=$(isolated e.pfm)
echo "isolated pixels, bright and dark: $noisy of the noisy image, $clean of the denoised one"
[ "${noisy% *}" -gt 10 ] && [ "${clean% *}" -eq 0 ] || fail "isolated pixels"
# Without a target error there is one image, without replicas: the line that reproduces it gives its bits.
AUREOLE_OIDN=$stub "$aureole" render "$scene" --width 40 --time 0.2s -o g.exr --denoise 2>message.txt
grep -q 'g.exr has [0-9]* samples per pixel' message.txt && ! grep -q 'inf\|nan' message.txt || fail "one image: $(cat message.txt)"
eval "AUREOLE_OIDN=$stub render -o h.exr $(sed -n 's/.*to reproduce this image://p' message.txt)" && cmp g.exr h.exr || fail "not reproduced: $(cat message.txt)"
AUREOLE_OIDN=$stub render --time 0.2s --json -o g.exr --denoise >g.json && python3 -c 'import json
report = json.load(open("g.json"))
report = report[0] if isinstance(report, list) else report
assert report["error"] is None and report["samples_per_pixel"] >= 1, report' || fail "JSON of one image: $(cat g.json)"
# With a target error, two halves estimate the error of the denoised image.
AUREOLE_OIDN=$stub "$aureole" render "$scene" --width 40 --rounds 3 -o f.exr --denoise 2>message.txt
grep -q 'denoised half' message.txt && fail "an error of halves without a target"
AUREOLE_OIDN=$stub "$aureole" render "$scene" --width 40 --error 60% --integrator path -o f.exr --denoise 2>message.txt
grep -q 'denoised half of the samples: [0-9.]* % of the local mean (relative), at most [0-9.]* (95 %)' message.txt || fail "no error of halves: $(cat message.txt)"
AUREOLE_OIDN=$stub "$aureole" render "$scene" --width 1 --height 1 --error 60% --integrator path -o f.exr --denoise 2>message.txt
grep -q 'denoised half of the samples: .*, without a bound for so few pixels' message.txt || fail "one pixel: $(cat message.txt)"
# Where the image has such channels of its own they stay what they are.
AUREOLE_OIDN=$stub render -o c.exr --denoise --spp 2 --integrator aov && "$aureole" convert c.exr c.pfm --channels noisy.R,noisy.G,noisy.B &&
  [ "$("$aureole" info c.exr | grep -o 'albedo\.R' | wc -l)" -eq 1 ] || fail "a picture with an albedo"
AUREOLE_OIDN=$stub render -o d.png --denoise --spp 2 && [ -s d.png ] && render -o plain.exr --filter box --spp 2 && cmp d.noisy.exr plain.exr || fail "a PNG and what stands beside it"

# Isolated bright pixels after denoising with Open Image Denoise itself, where AUREOLE_OIDN or the system has it.
isolated() { "$aureole" convert "$1" counted.pfm --channels "$2" && python3 "$source/tests/program/cli/isolated.py" counted.pfm; }
small() { "$aureole" render "$source/scenes/$1.xml" -q --width 64 --integrator path -o a.exr "${@:2}"; }
if ! small cornell-box/cornell-box --spp 1 --denoise 2>message.txt && grep -q 'Open Image Denoise not found' message.txt; then
  echo "without Open Image Denoise: its isolated pixels are not counted"
else
  # A mirrored lamp may be one bright pixel: an image of many samples shows as many.
  for scene in cornell-box/cornell-box cornell-box/glossy room/room; do
    [ "$scene" != room/room ] || [ -e "$source/scenes/generated/wood.exr" ] || continue # scripts/scenes.sh makes it
    small "$scene" --filter box --spp 256 || fail "$scene: no image"
    read -r true _ < <(isolated a.exr R,G,B)
    for option in "--rounds 2 --error-map" "--rounds 2" "--spp 2"; do # with the limit of changes, and without
      # shellcheck disable=SC2086
      small "$scene" $option --denoise || fail "$scene $option: not denoised"
      read -r noisy _ < <(isolated a.exr noisy.R,noisy.G,noisy.B)
      read -r clean _ < <(isolated a.exr R,G,B)
      { [ "$noisy" -gt 10 ] && [ "$clean" -le "$true" ]; } ||
        fail "$scene $option: $noisy isolated bright pixels, $clean after denoising, $true of 256 samples"
    done
  done
fi
exit $((failures > 0))

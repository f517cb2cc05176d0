#!/usr/bin/env bash
# Light tracing: the same bits for all threads, shards, crops and steps; path tracing's mean; and light by way of mirrors
# from a point, which path tracing cannot find, by the light's mirror image.
. "$(dirname "$0")/common.sh.inc"
scene=$source/scenes/cornell-box/glossy.xml
size=(--width 40 --height 36 --spp 5)

for filter in box gaussian; do
  for threads in 1 2 3; do
    "$aureole" render "$scene" -q -t $threads --integrator ptracer --filter $filter "${size[@]}" -o threads-$threads.exr || fail "$threads threads"
  done
  cmp threads-1.exr threads-2.exr && cmp threads-1.exr threads-3.exr || fail "$filter: threads change bits"
  cp threads-1.exr whole-$filter.exr
done
"$aureole" render "$scene" -q --integrator ptracer --filter box "${size[@]}" -o whole.pfm &&
  "$aureole" render "$scene" -q --integrator ptracer --filter box "${size[@]}" --crop 7,33,5,30 -o crop.pfm || fail "a crop"
python3 - <<'PY' || fail "a crop changes bits"
import sys
whole, crop = open("whole.pfm", "rb").read()[-40 * 36 * 12:], open("crop.pfm", "rb").read()[-26 * 25 * 12:]
rows = [whole[((36 - 30 + y) * 40 + 7) * 12:][:26 * 12] for y in range(25)]  # the lowest first
sys.exit(b"".join(rows) != crop)
PY
"$aureole" render "$scene" -q --integrator ptracer --filter box "${size[@]}" --reference whole-box.exr --errors errors.csv -o steps.exr || fail "steps"
cmp steps.exr whole-box.exr || fail "steps change bits"
for shard in 1 2; do
  "$aureole" render "$scene" -q --integrator ptracer --filter box "${size[@]}" --shard $shard/2 -o shard-$shard.film || fail "shard $shard"
done
"$aureole" merge shard-1.film shard-2.film -o merged.exr || fail "shards do not merge"
cmp merged.exr whole-box.exr || fail "shards change bits"
"$aureole" render "$scene" -q --integrator ptracer "${size[@]}" --seed 1 -o seed.exr && cmp -s seed.exr whole-gaussian.exr && fail "the seed changes nothing"

# t of the means of two sets of images, pixels of 4 x 4 together, below the quantile that all 36 pass in 999 of 1000 runs.
agree() { # agree WHAT NAME NAME
  python3 - "$1" $2-*.pfm -- $3-*.pfm <<'PY' || fail "$1: the means differ"
import math, struct, sys
def blocks(name):
    data = open(name, "rb").read()
    values = struct.unpack("<1728f", data[-6912:])
    return [sum(values[3 * ((4 * j + y) * 24 + 4 * i + x) + c] for y in range(4) for x in range(4) for c in range(3)) / 48
            for j in range(6) for i in range(6)]
split = sys.argv.index("--")
sets = [[blocks(n) for n in names] for names in (sys.argv[2:split], sys.argv[split + 1:])]
def moments(v):
    m = sum(v) / len(v)
    return m, sum((x - m) ** 2 for x in v) / (len(v) - 1) / len(v)
worst = 0
for b in range(36):
    (m, v), (n, w) = (moments([s[b] for s in images]) for images in sets)
    assert m > 0 and n > 0
    worst = max(worst, abs(m - n) / math.sqrt(v + w + 1e-12 * n * n))
print(f"{sys.argv[1]}: t {worst:.2f}")
sys.exit(worst > 6.0) # Student's quantile of 22 degrees of freedom, by Sidak over 36: 5.3
PY
}
images() { # images NAME COUNT SCENE OPTION...
  rm -f "$1"-*.pfm
  for seed in $(seq "$2"); do
    "$aureole" render "$3" -q --width 24 --height 24 --seed "$seed" -o "$1-$seed.pfm" "${@:4}" || fail "$1"
  done
}
[ -n "${AUREOLE_SHORT_TESTS:-}" ] && exit $((failures > 0))
images ptracer 12 "$scene" --integrator ptracer:max_depth=6 --spp 64
images path 12 "$scene" --integrator path:max_depth=6 --spp 64
agree "glossy box" ptracer path

room() { # room NAME BODY
  cat >"$1.xml" <<XML
<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><float name="fov" value="30"/>
<transform name="to_world"><lookat origin="0,-3,1.5" target="0,0,0" up="0,0,1"/></transform>
<film type="hdrfilm"><rfilter type="box"/></film></sensor>
<shape type="rectangle"><transform name="to_world"><scale value="3"/></transform><bsdf type="diffuse"/></shape>$2</scene>
XML
}
point() { echo "<emitter type='point'><point name='position' x='0.2' y='0.1' z='$1'/></emitter>"; }
room mirror "$(point 1)<shape type='rectangle'><transform name='to_world'><scale value='50'/><rotate x='1' angle='180'/><translate z='2'/></transform><bsdf type='conductor'/></shape>"
room two "$(point 1)$(point 3)"
images mirror 12 mirror.xml --integrator ptracer:max_depth=3 --spp 128
images two 12 two.xml --integrator path:max_depth=2 --spp 16
agree "a point light in a mirror" mirror two

# What the camera sees in mirrors and through glass is path tracing's, or black.
cat >glass.xml <<XML
<scene version="3.0.0"><integrator type="path"/><sensor type="thinlens"><float name="fov" value="24"/><float name="aperture_radius" value=".2"/>
<float name="focus_distance" value="4"/><transform name="to_world"><lookat origin="0,-5,2" target="0,0,.6" up="0,0,1"/></transform><film type="hdrfilm"><rfilter type="tent"/></film></sensor>
<emitter type="constant"/><shape type="rectangle"><transform name="to_world"><scale value="3"/></transform><bsdf type="diffuse"/></shape>
<shape type="sphere"><transform name="to_world"><scale value=".6"/><translate z=".6" x=".5"/></transform><bsdf type="dielectric"/></shape>
<shape type="sphere"><transform name="to_world"><scale value=".5"/><translate z=".5" x="-.7"/></transform><bsdf type="plastic"/></shape>
<shape type="rectangle"><transform name="to_world"><scale value=".5"/><rotate x="1" angle="80"/><translate y="-1.5" z=".6"/></transform>
<bsdf type="mask"><float name="opacity" value=".5"/><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></bsdf></shape></scene>
XML
images ptracer 12 glass.xml --integrator ptracer:max_depth=6 --spp 256
images path 12 glass.xml --integrator path:max_depth=6 --spp 64
agree "glass, a mask and a lens" ptracer path

refuses() { # refuses WORDS OPTION...
  "$aureole" render "${@:2}" -q -o refused.exr 2>message.txt
  [ $? = 2 ] && grep -q "$1" message.txt || fail "expected '$1': $(cat message.txt)"
}
refuses "expected a number of samples" "$scene" --integrator ptracer --error 10%
sed 's/type="perspective"/type="orthographic"/; s/<float name="fov" value="30"\/>//' two.xml >flat.xml
refuses "expected a sensor 'perspective' or 'thinlens'" flat.xml --integrator ptracer
exit $((failures > 0))

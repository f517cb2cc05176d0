#!/usr/bin/env bash
# direct, depth and aov, path's hidden lights, and errors against a reference.
. "$(dirname "$0")/common.sh.inc"
box=$source/scenes/cornell-box/cornell-box.xml
small="-q --width 16 --height 16 --filter box"

# direct is path that ends at the second surface, however its samples are shared out: Welch's t of means over 6 seeds
# each, 5.1 the quantile for a chance of 5e-4 with 10 degrees of freedom, Sidak for 4 comparisons: 2e-3 in all.
means() { # NAME FIRST-SEED ARGUMENTS...: the means of 6 seeds
  local name=$1 first=$2
  shift 2
  for seed in $(either 0 "0 1 2 3 4 5"); do
    "$aureole" render "$box" $small --seed $((first + seed)) --spp 64 -o $name.pfm "$@" || { fail "$name: render"; return; }
    mean $name.pfm $name.pfm
  done | tr '\n' ' '
}
two=$(means two 1 --integrator path:max_depth=2)
for spec in direct direct:shading_samples=2 direct:emitter_samples=3,bsdf_samples=0 direct:emitter_samples=0,bsdf_samples=16; do
  echo "$two $(means direct 7 --integrator $spec)" | judge -v name=$spec '
    { for (i = 1; i <= 12; ++i) { k = i > 6; sum[k] += $i; square[k] += $i * $i }
      for (k = 0; k < 2; ++k) { mean[k] = sum[k] / 6; variance[k] = (square[k] - 6 * mean[k] * mean[k]) / 5 }
      t = (mean[1] - mean[0]) / sqrt((variance[0] + variance[1]) / 6)
      printf "%s: %.5f, path %.5f, t %.2f\n", name, mean[1], mean[0], t; exit !(NF == 12 && t < 5.1 && t > -5.1) }' ||
    fail "$spec is not path to depth 2"
done

# channel NAME STATISTIC PICTURE: minimum, mean or maximum of a channel.
channel() {
  "$aureole" info --format csv "$3" | awk -F, -v name="$1" -v what="$2" '
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
    NR > 1 && $column["channel"] == name { printf "%.9g\n", $column[what] }'
}
near() { # WHAT VALUE EXPECTED TOLERANCE
  awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { exit !(a != "" && a - b <= t && b - a <= t) }' || fail "$1: $2, not $3"
}

# sky.xml shows the face z = 1 of a cube, albedo 0.8, from z = 4.
sky=$source/tests/render/driver/sky.xml
aovs='a:albedo,d:depth,p:position,uv.x:uv,g:geo_normal,s:sh_normal,t:prim_index,i:shape_index,n:sample_count,v:variance'
"$aureole" render "$sky" -q --spp 4 --integrator "aov:aovs=($aovs),integrator=(direct:emitter_samples=2)" -o aov.exr || fail "aov"
for what in minimum maximum; do
  near "albedo" "$(channel a.G $what aov.exr)" 0.8 1e-6
  near "position" "$(channel p.Z $what aov.exr)" 1 1e-5
  near "geometric normal" "$(channel g.Z $what aov.exr)" 1 1e-6
  near "shading normal" "$(channel s.X $what aov.exr)" 0 1e-6
  near "shape" "$(channel i.I $what aov.exr)" 1 0
  near "samples" "$(channel n.N $what aov.exr)" 4 0
done
near "depth" "$(channel d.T minimum aov.exr)" 3 2e-3
# White materials reflect or transmit all light, also those without a diffuse part.
for material in white mirror glass pane plastic veil; do
  "$aureole" render "$source/tests/render/driver/white_bodies.xml" -q --spp 16 -Dmaterial=$material --integrator 'aov:aovs=(r:reflectance)' -o white.exr || fail "$material"
  near "reflectance of $material" "$(channel r.G maximum white.exr)" 1 1e-5
done
"$aureole" render "$sky" -q --spp 4 --integrator depth -o depth.exr || fail "depth"
near "depth beside aov" "$(channel R mean depth.exr)" "$(channel d.T mean aov.exr)" 1e-7
"$aureole" render "$sky" -q --spp 4 --integrator direct:emitter_samples=2 -o direct.exr || fail "direct"
near "radiance in aov" "$(channel R mean aov.exr)" "$(channel R mean direct.exr)" 0
for threads in 1 3; do "$aureole" render "$sky" -q --spp 4 -t $threads --integrator aov -o aov-$threads.exr || fail "aov"; done
cmp aov-1.exr aov-3.exr || fail "aov depends on threads"
# Without a nested integrator: the light and the surfaces that paths of one ray see, in packets of a row, also within a crop.
for scene in "$sky" "$source/scenes/cornell-box/cornell-box.xml"; do
  for nested in none path:max_depth=1,lamp_rays=0; do
    "$aureole" render "$scene" -q --width 40 --spp 3 --filter box --integrator "aov:aovs=(r:reflectance,s:sh_normal),integrator=($nested)" -o "aov-${nested%:*}.exr" || fail "aov of $nested"
    "$aureole" convert "aov-${nested%:*}.exr" "aov-${nested%:*}.pfm" --channels R,G,B || fail "no radiance of $nested"
  done
  cmp aov-none.pfm aov-path.pfm || fail "light without a nested integrator"
  for channels in r.R,r.G,r.B s.X,s.Y,s.Z; do
    for nested in none path; do "$aureole" convert "aov-$nested.exr" "aov-$nested.pfm" --channels $channels || fail "no $channels"; done
    cmp aov-none.pfm aov-path.pfm || fail "$channels without a nested integrator"
  done
done
"$aureole" render "$scene" -q --width 40 --spp 3 --filter box --crop 5,30,7,20 --integrator "aov:aovs=(s:sh_normal),integrator=none" -o crop.exr || fail "aov of a crop"
"$aureole" convert crop.exr crop.pfm --channels s.X,s.Y,s.Z || fail "no crop"
python3 - <<'END' || fail "aov of a crop has other bits"
whole, part = [open(name, "rb").read().split(b"\n", 3)[3] for name in ("aov-none.pfm", "crop.pfm")]
side, rows, row = 40, range(7, 20), 25 * 12 # PFM files begin with the last row
assert len(whole) == side * side * 12 and len(part) == len(rows) * row
for k, y in enumerate(reversed(rows)):
    start = ((side - 1 - y) * side + 5) * 12
    assert whole[start:start + row] == part[k * row:(k + 1) * row], y
END

# A veil of opacity 0.3 before a sky of 1, black itself: samples are 0 or 1, so their unbiased variance is
# m (1 - m) n / (n - 1) with m the mean. The same scene with the integrator nested in XML.
cat >veil.xml <<'XML'
<scene version="3.0.0">
  <integrator type="aov"><string name="aovs" value="v:variance, n:sample_count"/>
    <integrator type="path" name="inner"><integer name="max_depth" value="3"/></integrator></integrator>
  <sensor type="perspective"><transform name="to_world"><lookat origin="0,0,3" target="0,0,0" up="0,1,0"/></transform>
    <sampler type="independent"><integer name="sample_count" value="200"/></sampler>
    <film type="hdrfilm"><integer name="width" value="1"/><integer name="height" value="1"/><rfilter type="box"/></film></sensor>
  <shape type="rectangle"><transform name="to_world"><scale value="9"/></transform>
    <bsdf type="mask"><float name="opacity" value="0.3"/><bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf></bsdf></shape>
  <emitter type="constant"/>
</scene>
XML
"$aureole" render veil.xml -q -o veil.exr || fail "veil"
m=$(channel R mean veil.exr)
near "variance" "$(channel v.R mean veil.exr)" "$(awk -v m="$m" 'BEGIN { print m * (1 - m) * 200 / 199 }')" 1e-5
near "the veil" "$m" 0.7 0.15

# Hidden lights: the Cornell box' light is 15.9 bright, its walls are below 2 without it.
"$aureole" render "$box" -q --width 32 --height 32 --spp 16 --integrator path:hide_emitters=true -o hidden.exr || fail "hidden"
awk -v m="$(channel R maximum hidden.exr)" 'BEGIN { exit !(m < 2 && m > 0) }' || fail "the light is not hidden"

# Errors against a reference: a row at 1, 2, 4, 8 and 13 samples per pixel, the last that of `compare`; waves change no bit.
"$aureole" render "$box" $small --spp 64 --seed 7 -o reference.exr || fail "reference"
"$aureole" render "$box" $small --spp 13 --reference reference.exr --errors errors.csv -o waves.exr || fail "waves"
"$aureole" render "$box" $small --spp 13 -o whole.exr && cmp whole.exr waves.exr || fail "waves change the image"
[ "$(cut -d, -f1 errors.csv | tr '\n' ' ')" = "spp 1 2 4 8 13 " ] || fail "$(cat errors.csv)"
near "the last row" "$(tail -1 errors.csv | cut -d, -f5)" "$(figure rmse reference.exr whole.exr)" 1e-12
awk -F, 'NR > 1 { if ($2 != 256 * $1 || $3 <= rays || $4 < seconds) bad = 1; rays = $3; seconds = $4 } END { exit bad }' errors.csv ||
  fail "counts do not grow: $(cat errors.csv)"

# expect PATTERN ARGUMENTS...
expect() {
  local pattern=$1
  shift
  rm -f out.exr
  "$aureole" render "$box" $small --spp 1 -o out.exr "$@" 2>message.txt
  [ $? -eq 2 ] && [ "$(wc -l <message.txt)" -eq 1 ] && grep -Eq "^aureole: .*$pattern" message.txt && [ ! -e out.exr ] ||
    fail "$*: $(cat message.txt)"
}
expect "both be 0" --integrator direct:emitter_samples=0,bsdf_samples=0
expect "either 'shading_samples' or" --integrator direct:shading_samples=1,bsdf_samples=1
expect "takes no parameters" --integrator depth:far=1
expect "unknown kind of channel 'normals'; there are: albedo, depth" --integrator aov:aovs=a:normals
expect "'albedo' is not of the form name:type" --integrator aov:aovs=albedo
expect "two channels are called 'a.T'" --integrator 'aov:aovs=(a:depth,a:depth)'
expect "'finalgather' renders pixels jointly" --integrator aov:integrator=finalgather
expect "did you mean 'path'" --integrator aov:integrator=pth
expect "must be given together" --reference reference.exr
expect "none.exr: cannot read" --reference none.exr --errors errors.csv
expect "reference.exr: the sizes differ" --reference reference.exr --errors errors.csv --width 8
sed 's|</integrator></integrator>|</integrator><integrator type="path"/></integrator>|' veil.xml >two.xml
"$aureole" render two.xml -q -o out.exr 2>message.txt
[ $? -eq 2 ] && grep -q 'two.xml:3:[0-9]*: a second <integrator> inside another' message.txt || fail "$(cat message.txt)"
exit $((failures > 0))

#!/usr/bin/env bash
# The last line of a render that asks for no error says where the image is and how good it is: the error is what the second half of
# the samples changes, which is the difference between the image and the one of the first half.
# Where pixels share samples the halves have different weights too, and this holds but nearly: so it is asked of a box filter.
set -eu
program=$1 source=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
scene=$source/scenes/cornell-box/cornell-box.xml
failures=0
fail() {
  echo "FAILED: $1" >&2
  failures=1
}
value() { sed -n "s/.*\"$1\": \([-+.e0-9]*\).*/\1/p"; }

for spp in 2 8; do
  "$program" render "$scene" --width 24 --filter box --spp $((spp / 2)) -q -o half.exr
  "$program" render "$scene" --width 24 --filter box --spp $spp --json -o whole.exr >end.json 2>end.txt
  said=$(value error <end.json)
  found=$("$program" compare whole.exr half.exr --tolerance 100 --json | value relative_rmse)
  # Both are sums of the same differences; EXR files round values to 24 bits, so a difference of two errs by 2^-24 of the
  # values, whose root mean square is below 10 means here.
  awk -v a="$said" -v b="$found" 'BEGIN { exit !(b > 0 && (a > b ? a - b : b - a) <= 10 * 2 ^ -23) }' ||
    fail "$spp samples: said $said, found $found"
  grep -q "^aureole: whole.exr has an error of at most about $(awk -v a="$said" 'BEGIN { printf "%.0f", 100 * a }') % of its mean, after $spp samples" end.txt ||
    fail "$spp samples: $(cat end.txt)"
done

# One sample has no halves; pixels that final gathering treats together have no steps; a part is no image; '-' is no name.
"$program" render "$scene" --width 24 --spp 1 -o one.exr 2>end.txt
grep -q "^aureole: one.exr has 1 sample per pixel; use --error 5%" end.txt || fail "one sample: $(cat end.txt)"
"$program" render "$scene" --width 24 --spp 4 --integrator finalgather -o gathered.exr 2>end.txt
grep -q '^aureole: gathered.exr has 4 samples per pixel; use --error 5%' end.txt || fail "finalgather: $(cat end.txt)"
"$program" render "$scene" --width 24 --spp 4 --shard 1/2 -o part 2>end.txt
grep -q "^aureole: wrote the part part;" end.txt || fail "part: $(cat end.txt)"
"$program" render "$scene" --width 24 --spp 4 -o - 2>end.txt >picture.exr
grep -q '^aureole: the image has an error of at most about' end.txt || fail "standard output: $(cat end.txt)"
"$program" render "$scene" --width 24 --spp 4 -q -o quiet.exr 2>end.txt
[ ! -s end.txt ] || fail "quiet: $(cat end.txt)"
exit $failures

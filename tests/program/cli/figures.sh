#!/usr/bin/env bash
# Figures that a render reports of its image are those of the files that it writes.
set -u
aureole=$1
box=$2/scenes/cornell-box/cornell-box.xml
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}
value() { sed -n "s/.*\"$2\": \([-+.e0-9]*\).*/\1/p" "$1"; }
# near A B TOLERANCE: relative
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { d = a / b - 1; exit !(d <= t && -d <= t) }'; }
# The mean of R, G and B.
mean() { "$aureole" info "$1" --format csv | awk -F, '$4 ~ /^[RGB]$/ { sum += $6 } END { printf "%.9g", sum / 3 }'; }

# --errors: each row is the error of the render that ends there.
"$aureole" render "$box" --width 8 --spp 64 --seed 9 -q -o reference.pfm || fail "a reference"
"$aureole" render "$box" --width 8 --spp 8 -q --errors errors.csv --reference reference.pfm -o last.pfm || fail "--errors"
[ "$(cut -d, -f1,2 errors.csv | paste -sd' ')" = "spp,samples 1,64 2,128 4,256 8,512" ] || fail "samples: $(cat errors.csv)"
for spp in 1 2 4 8; do
  "$aureole" render "$box" --width 8 --spp $spp -q --json -o alone.pfm >alone.json || fail "$spp samples"
  "$aureole" compare reference.pfm alone.pfm --tolerance 100 --format csv >compared.csv || fail "compare"
  read -r rmse relative <<<"$(tail -1 compared.csv | cut -d, -f2,3 --output-delimiter=' ')"
  read -r rays said said_relative <<<"$(grep "^$spp," errors.csv | cut -d, -f3,5,6 --output-delimiter=' ')"
  near "$said" "$rmse" 1e-6 && near "$said_relative" "$relative" 1e-6 || fail "$spp samples: $said and $said_relative, not $rmse and $relative"
  near "$(awk "BEGIN { print $rmse / $relative }")" "$(mean reference.pfm)" 1e-5 || fail "an error is relative to the mean of the reference"
  # Rays of an image that is done in steps are at least those of one that is done at once, and each sample has one or more.
  awk -v r="$rays" -v s=$((64 * spp)) 'BEGIN { exit !(r >= s) }' || fail "$spp samples: $rays rays"
done

# --stats says in words what --json says.
"$aureole" render "$box" --width 8 --spp 8 --stats --json -o last.pfm >stats.json 2>stats.txt || fail "--stats"
grep -q "^aureole: $(value stats.json samples) samples, $(value stats.json rays) rays, .*, $(value stats.json invalid_samples) invalid samples$" stats.txt ||
  fail "$(cat stats.txt) is not $(cat stats.json)"

# An image to an error: on both streams, and of the file.
"$aureole" render "$box" --width 8 --error 20% --integrator path -o asked.pfm --json >asked.json 2>asked.txt || fail "--error"
near "$(value asked.json mean)" "$(mean asked.pfm)" 1e-6 || fail "the mean is $(mean asked.pfm): $(cat asked.json)"
near "$(value asked.json samples_per_pixel)" "$(awk "BEGIN { print $(value asked.json samples) / 64 }")" 1e-4 || fail "samples per pixel: $(cat asked.json)"
awk -v e="$(value asked.json error)" -v l="$(value asked.json error_low)" -v h="$(value asked.json error_high)" -v s="$(value asked.json samples_per_pixel)" \
  -v r="$(value asked.json rays)" 'BEGIN { printf "an error of %.3g %% of the local mean (relative), between %.3g and %.3g (95 %%), after %.4g samples per pixel, %.3g rays", 100 * e, 100 * l, 100 * h, s, r
    exit !(0 < l && l < e && e < h && h < .2) }' >expected || fail "an interval without its value: $(cat asked.json)"
grep -qFf expected asked.txt || fail "$(cat asked.txt) is not $(cat expected)"
"$aureole" render "$box" --width 8 --rounds 3 --integrator path -q -o rounds.pfm --json >rounds.json || fail "--rounds"
[ "$(value rounds.json rounds)" = 3 ] || fail "three rounds: $(cat rounds.json)"

exit $((failures > 0))

#!/usr/bin/env bash
# Figures in all formats: what is read back from them is the data, whatever the words in them are.
set -u
aureole=$1
source=$2
here=$(cd "$(dirname "$0")" && pwd)
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
command -v python3 >/dev/null || { echo "skipped: no python3: nothing reads figures"; exit 77; }

# One source has a name of letters that mean something in XML, PDF or TeX.
odd="a<b>&\"'\\_%\$#{}~^(é.csv"
"$aureole" points halton -n 100 -o "$odd" || fail "points"
"$aureole" measure sobol halton random "$odd" -n 16,64,200 --seeds 4 -m l2-star,star -q --format csv >figures.csv || fail "measure"
for format in svg pdf png tex; do
  for name in a b; do
    "$aureole" measure sobol halton random "$odd" -n 16,64,200 --seeds 4 -m l2-star,star -q --plot $name.$format >/dev/null || fail "--plot $name.$format"
  done
  cmp a.$format b.$format || fail "two $format of one figure differ"
  "$aureole" weights spherical-fibonacci -n 50 --lobe cosine -q --plot weights.$format -o weights.csv || fail "weights --plot weights.$format"
  "$aureole" points random -n 60 -q -o points.$format || fail "points -o points.$format"
done
"$aureole" points random -n 60 -q -o points.csv || fail "points"

# Sensors on a floor, of which a corner is left out: a cell each, the brightest and the darkest in the colours of the scale's ends.
for x in 1 2 3 4 5 6; do
  for z in 1 2 3 4 5; do [ $x = 6 ] && [ $z = 5 ] || echo "$((90 * x)) 1 $((90 * z)) 0 1 0"; done
done >floor.pts
for format in svg pdf png tex; do
  "$aureole" irradiance "$source/scenes/cornell-box/cornell-box.xml" -q -n 64 --sensors floor.pts --illuminance photopic --no-errors -o floor.csv \
    --plot floor.$format || fail "irradiance --plot floor.$format"
done
"$aureole" measure jittered -n 16 -m periodogram -q --plot power.svg --format csv >power.csv || fail "a periodogram"
# What is no letter is a question mark: controls, bytes that are no UTF-8, surrogates, too long forms.
bad=$(printf 'b\001\n\377\355\240\200\300\257e.csv')
cp "$odd" "$bad"
for format in svg pdf tex; do
  "$aureole" measure "$bad" -m star -q --plot bad.$format >/dev/null || fail "--plot bad.$format"
done
python3 "$here/plots.py" "$odd" || fail "what is in the figures"

# Other formats, before any work.
"$aureole" irradiance none.xml --sensors none.pts --plot floor.eps 2>message
[ $? -eq 2 ] && grep -q "must end in .svg, .pdf, .png or .tex" message || fail "a map in EPS: $(cat message)"
"$aureole" irradiance none.xml --sensors none.pts --weather none.epw --plot floor.svg 2>message
[ $? -eq 2 ] && grep -q -- "--plot cannot be used with --weather" message || fail "a map of a year: $(cat message)"
exit $((failures > 0))

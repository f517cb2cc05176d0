#!/usr/bin/env bash
# White convex bodies in a white environment (white_bodies.xml has the closed form), one for each material that loses no
# light. Means over 4 seeds within 12.9 standard errors (Student's t with 3 degrees of freedom, a chance of 1e-3 each) and
# a part in a thousand for what single scattering of rough facets and tables lose.
. "$(dirname "$0")/common.sh.inc"

for material in white both mirror glass pane plastic veil satin; do
  means=
  for seed in 1 2 3 4; do
    "$aureole" render "$source/tests/render/driver/white_bodies.xml" -q --seed $seed -D material=$material -o $material.pfm ||
      { fail "$material: render"; continue; }
    means="$means $(mean $material.pfm $material.pfm)"
  done
  echo "$means" | awk -v name="$material" '
    { for (i = 1; i <= NF; ++i) { sum += $i; squares += $i * $i }
      mean = sum / NF; variance = (squares - NF * mean * mean) / (NF - 1); if (variance < 0) variance = 0
      error = sqrt(variance / NF); off = mean - 1; allowed = 12.9 * error + 1e-3
      printf "%s: %.6f +- %.6f, off %+.6f, allowed %.6f\n", name, mean, error, off, allowed
      exit !(off <= allowed && off >= -allowed && NF == 4) }' || fail "$material"
done
exit $((failures > 0))

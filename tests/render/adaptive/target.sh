#!/usr/bin/env bash
# A render to a target error ends near its target, and its image has the error that it reports.
set -eu
aureole=$1 source=$2
scene=$source/scenes/cornell-box/cornell-box.xml
target=8 seeds=8
[ -z "${AUREOLE_SHORT_TESTS:-}" ] || seeds=2
for ((seed = 0; seed < seeds; ++seed)); do
  "$aureole" render "$scene" --width 48 --error $target% --integrator path --seed $seed -q --json -o out.pfm |
    sed -n 's/.*"error": \([^,]*\),.*"error_high": \([^,]*\),.*/\1 \2/p'
done >errors.txt
[ "$(wc -l <errors.txt)" = "$seeds" ] || { echo "errors: $(cat errors.txt)"; exit 1; }
# The upper end of every interval is below the target. Were its mean below .8 of it, renders would have half as many samples
# again as they need.
awk -v target=0.08 '{ sum += $2; if ($2 > target || $1 > $2) bad = 1 } END { print "mean of the upper ends:", sum / NR / target; exit bad || sum / NR < .8 * target }' errors.txt

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

# What the scene's integrator hides or limits, an image to a target hides and limits too; "false" and 0 are defaults.
lit() { # lit KEYS: a floor below a bright light source, which the camera sees
  cat <<END
<scene version='3.0.0'><integrator type='path'><integer name='max_depth' value='5'/>$1</integrator><sensor type='perspective'><transform
name='to_world'><lookat origin='0,-3,1' target='0,0,.5' up='0,0,1'/></transform><film type='hdrfilm'><integer name='width' value='24'/><integer
name='height' value='24'/></film></sensor><shape type='rectangle'/><shape type='rectangle'><transform name='to_world'><scale value='.4'/><rotate
x='1' angle='90'/><translate z='1' y='1'/></transform><emitter type='area'><rgb name='radiance' value='10'/></emitter></shape></scene>
END
}
agree() { # agree KEYS WORDS: with many samples by the scene's integrator, and names these keys
  lit "$1" >lit.xml
  "$aureole" render lit.xml --spp 1024 -q --no-cache -o many.exr
  "$aureole" render lit.xml --error 3% --error-measure mean --no-cache -v -o few.exr 2>said.txt
  grep -q "by $2\$" said.txt || { echo "not by $2: $(cat said.txt)"; exit 1; }
  "$aureole" compare many.exr few.exr --json | sed -n 's/.*"relative_rmse": *\([^,}]*\).*/\1/p' |
    awk '{ seen = 1; bad = $1 > .06 } END { exit !seen || bad }' || { echo "$1: another image"; exit 1; }
}
agree "<boolean name='hide_emitters' value='true'/>" path:max_depth=5,hide_emitters=true
agree "<float name='clamp' value='.5'/>" path:max_depth=5,clamp=.5
agree "<boolean name='hide_emitters' value='False'/><float name='clamp' value='0.0'/>" '[a-z]*:.*max_depth=5'
grep -q 'candidate gather-32: .* rays' said.txt || { echo "final gathering is left out: $(cat said.txt)"; exit 1; }
# Without mirrors light tracing has an image of its own, which path tracing does not have.
lit "<boolean name='specular_paths' value='False'/>" | sed "s/type='path'/type='ptracer'/" >traced.xml
if "$aureole" render traced.xml --error 3% --no-cache -o few.exr 2>said.txt; then echo "rendered with mirrors"; exit 1; fi
grep -q 'light paths cannot be spent pixel by pixel' said.txt || { cat said.txt; exit 1; }

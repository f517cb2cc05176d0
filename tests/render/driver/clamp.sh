#!/usr/bin/env bash
# --clamp reports what it takes away, in words and as JSON, with a number of samples and with a target.
. "$(dirname "$0")/common.sh.inc"
cat >lamp.xml <<'XML'
<scene version="3.0.0"><integrator type="path"/>
  <sensor type="perspective"><film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="16"/></film></sensor>
  <shape type="rectangle"><transform name="to_world"><scale value="4"/><rotate y="1" angle="180"/><translate z="6"/></transform></shape>
  <emitter type="point"><point name="position" z="4"/><rgb name="intensity" value="9"/></emitter></scene>
XML
"$aureole" render lamp.xml --spp 4 --clamp .2 --json -o limited.exr >limited.json 2>limited.said || fail "render: $(cat limited.said)"
part=$(tr ',{' '\n\n' <limited.json | sed -n 's/.*"clamped": *\([0-9.e-]*\).*/\1/p')
said=$(sed -n 's/.*--clamp removed \([0-9.e+-]*\) %.*/\1/p' limited.said)
awk -v part="$part" -v said="$said" 'BEGIN { exit !(part > 0 && said > 0 && (100 * part - said) ^ 2 <= (0.06 * said) ^ 2) }' ||
  fail "JSON has '$part', '$said' % are said: $(cat limited.said)"
"$aureole" render lamp.xml --spp 4 -o whole.exr 2>whole.said || fail "render"
mean_of() { "$aureole" compare whole.exr "$1" --format csv --channels R --tolerance inf | awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "mean_r") c = i } NR == 2 { print $c }'; }
awk -v part="$part" -v left="$(mean_of limited.exr)" -v whole="$(mean_of whole.exr)" \
  'BEGIN { d = part - (1 - left / whole); exit !(whole > 0 && d < 1e-4 && d > -1e-4) }' || fail "$part is not the light that is missing"
grep -q "removed" whole.said && fail "without a limit: $(cat whole.said)"
"$aureole" render lamp.xml --error 5% --clamp .2 --json -o target.exr >target.json 2>target.said || fail "target: $(cat target.said)"
grep -q -- "--clamp removed .* of the light" target.said || fail "$(cat target.said)"
awk -v part="$part" -v own="$(tr ',{' '\n\n' <target.json | sed -n 's/.*"clamped": *\([0-9.e-]*\).*/\1/p')" \
  'BEGIN { exit !(own > 0.9 * part && own < 1.1 * part) }' || fail "a target's image: $(cat target.json)"
exit $((failures > 0))

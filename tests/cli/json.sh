#!/usr/bin/env bash
# --json: every verb that prints results prints them as JSON, which a parser of its own reads.
set -u
aureole=$1
command -v python3 >/dev/null || { echo "skipped: no python3 to read JSON with"; exit 77; }
status=0
# json EXPRESSION ARGUMENT...: of what is printed, `it`, the expression is true.
count=0
json() {
  local true_of=$1
  shift
  count=$((count + 1))
  "$aureole" "$@" >"printed$count" 2>message </dev/null || { echo "FAILED: aureole $*: $(cat message)"; status=1; }
  printf 'printed%s\t%s\t%s\n' "$count" "$true_of" "$*" >>wanted
}
cat >scene.xml <<'XML'
<scene version="3.0.0"><sensor type="perspective"><film type="hdrfilm"><integer name="width" value="8"/>
<integer name="height" value="8"/></film></sensor><emitter type="constant"/>
<shape type="rectangle"><transform name="to_world"><translate z="-3"/></transform></shape></scene>
XML
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >mesh.obj
printf '0 0 0 0 0 1\n' >sensors
printf 'x,y,z\n0,0,1\n' >queries.csv
json 'len(it) > 20 and it[0]["set"] == "random"' sets --json
json 'it["points"][1] == [0.5, 0.5]' points sobol -n 2 --json
json 'it[0]["star"] == 0.4375' measure sobol -n 4 -m star --json
json 'any(row["name"] == "energy" for row in it)' measure --list --json
json 'len(it) == 1 and it[0]["point"] == 0' nearest spherical-fibonacci queries.csv -n 8 --json
json 'it' voronoi spherical-fibonacci -n 8 --json
json 'it' weights spherical-fibonacci -n 8 --domain sphere --method exact --report --json
json 'it[0]["samples"] == 128 and it[0]["output"] == "a.exr"' render scene.xml --spp 2 -o a.exr --json
json 'it[0]["error"] < .5 and it[0]["integrator"].startswith("path")' render scene.xml --integrator path --error 50% -q -o b.exr --json
# One set of keys, whatever was asked for; what is not known is null.
keys='list(it[0]) == ["output", "integrator", "error", "error_low", "error_high", "bias_high", "mean", "rounds", "samples_per_pixel", "samples", "rays", "prepare_seconds", "render_seconds", "cpu_seconds", "invalid_samples"]'
json "$keys and it[0]['error_low'] is None and it[0]['integrator'] == 'path' and it[0]['samples_per_pixel'] == 2" \
  render scene.xml --integrator path --spp 2 -q -o b.exr --json
json "$keys and it[0]['integrator'] and it[0]['error'] is None" render scene.xml --spp 1 -q -o b.exr --json
json "$keys and it[0]['rounds'] == 2" render scene.xml --rounds 2 -q -o b.exr --json
json "$keys" render scene.xml --error 60% -q -o b.exr --json
json 'it[0]["r"] > 3' irradiance scene.xml --sensors sensors -n 64 --json
json 'it' viewfactors mesh.obj --json
json 'it' compare a.exr b.exr --metric rmse --json
json 'len(it) >= 3' info a.exr --json
json 'len(it) > 40' lab list --json
json 'any(row["name"] == "finalgather" for row in it)' help integrators --json
json 'any(row["key"] == "photons" for row in it)' help integrator finalgather --json
json 'any(row["key"].endswith("--spp N") for row in it)' help verb render --json
"$aureole" render scene.xml --spp 1 -q -o - >piped.exr && cmp -s <("$aureole" render scene.xml --spp 1 -q -o c.exr && cat c.exr) piped.exr || {
  echo "FAILED: render -o - is not the picture"
  status=1
}
"$aureole" render scene.xml --spp 1 -q -o - --json >/dev/null 2>message
[ $? = 2 ] || { echo "FAILED: --json and -o -"; status=1; }
python3 - <<'PY' || status=1
import json
failed = False
for line in open("wanted"):
    name, expression, command = line.rstrip("\n").split("\t")
    with open(name) as file:
        text = file.read()
    try:
        it = json.loads(text)
        good = eval(expression)
    except (ValueError, KeyError, IndexError, TypeError) as wrong:
        good = print(wrong)
    if not good:
        print("FAILED: aureole %s: not %s: %s" % (command, expression, text[:300]))
        failed = True
raise SystemExit(failed)
PY
exit $status

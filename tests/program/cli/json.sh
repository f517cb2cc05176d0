#!/usr/bin/env bash
# --json: every command that prints results prints them as JSON, which a parser of its own reads.
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
keys='list(it[0]) == ["output", "integrator", "error", "error_low", "error_high", "bias_high", "relative_error", "relative_error_low", "relative_error_high", "mean_error", "mean_error_low", "mean_error_high", "display_error", "display_error_low", "display_error_high", "race", "mean", "rounds", "samples_per_pixel", "clamped", "samples", "rays", "prepare_seconds", "render_seconds", "cpu_seconds", "invalid_samples"]'
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
json 'any(row["key"].endswith("--samples N") for row in it)' help command render --json
# One schema a command: its options change values, which are null where they are not known, and no key.
"$aureole" weights sobol -n 8 --lobe cosine --lobe2 phong:5 --angles 2 --rotations 1 --table phong.wt -q && "$aureole" weights sobol -n 8 \
  --lobe ggx:.4 --angles 2 --rotations 1 --table ggx.wt -q || status=1
"$aureole" points sobol -n 8 -o points.csv && "$aureole" points sobol -n 8 -o points.npy || status=1
same() { # same NAME ARGUMENT...: keys as those of the other commands of that name
  local name=$1
  shift
  json 'keys' "$@" --json
  printf '%s\tprinted%s\t%s\n' "$name" "$count" "$*" >>alike
}
for options in "" "--method mis" "--method equal" "--method ratio" "--density optimal" "--lobe ggx:.3" "--unconstrained" \
  "--lobe cosine --lobe2 phong:5 --angle 60" "--domain sphere --method exact" "--domain sphere --method exact --degree 1" "--domain sphere --method voronoi"; do
  case $options in *mis*) options="$options --lobe2 phong:5 --angle 60" ;; esac
  # shellcheck disable=SC2086
  same "weights --report" weights sobol -n 16 --report $options
done
for options in "" "--group" "--rays-only" "--rays 64" "--both-sides"; do
  same viewfactors viewfactors mesh.obj -q $options
done
for options in "" "--matrix-free" "--sun 0,0,1" "--emission 1 --sky 0"; do
  same "viewfactors --radiosity" viewfactors mesh.obj -q --radiosity .5 $options
done
for options in "--spp 1" "--spp 4" "--rounds 2" "--rays 1e4" "--error 60%" "--time .1" "--spp 1 --integrator direct" "--spp 4 --crop 0,4,0,4"; do
  same render render scene.xml -q -o d.exr $options
done
for options in "" "--domain sphere" "--cap 40" "--domain axes"; do same voronoi voronoi spherical-fibonacci -n 9 $options; done
for options in "-k 1" "-k 3"; do same nearest nearest spherical-fibonacci queries.csv -n 8 $options; done
for options in "" "--reflected map --particles 1000" "--error 50%" "--max-depth 1" "--set sobol"; do
  same irradiance irradiance scene.xml --sensors sensors -n 64 -q $options
done
for options in "" "--tolerance 10"; do
  same compare compare a.exr b.exr --metric rmse $options
done
for file in phong.wt ggx.wt; do same "info of a table" info $file; done
for file in points.csv points.npy; do same "info of points" info $file; done
for file in a.exr b.exr; do same "info of a picture" info $file; done
for row in "integrator path" "bsdf diffuse" "shape sphere"; do same "help of a row" help $row; done
for kind in integrators bsdfs sets; do same "help of a kind" help $kind; done
for verb in render weights lab; do same "help of a command" help command $verb; done
"$aureole" render scene.xml --spp 1 -q -o - >piped.exr && cmp -s <("$aureole" render scene.xml --spp 1 -q -o c.exr && cat c.exr) piped.exr || {
  echo "FAILED: render -o - is not the image"
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
        keys = isinstance(it, list) and len(it) > 0 and all(list(row) == list(it[0]) for row in it)
        good = eval(expression)
    except (ValueError, KeyError, IndexError, TypeError) as wrong:
        good = print(wrong)
    if not good:
        print("FAILED: aureole %s: not %s: %s" % (command, expression, text[:300]))
        failed = True
first = {}
for line in open("alike"):
    name, file, command = line.rstrip("\n").split("\t")
    keys = list(json.load(open(file))[0])
    if keys != first.setdefault(name, keys):
        print("FAILED: aureole %s: keys %s, not %s" % (command, keys, first[name]))
        failed = True
raise SystemExit(failed)
PY
exit $status

#!/usr/bin/env bash
# SIGTERM stops whatever is being done in less than a second of CPU time, within media, between mirrors and while files are read.
set -euo pipefail
aureole=$1 scene=$2/scenes/cornell-box/cornell-box.xml
fail() { echo "$*" >&2; exit 1; }
rm -rf stops
mkdir stops
cd stops

# Seconds of CPU time that a process has taken, in hundredths.
spent() {
  local line
  line=$(cat "/proc/$1/stat" 2>/dev/null) || { echo 1000000; return; }
  # shellcheck disable=SC2086
  set -- ${line##*) }
  echo $((${12} + ${13}))
}

# ends_soon WHAT STATUS COMMAND...: after half a second of work SIGTERM ends it within a second of CPU time.
ends_soon() {
  local what=$1 wanted=$2 before last now status=0
  shift 2
  "$@" >/dev/null 2>said &
  while now=$(spent $!) && [ "$now" -lt 50 ]; do sleep 0.05; done
  [ "$now" -lt 1000000 ] || fail "$what ended before it was stopped: $(cat said)"
  before=$(spent $!)
  kill -TERM $!
  last=$before
  while kill -0 $! 2>/dev/null && now=$(spent $!) && [ "$now" -lt $((before + 1000)) ]; do last=$now; sleep 0.02; done
  kill -9 $! 2>/dev/null || true
  wait $! || status=$?
  [ $((last - before)) -lt ${AUREOLE_SHORT_TESTS:+5}100 ] || fail "$what works for $((last - before)) hundredths of a second after SIGTERM"
  [ "$status" = "$wanted" ] || fail "$what ends with $status, not $wanted: $(cat said)"
}
scene_of() { # INTEGRATOR INSIDE Z
  echo "<scene version='3.0.0'>$1<sensor type='perspective'><transform name='to_world'><lookat origin='0,0,${3:-.5}' target='0,.3,0' up='0,1,0'/></transform><film type='hdrfilm'><integer name='width' value='16'/><integer name='height' value='16'/></film></sensor><emitter type='point'><point name='position' x='0' y='.2' z='.1'/></emitter><emitter type='constant'/>$2</scene>"
}
# Within a medium whose largest value makes free paths shorter than floats can tell.
printf 'VOL\003\1\0\0\0\2\0\0\0\2\0\0\0\2\0\0\0\1\0\0\0\0\0\200\277\0\0\200\277\0\0\200\277\0\0\200\77\0\0\200\77\0\0\200\77' >hot.vol
printf '\354\170\255\140' >>hot.vol
head -c 28 /dev/zero >>hot.vol
scene_of "<integrator type='volpath'/>" "<shape type='cube'><bsdf type='null'/><medium type='heterogeneous' name='interior'><volume type='gridvolume' name='sigma_t'><string name='filename' value='hot.vol'/></volume></medium></shape>" 5 >hot.xml
ends_soon 'a hot voxel' 3 "$aureole" render hot.xml --spp 100000 -t 1 -q -o hot.exr
"$aureole" info hot.partial.exr >/dev/null || fail "no partial image of a medium"
# The same without a signal: rays end after 2^20 null collisions, which is said.
"$aureole" render hot.xml --width 8 --height 8 --spp 1 -o hot.exr 2>said || fail "a hot voxel: $(cat said)"
grep -q 'null collisions' said || fail "nothing said of a hot voxel: $(cat said)"
# Where the medium's paths are stopped in the middle, what goes on has the bits of a render that was never stopped.
sed "s|name='scale'||; s|<medium type='heterogeneous' name='interior'>|&<float name='scale' value='1e-16'/>|" hot.xml >warm.xml
"$aureole" render warm.xml --spp 12 -t 1 -q -o whole.exr
for _ in 1 2; do
  "$aureole" render warm.xml --spp 12 -t 1 -q -o again.exr --checkpoint kept --resume 2>/dev/null &
  sleep 0.2
  kill -TERM $! 2>/dev/null || true
  wait $! || true
done
"$aureole" render warm.xml --spp 12 -t 1 -q -o again.exr --checkpoint kept --resume
cmp whole.exr again.exr || fail "a medium's render that was stopped has other bits"
# Between mirrors that lose nothing.
for integrator in path volpath; do
  scene_of "<integrator type='$integrator'><integer name='rr_depth' value='1000000'/></integrator>" \
    "<shape type='cube'><bsdf type='twosided'><bsdf type='conductor'><string name='material' value='none'/></bsdf></bsdf></shape>" >mirrors.xml
  ends_soon "$integrator between mirrors" 3 "$aureole" render mirrors.xml --spp 4 -t 1 -q -o mirrors.exr
done
# While a large model is read, before there is anything to keep; and what keeps nothing ends at once.
awk 'BEGIN { for (i = 0; i < 400000; i++) { printf "v %d %d 0\nv %d 1 0\nv 0 1 %d\nf -1 -2 -3\n", i, i, i, i } }' >large.obj
scene_of "<integrator type='path'/>" "$(yes "<shape type='obj'><string name='filename' value='large.obj'/></shape>" | head -40)" >large.xml
ends_soon 'reading a large model' 3 "$aureole" render large.xml --spp 4 -t 1 -q -o large.exr
ends_soon 'exact weights' 143 "$aureole" weights spherical-fibonacci -n 1000000 --method exact -t 1 -q
ends_soon 'cells' 143 "$aureole" voronoi spherical-fibonacci -n 20000000 -t 1
ends_soon 'photons' 3 "$aureole" render "$scene" --integrator finalgather:photons=100000000 -t 1 -q -o photons.exr
ends_soon 'a solution' 3 "$aureole" render "$scene" --integrator radiosity --error .1% -t 1 -q -o solved.exr
ends_soon 'a measure' 3 "$aureole" measure spherical-fibonacci -n 1000000 -m energy -t 1 -q

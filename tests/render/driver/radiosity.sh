#!/usr/bin/env bash
# The integrator `radiosity` as a user meets it: Keller's four scenes, solutions that are saved, loaded and continued, a
# coloured mesh, the same bits for any number of threads, and what it says of bad input.
. "$(dirname "$0")/common.sh.inc"
scenes=$source/scenes/keller
small="--width 16 --height 12 --spp 4"
render() { "$aureole" render $small "$@"; }

# Analytic forms: 1/2 everywhere, no path lost, no surface on another, so nothing is warned of.
for scene in cube teapot-box office living-room corridor; do
  render "$scenes/$scene-analytic.xml" --integrator radiosity:bounces=29,paths=30000 -o "$scene.exr" 2>message.txt ||
    fail "$scene: $(cat message.txt)"
  grep -q warning message.txt && fail "$scene: $(cat message.txt)"
  got=$(mean "$scene.exr" "$scene.exr")
  awk -v m="$got" 'BEGIN { exit !(m > 0.47 && m < 0.53) }' || fail "$scene: the mean is $got, not 0.5"
done
# Realistic forms against path tracing, which knows nothing of triangles: the mean within 5 % (so few triangles
# have a bias of their own, and the noise of path is 2 %).
for scene in cube teapot-box office living-room; do
  render -q "$scenes/$scene.xml" --integrator radiosity:bounces=20,gather_samples=32,light_sampling=all --spp 8 -o "$scene.exr"
  render -q "$scenes/$scene.xml" --integrator path --sampler sobol --spp 1024 -o path.exr
  awk -v a="$(mean "$scene.exr" "$scene.exr")" -v b="$(mean path.exr path.exr)" 'BEGIN { exit !(a > 0.95 * b && a < 1.05 * b) }' ||
    fail "$scene: the mean is $(mean "$scene.exr" "$scene.exr"), path's is $(mean path.exr path.exr)"
done

office=$scenes/office.xml
for threads in 1 2 3; do
  render -q "$office" --integrator radiosity:paths=5000,randomizations=4,share_neighbours=true,save=s$threads -t $threads \
    -o t$threads.exr 2>message.txt || fail "threads: $(cat message.txt)"
  cmp s1 s$threads || fail "1 and $threads threads: the solutions differ"
  cmp t1.exr t$threads.exr || fail "1 and $threads threads: the pictures differ"
done
# A solution is seen again without a walk; continued it is what one walk makes.
render -q "$office" --integrator radiosity:load=s1,share_neighbours=true -o loaded.exr || fail "load"
cmp t1.exr loaded.exr || fail "a loaded solution looks different"
render -q "$office" --integrator radiosity:paths=12345,randomizations=4,save=whole -o whole.exr || fail "whole"
render -q "$office" --integrator radiosity:load=s1,paths=12345,save=continued,ply=office.ply -o continued.exr || fail "continue"
cmp whole continued || fail "a continued solution differs"
cmp whole.exr continued.exr || fail "a continued solution looks different"
head -c 4 office.ply | grep -q ply || fail "the mesh"

# Adaptive termination says so when it ends without converging.
render "$office" --integrator radiosity:epsilon=1e-9,paths=3000 -o out.exr 2>message.txt
grep -q "after 3000 paths the change is still .*not below epsilon 1e-09" message.txt || fail "epsilon: $(cat message.txt)"
render -q "$office" --integrator radiosity:epsilon=1e-2 -o out.exr 2>message.txt || fail "epsilon: $(cat message.txt)"

# expect STATUS PATTERN SCENE INTEGRATOR
expect() {
  rm -f out.exr
  render -q "$3" --integrator "$4" -o out.exr 2>message.txt
  local got=$?
  [ $got -eq "$1" ] || fail "$4: exit status $got, not $1: $(cat message.txt)"
  [ "$(wc -l <message.txt)" -eq 1 ] && grep -Eq "$2" message.txt || fail "$4: '$(cat message.txt)' does not say '$2'"
  [ ! -e out.exr ] || fail "$4: an output file is left"
}
expect 2 "has no 'path'; did you mean 'paths'" "$office" radiosity:path=3
expect 2 "paths.*at least 1|paths.*between 1" "$office" radiosity:paths=0
expect 2 "bounces" "$office" radiosity:bounces=0
expect 2 "has 2 dimensions, not 16" "$office" radiosity:sequence=jittered
expect 2 "at most|no more than" "$office" radiosity:sequence=lcg,paths=999999999999
expect 2 "sobbol.*sobol" "$office" radiosity:sequence=sobbol
expect 2 "no digits to scramble" "$office" radiosity:sequence=r2,randomizations=2
for key in scramble=owen interval=9; do expect 2 "has no '${key%=*}' any more: .*aureole-render/radiosity.h" "$office" "radiosity:$key"; done
for key in emission=area directions=cosine; do expect 2 "has no '${key%=*}' any more: 'walk=paper'" "$office" "radiosity:$key"; done
expect 2 "has no 'weights' any more: .*finalgather-lab" "$office" radiosity:weights=osw
expect 2 "cannot be continued" "$office" radiosity:sequence=hammersley,epsilon=1e-3
expect 2 "nowhere" "$office" radiosity:load=nowhere
expect 2 "not a radiosity solution" "$office" radiosity:load=t1.exr
expect 2 "made for another scene" "$scenes/cube.xml" radiosity:load=s1
expect 3 "no-folder/s: cannot write" "$office" radiosity:paths=100,save=no-folder/s
expect 2 "emitter .constant. is not a surface" "$source/tests/render/driver/sky.xml" radiosity
cp -r "$scenes" copy && sed '/<emitter/,/<\/emitter>/d' "$scenes/cube.xml" >copy/dark.xml
expect 2 "no light" copy/dark.xml radiosity
sed 's/1, 0.95, 0.85/nan, 1, 1/' "$scenes/cube.xml" >copy/nan.xml
expect 2 "nan.xml:[0-9]+:[0-9]+: .*radiance" copy/nan.xml radiosity
# A scene that somebody else wrote names no files.
for key in save load ply; do
  echo kept >victim
  sed "s|<scene version=\"3.0.0\">|&<integrator type=\"radiosity\"><string name=\"$key\" value=\"$PWD/victim\"/></integrator>|" \
    "$scenes/cube.xml" >copy/$key.xml
  grep -q victim copy/$key.xml || fail "no integrator in copy/$key.xml"
  render -q copy/$key.xml -o out.exr 2>message.txt
  [ $? -eq 2 ] && grep -Eq "$key.xml:[0-9]+:[0-9]+: .*must not name the file of '$key'" message.txt || fail "$key: $(cat message.txt)"
  [ "$(cat victim)" = kept ] || fail "a scene overwrote a file by '$key'"
done

# Scenes that can be rendered, with a warning.
warns() {
  render "$1" --integrator radiosity:paths=2000 -o out.exr 2>message.txt || fail "$1: $(cat message.txt)"
  grep -Eq "$2" message.txt || fail "$1: '$(cat message.txt)' does not say '$2'"
}
awk '/<shape/ { text = $0; next } text != "" { text = text "\n" $0; if (/<\/shape>/) { if (text !~ /wall-front/) print text; text = "" } next } { print }' \
  "$scenes/cube.xml" >copy/open.xml
warns copy/open.xml "paths \(.*%\) left the scene: it is open"
sed 's/0.8, 0.8, 0.8/1, 1, 1/' "$scenes/cube.xml" >copy/bright.xml
warns copy/bright.xml "bright.xml:[0-9]+:[0-9]+: .*albedo of 1"
exit $((failures > 0))

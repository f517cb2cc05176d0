#!/usr/bin/env bash
# Bad input to `aureole render`: one line on standard error that says where and what, the right exit status, and no
# output file.
. "$(dirname "$0")/common.sh.inc"
box=$source/scenes/cornell-box/cornell-box.xml
cp "$box" box.xml
mkdir -p meshes && cp "$source"/scenes/cornell-box/meshes/*.obj meshes/

# expect STATUS PATTERN ARGUMENTS...: `aureole render -o out.exr ARGUMENTS` fails so.
expect() {
  local status=$1 pattern=$2
  shift 2
  rm -f out.exr
  "$aureole" render -q --width 8 --height 8 --spp 1 -o out.exr "$@" 2>message.txt >output.txt
  local got=$?
  [ $got -eq "$status" ] || fail "$*: exit status $got, not $status: $(cat message.txt)"
  [ "$(wc -l <message.txt)" -eq 1 ] || fail "$*: not one line: $(cat message.txt)"
  grep -Eq "^aureole: .*$pattern" message.txt || fail "$*: '$(cat message.txt)' does not say '$pattern'"
  [ ! -e out.exr ] || fail "$*: an output file is left"
  compgen -G 'out.exr*' >/dev/null && fail "$*: something is left beside the output"
  [ ! -s output.txt ] || fail "$*: wrote to standard output"
}

# edit SED-SCRIPT: a copy of the box with one thing wrong.
edit() {
  sed "$1" box.xml >bad.xml
  cmp -s box.xml bad.xml && fail "the edit '$1' changes nothing"
}

expect 2 'nowhere.xml: cannot read' nowhere.xml
head -n 40 box.xml >bad.xml
expect 2 'bad.xml:[0-9]+:[0-9]+: ' bad.xml
edit 's/<integrator type/<intregator type/; s/<\/integrator>/<\/intregator>/'
expect 2 'bad.xml:[0-9]+:[0-9]+: .*intregator.*integrator' bad.xml
edit 's/type="twosided"/type="twosidde"/'
expect 2 "bad.xml:[0-9]+:[0-9]+: .*twosidde.*twosided" bad.xml
edit 's/name="reflectance"/name="reflectanse"/'
expect 2 "bad.xml:[0-9]+:[0-9]+: .*reflectanse.*reflectance" bad.xml
edit 's/name="fov" value="[^"]*"/name="fov" value="270"/'
expect 2 "bad.xml:[0-9]+:[0-9]+: .*fov.*270" bad.xml
edit 's/name="fov" value="[^"]*"/name="fov" value="nan"/'
expect 2 "bad.xml:[0-9]+:[0-9]+: .*fov" bad.xml
edit 's/\$max_depth/$max_dpth/'
expect 2 "bad.xml:[0-9]+:[0-9]+: .*max_dpth" bad.xml
edit 's/meshes\/tall-block.obj/meshes\/tall-blok.obj/'
expect 2 "tall-blok.obj" bad.xml
cp meshes/tall-block.obj meshes/good.obj
echo 'f 1 2 99' >>meshes/tall-block.obj
expect 2 'tall-block.obj:[0-9]+' box.xml
echo 'v 1 nan 2' >meshes/tall-block.obj
expect 2 'tall-block.obj:1' box.xml
cp meshes/good.obj meshes/tall-block.obj

expect 2 "unknown integrator 'pth'; did you mean 'path'" box.xml --integrator pth
expect 2 "has no 'photon'; did you mean 'photons'" box.xml --integrator finalgather:photon=9
# Keys that have moved: from the command, and from a scene with their place in it.
for key in map=lambert weights=oswa adaptive=true packets=false; do
  expect 2 "integrator 'finalgather' has no '${key%=*}' any more: it is a key of 'finalgather-lab'" box.xml --integrator "finalgather:$key"
done
edit 's/<integrator type="[^"]*">/<integrator type="finalgather"><string name="weights" value="osw"\/>/'
expect 2 "bad.xml:[0-9]+:[0-9]+: .*has no 'weights' any more: it is a key of 'finalgather-lab'" bad.xml
sed 's/type="finalgather"/type="finalgather-lab"/' bad.xml >lab.xml
"$aureole" info lab.xml >lab.txt || fail "the lab's integrator in a scene: $(cat lab.txt)"
for from in "lab.xml" "box.xml --integrator finalgather-lab:weights=osw"; do
  # shellcheck disable=SC2086
  "$aureole" render $from -q --width 8 --height 8 --spp 1 -o "${from%%.*}.exr" || fail "$from: render"
done
cmp lab.exr box.exr || fail "the lab's integrator has another image in a scene"
expect 2 "diffuse_samples.*at least 1|diffuse_samples.*between 1" box.xml --integrator finalgather:diffuse_samples=0
expect 2 "component.*one of all, diffuse, glossy" box.xml --integrator finalgather-lab:component=shiny
expect 2 "spherical-fibonaci.*spherical-fibonacci" box.xml --integrator finalgather:pattern=spherical-fibonaci
expect 2 "map|lambert" box.xml --integrator finalgather-lab:map=mercator
expect 2 "interleaved.*packets=false" box.xml --integrator path:interleaved=true,packets=false
expect 2 "rotate3d" box.xml --integrator finalgather-lab:scramble=rotate3d
expect 2 "sobl.*sobol" box.xml --sampler sobl
expect 2 "unknown filter 'bx'" box.xml --filter bx
expect 2 "crop" box.xml --crop 4,2,0,8
expect 2 "crop" box.xml --crop 0,99,0,8
expect 2 "samples" box.xml --spp 0
expect 2 "-D" box.xml -D nothing
expect 2 "no_such" box.xml -D no_such=1
expect 2 "unknown option" box.xml --photons
expect 2 "is given twice" box.xml box.xml
expect 2 "no scene given"

# A scene without light: no photon leaves.
edit '/<emitter/,/<\/emitter>/d'
expect 2 "no light" bad.xml --integrator finalgather

# More photons than memory: said before they are traced.
timeout 20 "$aureole" render -q --spp 1 box.xml -o out.exr --integrator finalgather:photons=1073741824 2>message.txt
[ $? -eq 3 ] && grep -q 'photons take up to .* GiB; this machine has' message.txt || fail "photons: $(cat message.txt)"

# Output that cannot be: another folder, a full disk (a limit on the size of files stands for it).
"$aureole" render -q --spp 1 box.xml -o no-such-folder/out.exr 2>message.txt
[ $? -eq 3 ] && grep -q 'no-such-folder/out.exr: cannot write' message.txt || fail "a folder that is not there: $(cat message.txt)"
"$aureole" render -q --spp 1 box.xml -o out.gif 2>message.txt
[ $? -eq 2 ] && grep -q 'expected exr, pfm, hdr, png or jpg' message.txt || fail "an unknown extension: $(cat message.txt)"
for kind in exr pfm png; do
  (trap '' XFSZ; ulimit -f 1; "$aureole" render -q --spp 1 --width 64 --height 64 --integrator path box.xml -o full.$kind 2>message.txt)
  [ $? -eq 3 ] && grep -q "full.$kind: cannot write" message.txt || fail "a full disk, $kind: $(cat message.txt)"
  compgen -G "full.$kind*" >/dev/null && fail "a full disk leaves $(ls full.$kind*)"
done
exit $((failures > 0))

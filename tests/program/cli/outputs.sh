#!/usr/bin/env bash
# Outputs: none replaces an input, another output or what is no checkpoint, by whatever name; what cannot be written leaves the file of
# before, and no image is lost with its checkpoint.
set -euo pipefail
aureole=$1 source=$2
fail() { echo "$*" >&2; exit 1; }
rm -rf outputs
mkdir outputs
cd outputs
export AUREOLE_CACHE=
box=$source/scenes/cornell-box
render="$aureole render $box/cornell-box.xml --width 16 -q"

# refuses WORDS STATUS COMMAND...: ends so, with these words on standard error.
refuses() {
  local words=$1 wanted=$2 status=0
  shift 2
  "$@" >printed 2>said || status=$?
  [ "$status" = "$wanted" ] || fail "'$*' ends with $status, not $wanted: $(cat said)"
  grep -q -e "$words" said || fail "'$*' says: $(cat said)"
}
# keeps FILE ENDING COMMAND...: the command, whose output stands as @, refuses to write FILE by any of its names.
keeps() {
  local file=$1 ending=$2 name
  shift 2
  rm -rf names
  mkdir -p names/deep
  ln "$file" "names/hard$ending"
  ln -s "../$file" "names/soft$ending"
  ln -s "soft$ending" "names/twice$ending"
  ln -s ../.. names/deep/up
  cp -p "$file" before
  for name in "$file" "./$file" "$PWD/$file" "names/deep/up/$file" "names/hard$ending" "names/soft$ending" "names/twice$ending"; do
    [ "${name%"$ending"}" != "$name" ] || continue
    refuses 'must not be' 2 "${@//@/$name}"
    cmp -s "$file" before || fail "'${*//@/$name}' has changed its input"
  done
  [ -z "$(find . -name '.aureole-*')" ] || fail "left behind: $(find . -name '.aureole-*')"
}

$render --spp 1 -o a.exr
cp a.exr b.exr
$render --spp 1 --shard 1/2 -o one.exr
$render --spp 1 --shard 2/2 -o two.exr
"$aureole" points spherical-fibonacci -n 64 -o p.csv
cat >textured.xml <<'XML'
<scene version="3.0.0"><include filename="more.exr"/><integrator type="path"/><sensor type="perspective"><film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/></film></sensor><emitter type="envmap"><string name="filename" value="a.exr"/></emitter>
<shape type="sphere"><transform name="to_world"><translate z="4"/></transform></shape>
<shape type="obj"><string name="filename" value="mesh.exr"/></shape></scene>
XML
echo '<scene version="3.0.0"/>' >more.exr
printf 'v 0 0 5\nv 1 0 5\nv 0 1 5\nf 1 2 3\n' >mesh.exr
cp mesh.exr mesh.obj
printf 'x,y,z,nx,ny,nz\n0,0,0,0,0,1\n' >sensors.csv

keeps a.exr .exr "$aureole" convert a.exr @
keeps a.exr .exr "$aureole" view b.exr a.exr -o @
keeps a.exr .exr "$aureole" compare a.exr b.exr -o @
keeps b.exr .exr "$aureole" compare a.exr b.exr --html @
keeps two.exr .exr "$aureole" merge one.exr two.exr -o @
keeps a.exr .exr "$aureole" render textured.xml --spp 1 -q -o @
keeps more.exr .exr "$aureole" render textured.xml --spp 1 -q -o @
keeps mesh.exr .exr "$aureole" render textured.xml --error 50% -q -o @
keeps textured.xml '' "$aureole" render textured.xml --spp 1 -q -o b.exr --reference a.exr --errors @
keeps a.exr '' "$aureole" render textured.xml --spp 1 -q -o b.exr --reference a.exr --errors @
keeps sensors.csv .csv "$aureole" irradiance textured.xml --sensors sensors.csv -n 16 -q -o @
keeps more.exr '' "$aureole" irradiance textured.xml --sensors sensors.csv -n 16 -q --to csv -o @
keeps mesh.obj '' "$aureole" viewfactors mesh.obj --rays 1024 -q --to csv -o @
keeps p.csv .csv "$aureole" points file:p.csv -o @
keeps a.exr '' "$aureole" points sobol -n 16 --warp a.exr --format csv -o @
keeps p.csv .csv "$aureole" weights p.csv -q -o @
keeps p.csv '' "$aureole" weights p.csv --method oswa --lobe cosine --lobe2 phong:10 -q --table @
keeps p.csv .csv "$aureole" voronoi p.csv --cells @
keeps p.csv .svg "$aureole" measure p.csv -m energy -q --plot @
keeps p.csv .svg "$aureole" weights p.csv -q --plot @
refuses 'must not be' 2 "$aureole" convert - a.exr <a.exr
# What a renderer writes by itself is an output too.
refuses 'must not be' 2 $render --integrator radiosity:ply=$PWD/mesh.exr --spp 1 -o c.exr -D unused=1 --checkpoint c.exr
# Two outputs, whether there is a file already or not.
refuses 'the same file' 2 "$aureole" compare a.exr b.exr -o d.png --html ./d.png
refuses 'the same file' 2 $render --spp 1 -o new.exr --checkpoint "$PWD/new.exr"
[ ! -e new.exr ] || fail "two outputs in one file have left it"
# A name that is taken by no input may be an output again and again.
for _ in 1 2; do "$aureole" points sobol -n 4 -o sobol; done

# A checkpoint replaces only a checkpoint, and is seen before the work begins.
echo precious >notes
mkfifo fifo
mkdir folder
cp "$box/cornell-box.xml" scene.xml
for name in notes scene.xml fifo folder a.exr; do refuses 'another kind of file' 2 timeout 20 $render --spp 100000 -o c.exr --checkpoint "$name"; done
[ "$(cat notes)" = precious ] && cmp -s scene.xml "$box/cornell-box.xml" || fail "a checkpoint replaced another file"
: >empty
for name in empty fresh; do for _ in 1 2; do $render --spp 1 -o c.exr --checkpoint $name || fail "no checkpoint in '$name'"; done; done

# A checkpoint that cannot be written costs a warning, once, and no image. Files of more than 4 kB cannot be written here.
small() { (ulimit -f 4; "$@"); }
for what in '--spp 4' '--error 50%' '--time .3s' '--rays 100000'; do
  rm -f c.exr kept
  # shellcheck disable=SC2086
  small $render $what -o c.exr --checkpoint kept --checkpoint-every .01s 2>said || fail "$what with a full checkpoint disk: $? $(cat said)"
  "$aureole" info c.exr >/dev/null || fail "$what: no image"
  [ "$(grep -c 'no checkpoint' said)" = 1 ] || fail "$what: not one warning: $(cat said)"
  [ ! -e kept ] || fail "$what: a checkpoint was cut"
done
(ulimit -f 4; exec $render --spp 1000000 -o c.exr --checkpoint kept --checkpoint-every .01s 2>said) &
sleep 1
kill -TERM $!
status=0
wait $! || status=$?
[ $status = 3 ] && "$aureole" info c.partial.exr >/dev/null || fail "SIGTERM with a full checkpoint disk: $status $(cat said)"
# An image that cannot be written does not take the checkpoint with it.
rm -f kept
ln -s /dev/full full.exr
refuses 'cannot write' 3 $render --spp 4 -o full.exr --checkpoint kept
$render --spp 4 -o d.exr --checkpoint kept --resume && $render --spp 4 -o e.exr && cmp d.exr e.exr || fail "the checkpoint was lost with the image"

# Other writers on such a disk: words, status 3, the file of before, and no folder left behind.
"$aureole" points sobol -n 1000 -o many.csv
echo old >old.csv
refuses 'File too large' 3 small "$aureole" points sobol -n 1000 -o old.csv
refuses 'File too large' 3 small "$aureole" manual -o pages
[ "$(cat old.csv)" = old ] || fail "a file was cut"
mkdir tmp
TMPDIR=$PWD/tmp refuses 'File too large' 3 small "$aureole" view a.exr b.exr
[ -z "$(ls -A tmp)" ] || fail "view left $(ls -A tmp)"
for ending in svg pdf png tex; do
  echo old >p.$ending
  refuses 'File too large' 3 small "$aureole" measure sobol halton random -n 4:4096 -m l2-star,min-distance -q --plot p.$ending
  [ "$(cat p.$ending)" = old ] || fail "a plot was cut: p.$ending"
  "$aureole" measure sobol -n 4:64 -m l2-star -q --plot p.$ending >/dev/null && [ "$(wc -c <p.$ending)" -gt 1000 ] || fail "no plot p.$ending"
done
ln -sf ../outputs/new.svg link.svg
"$aureole" measure sobol -n 4:64 -m l2-star -q --plot link.svg >/dev/null
[ -L link.svg ] && grep -q '</svg>' new.svg || fail "a plot replaced a link"
# Where a link points to no file yet, that file is made whole or not at all.
ln -s later.csv dangling.csv
refuses 'File too large' 3 small "$aureole" points sobol -n 1000 -o dangling.csv
[ ! -e later.csv ] || fail "a cut file behind a link"
"$aureole" points sobol -n 1000 -o dangling.csv
[ -L dangling.csv ] && cmp later.csv many.csv || fail "a link was replaced"
[ -z "$(find . -name '.aureole-*' -o -name '*.tmp*' -type f)" ] || fail "left behind: $(find . -name '.aureole-*' -o -name '*.tmp*')"

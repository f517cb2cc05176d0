#!/usr/bin/env bash
# Limits that a service sets: memory, time, files outside of the scene's folder; and what a full disk leaves.
set -euo pipefail
aureole=$1 source=$2
fail() { echo "$*" >&2; exit 1; }
rm -rf limits
mkdir limits
cd limits
cp -r "$source/scenes/cornell-box" box
scene=box/cornell-box.xml

refuses() { # WORDS STATUS COMMAND...
  local words=$1 wanted=$2 status=0
  shift 2
  "$@" >/dev/null 2>said || status=$?
  [ "$status" = "$wanted" ] || fail "'$*' ends with $status, not $wanted: $(cat said)"
  grep -q -e "$words" said || fail "'$*' says: $(cat said)"
}

# A confined scene is read within its folder, however a file is named.
mkdir outside
cp box/meshes/red-wall.obj outside/
for way in ../outside/red-wall.obj "$PWD/outside/red-wall.obj" link.obj folder/red-wall.obj; do
  sed "s|meshes/red-wall.obj|$way|" $scene >box/escapes.xml
  ln -sf ../outside/red-wall.obj box/link.obj
  ln -sfn ../outside box/folder
  "$aureole" info box/escapes.xml >/dev/null || fail "$way is not found"
  refuses 'lies outside of the scene' 2 "$aureole" info --confine box/escapes.xml
  refuses 'lies outside of the scene' 2 "$aureole" render --confine box/escapes.xml -o no.exr
done
sed 's|<scene version="\(.*\)">|<scene version="\1"><include filename="../outside/more.xml"/>|' $scene >box/escapes.xml
echo '<scene version="3.0.0"/>' >outside/more.xml
refuses 'lies outside of the scene' 2 "$aureole" info --confine box/escapes.xml
"$aureole" info --confine $scene >/dev/null || fail "a scene in its own folder is refused"
(cd box && "$aureole" info --confine cornell-box.xml >/dev/null) || fail "a scene in the working folder is refused"
[ ! -e no.exr ] || fail "a refused scene left an image"

# Time: the program ends, with words; an earlier image stays.
echo old >p.exr
refuses 'stopped by --time-limit' 3 "$aureole" render $scene --spp 1000000 -o p.exr -q --time-limit .5s
[ "$(cat p.exr)" = old ] || fail "a render that was out of time replaced the image"
refuses 'expected a time such as' 2 "$aureole" render $scene --time-limit soon
refuses 'expected a size in bytes' 2 "$aureole" render $scene --memory-limit much

# Every command has both limits.
verbs=$("$aureole" help | awk 'NR > 2 && NF == 0 { exit } /^  [a-z]/ { print $1 }')
[ "$(wc -w <<<"$verbs")" -ge 18 ] || fail "the list of commands has another form: $verbs"
for verb in $verbs; do
  refuses 'expected a time such as' 2 "$aureole" "$verb" --time-limit soon
  refuses 'expected a size in bytes' 2 "$aureole" "$verb" --memory-limit much
done
if [ "$(nm "$aureole" 2>/dev/null | grep -c __asan_init)" = 0 ]; then
  refuses 'stopped by --time-limit' 3 "$aureole" voronoi spherical-fibonacci -n 20000000 --time-limit .3s
  refuses 'stopped by --time-limit' 3 "$aureole" points electrostatic -n 16384 --time-limit .3s --no-cache
  refuses 'memory' 3 "$aureole" points sobol -n 100000000 --memory-limit 500M
  refuses 'memory' 3 "$aureole" voronoi spherical-fibonacci -n 100000000 --memory-limit 500M
fi
# They hold where a parent has blocked or ignored the signals, as services with signalfd do.
refuses 'stopped by --time-limit' 3 env --block-signal --ignore-signal=ALRM timeout -s KILL 20 "$aureole" render $scene --spp 1000000 -o p.exr -q --time-limit .5s
for how in --block-signal --ignore-signal=TERM; do
  for seconds in 1 4 16 64; do # slow machines have nothing to keep after a second
    env $how "$aureole" render $scene --spp 1000000 -o stopped.exr -q 2>said &
    sleep $seconds
    kill -TERM $!
    status=0
    wait $! || status=$?
    grep -q 'before the first result' said || break
  done
  [ $status = 3 ] && [ -e stopped.partial.exr ] || fail "SIGTERM with $how: $status $(cat said)"
  rm -f stopped.partial.exr
done

# What is no file is no input, and is not waited for; what the shell hands over is.
mkfifo fifo
sed "s|meshes/red-wall.obj|../fifo|" $scene >box/fifo.xml
sed "s|meshes/red-wall.obj|/dev/zero|" $scene >box/device.xml
for command in 'info fifo' 'convert fifo out.exr' 'points file:fifo' 'measure file:fifo -m energy' 'info box/fifo.xml' 'render fifo -o out.exr' 'merge fifo -o out.exr' \
  'irradiance box/cornell-box.xml --sensors fifo' 'viewfactors fifo' 'render box/cornell-box.xml --checkpoint fifo --resume -o out.exr'; do
  # shellcheck disable=SC2086
  refuses 'pipe\|not a regular file\|another kind of file\|unknown\|fifo' 2 timeout -s KILL 20 "$aureole" $command
done
for command in 'info /dev/zero' 'convert /dev/zero out.exr' 'info box/device.xml' 'points file:/dev/zero'; do
  # shellcheck disable=SC2086
  refuses 'device\|not a regular file' 2 timeout -s KILL 20 "$aureole" $command
done
"$aureole" points sobol -n 8 -o eight.csv
"$aureole" measure <(cat eight.csv) -m l2-star --format csv 2>/dev/null | cut -d, -f2- | cmp -s - <("$aureole" measure eight.csv -m l2-star --format csv | cut -d, -f2-) || fail "a process substitution is refused"
# Nor is what stands in the place of an entry of the cache.
mkdir cache
AUREOLE_CACHE=$PWD/cache "$aureole" points bnot -n 64 -o first.csv
entry=$(ls cache/*.aureole)
for what in 'mkfifo' 'mkdir' 'ln -s /dev/zero' 'ln -s nowhere'; do
  rm -rf "$entry"
  $what "$entry"
  AUREOLE_CACHE=$PWD/cache timeout -s KILL 20 "$aureole" points bnot -n 64 -o again.csv || fail "'$what' in the cache: $?"
  cmp first.csv again.csv || fail "'$what' in the cache makes other points"
done

# A material or phase function that names another one twice, in a chain, is refused before it is asked 2^40 times.
for kind in bsdf:blendbsdf:diffuse phase:blendphase:isotropic; do
  IFS=: read -r tag blend leaf <<<"$kind"
  for depth in 8 40; do
    { echo '<scene version="3.0.0"><integrator type="volpath"/><sensor type="perspective"><film type="hdrfilm"><integer name="width" value="8"/><integer name="height" value="8"/></film></sensor><emitter type="constant"/>'
      for ((i = 0; i < depth; ++i)); do echo "<$tag type='$blend' id='b$i'><float name='weight' value='.5'/><ref id='b$((i + 1))'/><ref id='b$((i + 1))'/></$tag>"; done
      echo "<$tag type='$leaf' id='b$depth'/><shape type='sphere'><transform name='to_world'><translate z='4'/></transform>"
      if [ $tag = bsdf ]; then echo '<ref id="b0"/>'; else echo '<bsdf type="null"/><medium type="homogeneous" name="interior"><ref id="b0"/></medium>'; fi
      echo '</shape></scene>'; } >chain.xml
    if [ $depth = 8 ]; then
      "$aureole" render chain.xml --spp 1 -q -o chain.exr || fail "a short chain of $blend is refused"
    else
      refuses 'as often as they are named' 2 timeout -s KILL 20 "$aureole" render chain.xml --spp 1 -q -o chain.exr
    fi
  done
done

# Memory. Sanitizers reserve far more addresses than this.
if [ "$(nm "$aureole" 2>/dev/null | grep -c __asan_init)" = 0 ]; then
  refuses 'out of memory' 3 "$aureole" render $scene --width 16000 --height 16000 --spp 1 -t 2 -o p.exr -q --memory-limit 1G
  "$aureole" render $scene --width 16 --height 16 --spp 1 -t 2 -o small.exr -q --memory-limit 4G || fail "4 GB are too little"
fi

# A full disk: an error, and the file of before is whole. Needs the right to mount.
mkdir disk
if mount -t tmpfs -o size=256k none disk 2>/dev/null; then
  trap 'umount disk' EXIT
  echo old >disk/p.exr
  "$aureole" render $scene --width 32 --height 32 --spp 1 -o p2.exr --checkpoint disk/kept -q
  cp disk/kept kept
  refuses 'No space left' 3 "$aureole" render $scene --width 256 --height 256 --spp 1 -o disk/p.exr -q
  [ "$(cat disk/p.exr)" = old ] || fail "a full disk spoilt the image"
  rm p2.exr
  refuses 'no checkpoint: .*No space left' 0 "$aureole" render $scene --width 128 --height 128 --spp 1 -o p2.exr --checkpoint disk/kept -q
  cmp disk/kept kept && [ -e p2.exr ] || fail "a full disk spoilt the checkpoint, or the image"
  [ "$(ls -A disk | tr '\n' ' ')" = 'kept p.exr ' ] || fail "left on the full disk: $(ls -A disk)"
fi

# One process of a job of several is one rank; ranks.sh has several.
env OMPI_COMM_WORLD_SIZE=1 "$aureole" --version >/dev/null || fail "one rank is refused"

#!/usr/bin/env bash
# `aureole render` to an error: what it says, the same image on any number of threads and again by rounds, wishes that
# cannot be, and what an interrupt leaves.
set -euo pipefail
aureole=$1
scene=$2/scenes/cornell-box/cornell-box.xml
small=(--width 48 --height 32 --filter box)
larger=(--width 96 --height 72 --filter box)
fail() { echo "$*" >&2; exit 1; }

# The error that is said is not above the one that was asked, and the last line names the image.
"$aureole" render "$scene" "${small[@]}" --error 20% --error-measure mean --error-map -o a.exr -t 1 2> said
grep -Eq '^aureole: a.exr has an error of [0-9.]+ % of the image mean \(mean\), between [0-9.]+ and [0-9.]+ \(95 %\), (of which at most [0-9.]+ % are bias, )?after.* by [a-z]+' said ||
  fail "no line about the error: $(cat said)"
high=$(sed -n 's/.* and \([0-9.]*\) (95 %).*/\1/p' said)
awk -v high="$high" 'BEGIN { exit !(high <= 20) }' || fail "asked for 20 %, got up to $high %"
"$aureole" info a.exr | grep -q 'error.B' || fail "the error map's channels are missing"
"$aureole" render "$scene" "${small[@]}" --error 20% --error-measure mean --error-map -o b.exr -t 3 -q 2> quiet
cmp a.exr b.exr || fail "threads changed the image"
[ ! -s quiet ] || fail "-q says something: $(cat quiet)"

# Gone on with after an interrupt, the image is the same, whichever integrator was found to be the better one.
"$aureole" render "$scene" "${larger[@]}" --error 4% --error-measure mean -o whole.exr -v 2> said
[ "$(grep -c '^aureole: candidate [a-z0-9-]*: .* rays for [0-9]* pixels, needs .*: .' said)" = 7 ] || fail "no candidates: $(cat said)"
[ "$(grep -c '^aureole: candidate gather-[a-z0-9-]*: .*: taken$' said)" = 1 ] || fail "which candidate was taken: $(cat said)"
[ "$(grep -c '^aureole: its error is .* (95 %)$' said)" = 3 ] || fail "not all measures: $(cat said)"
grep -q 'by finalgather' said || fail "the better integrator: $(cat said)"
for pause in .3 .6 1 2; do
  timeout -s INT $pause "$aureole" render "$scene" "${larger[@]}" --error 4% --error-measure mean -o again.exr -q --checkpoint c --resume \
    2> stopped || true
  [ -e again.exr ] && break
done
"$aureole" render "$scene" "${larger[@]}" --error 4% --error-measure mean -o again.exr -q --checkpoint c --resume 2> stopped || fail "$(cat stopped)"
cmp whole.exr again.exr || fail "an interrupt changed the image"

# Final gathering shares patterns among few samples, for nobody knows how many there will be; it needed gigabytes once.
gather=finalgather:photons=5000,edges=0,debias=true
limit=4000000 # KiB; sanitizers reserve terabytes, and are not limited
(ulimit -v $limit; "$aureole" sets) > sets 2>&1 || limit=unlimited
(ulimit -v $limit; "$aureole" render "$scene" "${small[@]}" --integrator $gather --rays 2e6 -o g.exr -t 1 -q) || fail "$gather"
"$aureole" render "$scene" "${small[@]}" --integrator $gather,split=8 --rays 2e6 -o h.exr -t 3 -q
cmp g.exr h.exr || fail "threads changed the image, or the split is another one"

# So does the lab's integrator.
(ulimit -v $limit; "$aureole" render "$scene" "${small[@]}" --integrator finalgather-lab:${gather#*:} --rays 2e6 -o i.exr -t 2 -q) || fail "finalgather-lab"
cmp g.exr i.exr || fail "the lab's integrator has another image"

# An image that was chosen, or that a clock has ended, is made again by the command that is said.
again() { # OPTION...
  "$aureole" render "$scene" "$@" -o c.exr 2> said
  local command
  command=$(sed -n 's/^aureole: to reproduce this image: //p' said)
  [ -n "$command" ] || fail "no command that makes '$*' again: $(cat said)"
  eval "\"\$aureole\" render \"\$scene\" --width $2 --height $4 --filter box $command -o d.exr -t 3" 2> repeated
  cmp c.exr d.exr || fail "$command makes another picture than $*"
  [ "$(sed -n 's/^aureole: to reproduce this image: //p' repeated)" = "$command" ] ||
    fail "$command says another command: $(cat repeated)"
}
again "${small[@]}" --time .1s
again "${small[@]}" --rays 1e6
again "${larger[@]}" --error 4% --error-measure mean
grep -q -- "--integrator 'finalgather.* --error .* --error-measure mean --bias " said || fail "the command of a choice: $(cat said)"

# A dark scene says so.
printf '%s\n' '<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><film type="hdrfilm">' \
  '<integer name="width" value="16"/><integer name="height" value="16"/></film></sensor><shape type="sphere"/></scene>' > dark.xml
"$aureole" render dark.xml --error 1% -o dark.exr 2> said
grep -q 'samples per pixel met light (--camera, --environment)' said || fail "a dark scene: $(cat said)"
grep -q clip said && fail "a dark scene that nothing clips: $(cat said)"

# So does one whose surfaces lie beyond far_clip, or before near_clip, and why.
for clip in far_clip near_clip; do
  radius=1e5
  [ $clip = near_clip ] && radius=1e-3
  printf '%s\n' '<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><film type="hdrfilm">' \
    '<integer name="width" value="16"/><integer name="height" value="16"/></film></sensor><shape type="sphere">' \
    "<float name=\"radius\" value=\"$radius\"/><emitter type=\"area\"/><boolean name=\"flip_normals\" value=\"true\"/></shape></scene>" > clip.xml
  for wish in "--spp 4" "--error 1%"; do
    "$aureole" render clip.xml $wish -o clip.exr 2> said
    grep -q "1024 of 1024 camera rays .* $clip" said || fail "$clip, $wish: $(cat said)"
  done
done

# Of half of the image, where the others see nothing.
printf '%s\n' '<scene version="3.0.0"><integrator type="path"/><sensor type="perspective"><film type="hdrfilm">' \
  '<integer name="width" value="16"/><integer name="height" value="16"/></film></sensor><shape type="rectangle"><transform name="to_world">' \
  '<rotate y="1" angle="180"/><scale value="1e6"/><translate x="1e6" z="2e5"/></transform><emitter type="area"/></shape></scene>' > clip.xml
"$aureole" render clip.xml --spp 4 -o clip.exr 2> said
grep -q "512 of 1024 camera rays end at far_clip" said || fail "half of the image: $(cat said)"

refuses() { # WORDS OPTION...
  local words=$1 status=0
  shift
  "$aureole" render "$scene" -o no.exr "$@" 2> said || status=$?
  [ "$status" = 2 ] || fail "'$*' ends with $status, not 2"
  grep -q -e "$words" said || fail "'$*' says: $(cat said)"
  [ ! -e no.exr ] || fail "'$*' left a picture"
}
refuses "expected 1% or .01, from above 0 to 100%, not 'abc'" --error abc
refuses "from above 0 to 100%, not '0'" --error 0
refuses "not '200%'" --error 200%
refuses "expected a time such as 30s, 5min or 1h, not '-3s'" --time -3s
refuses "5min or 1h, not '3x'" --time 3x
refuses "expected a number such as 1e9, not 'many'" --rays many
refuses "--bias: expected 1% or .01, from above 0 to 100%, not '0'" --error 1% --integrator path --bias 0
refuses "below the target error" --error 1% --integrator path --bias 2%
refuses "needs a named integrator" --error 1% --bias .5%
refuses "--samples' cannot be used with" --error 1% --spp 4
refuses "--error-map' needs" --error-map

# An interrupt leaves what there is beside the previous image, with and without a target. There is something once a checkpoint is
# written: the choice of an integrator leaves nothing.
for wish in "--error .01%" "--spp 5000"; do
  echo old > e.exr
  rm -f e.partial.exr kept
  # shellcheck disable=SC2086
  "$aureole" render "$scene" --width 96 --height 96 $wish -o e.exr -q --checkpoint kept --checkpoint-every .1s 2> said &
  for _ in $(seq 600); do [ -e kept ] && break; sleep 0.1; done
  kill -INT $!
  status=0
  wait $! || status=$?
  [ "$status" = 3 ] || fail "interrupted '$wish' ends with $status, not 3"
  [ "$(cat e.exr)" = old ] || fail "interrupted '$wish' replaced the picture"
  "$aureole" info e.partial.exr > /dev/null || fail "interrupted '$wish' left no partial picture: $(cat said)"
done

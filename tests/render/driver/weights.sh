#!/usr/bin/env bash
# Weights in the image: under constant light optimal and scaled weights are exact at every angle, the others close; nothing
# depends on threads; what cannot be is refused.
. "$(dirname "$0")/common.sh.inc"
scene=$source/tests/render/driver/weights.xml
fixed=direct=gather,incident=emitters,pixel=centre,edges=0

# render NAME KEYS [options]
render() {
  local name=$1 keys=$2
  shift 2
  "$aureole" render "$scene" -q --spp 1 -o "$name.exr" --integrator "finalgather-lab:$fixed,$keys" "$@" || fail "$name: render"
}

# The lobe's visible part by very many directions, whose error is 2e-4 at most.
for exponent in 20 150; do
  many=$(either 256 16384)
  render truth weights=ratio,clip=false,diffuse_samples=$many,glossy_samples=$many -D exponent=$exponent
  # name, keys, the relative RMSE that is allowed
  while read -r name limit keys; do
    render "$name" "diffuse_samples=40,glossy_samples=20,$keys" -D exponent=$exponent
    off=$(figure relative_rmse truth.exr "$name.exr")
    judge -v off="$off" -v limit="$limit" 'BEGIN { exit !(off < limit) }' || fail "$name, m $exponent: off by $off, not $limit"
  done <<'CASES'
oswa 3e-4 weights=oswa
oswa-random 3e-4 weights=oswa,decorrelation=random
oswa-sobol 3e-4 weights=oswa,pattern=sobol,rotations=5,decorrelation=random
oswa-same 3e-4 weights=oswa,density=same
osw 3e-4 weights=osw
osw-digit 3e-4 weights=osw,pattern=sobol
equal 3e-4 weights=equal
mis 3e-2 weights=mis
solve 3e-2 weights=oswa-solve
unclipped 6e-2 weights=oswa,clip=false
CASES
done

# A pixel's directions are shared out among its samples, whose angles hardly differ; threads and lone rays change nothing.
render shared weights=oswa,diffuse_samples=40,glossy_samples=20 --spp 4
off=$(figure relative_rmse truth.exr shared.exr)
render shared weights=oswa,diffuse_samples=40,glossy_samples=20 --spp 4 -D exponent=150
off=$(figure relative_rmse truth.exr shared.exr)
judge -v off="$off" 'BEGIN { exit !(off < 1e-3) }' || fail "shares of four samples: off by $off"

box=$source/scenes/cornell-box/glossy.xml
for weights in oswa mis osw; do
  for threads in 1 3; do
    "$aureole" render "$box" -q --width 40 --height 24 --spp 2 -t $threads -o t$threads.exr --integrator \
      "finalgather-lab:photons=20000,diffuse_samples=20,glossy_samples=10,weights=$weights" || fail "$weights: $threads threads"
  done
  cmp t1.exr t3.exr || fail "$weights: threads change the picture"
  "$aureole" render "$box" -q --width 40 --height 24 --spp 2 -o lone.exr --integrator \
    "finalgather-lab:photons=20000,diffuse_samples=20,glossy_samples=10,weights=$weights,packets=false" || fail "$weights: lone"
  cmp t1.exr lone.exr || fail "$weights: lone rays change the picture"
done

# Diffuse places go in the packets of glossy ones near them: what the eye sees of the red wall, whose groups of pixels reach
# the glossy back wall, is to rounding what it is by itself
# (without paths, whose chance differs).
for weights in osw oswa; do
  "$aureole" render "$box" -q --width 48 --height 48 --crop 0,8,16,32 --spp 2 -o wall-$weights.exr --integrator \
    "finalgather-lab:photons=20000,diffuse_samples=32,glossy_samples=16,weights=$weights,density=same,edges=0,short_rays=0" \
    || fail "wall: $weights"
done
off=$(figure relative_rmse wall-osw.exr wall-oswa.exr)
awk -v off="$off" 'BEGIN { exit !(off < 1e-5) }' || fail "diffuse places among glossy ones: off by $off"

# Lights that gather rays meet are weighed against their own sampling: the mean stays that of plain weights.
for weights in ratio oswa mis; do
  "$aureole" render "$box" -q --width 32 --height 32 --spp "$(either 1 64)" -o mean-$weights.exr --integrator \
    "finalgather-lab:photons=50000,diffuse_samples=128,glossy_samples=64,weights=$weights,max_depth=2" || fail "mean: $weights"
done
for weights in oswa mis; do
  judge -v a="$(mean mean-ratio.exr mean-ratio.exr)" -v b="$(mean mean-ratio.exr mean-$weights.exr)" \
    'BEGIN { d = a / b - 1; exit !(d < 0.005 && d > -0.005) }' || fail "$weights: the mean of direct light has moved"
done

refused() { # PATTERN KEYS
  "$aureole" render "$scene" -q --spp 1 -o refused.exr --integrator "finalgather-lab:$2" 2>message
  [ $? -eq 2 ] || fail "$2: not refused"
  grep -q -- "$1" message || fail "$2: $(cat message)"
}
refused "rotations" weights=oswa,rotations=0
refused "rotations" weights=osw,pattern=sobol,rotations=0
refused "density=same" weights=equal,density=optimal
refused "weights" weights=best
refused "regularization" weights=oswa,regularization=-1
exit $((failures > 0))

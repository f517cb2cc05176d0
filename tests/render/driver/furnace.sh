#!/usr/bin/env bash
# White furnaces (furnace.xml and sky.xml have the closed forms): 8 independent seeds each. The mean over the seeds must be within t
# standard errors of the exact radiance, t = 7.89 the quantile of Student's t with 7 degrees of freedom for a chance of
# 1e-4, plus the bias that is stated for the photon map.
. "$(dirname "$0")/common.sh.inc"

# check NAME EXACT BIAS ARGUMENTS...
check() {
  local name=$1 exact=$2 bias=$3 means=
  shift 3
  for seed in $(either 1 "1 2 3 4 5 6 7 8"); do
    "$aureole" render "$source/tests/render/driver/$scene.xml" -q --seed $seed -o $name-$seed.pfm "$@" ||
      { fail "$name: render"; return; }
    means="$means $(mean $name-$seed.pfm $name-$seed.pfm)"
  done
  echo "$means" | judge -v name="$name" -v exact="$exact" -v bias="$bias" '
    { for (i = 1; i <= NF; ++i) { sum += $i; squares += $i * $i }
      mean = sum / NF; variance = (squares - NF * mean * mean) / (NF - 1); if (variance < 0) variance = 0
      error = sqrt(variance / NF); off = mean - exact; allowed = 7.89 * error + bias * exact + 1e-6
      printf "%s: %.6f +- %.6f, exact %g, off %+.6f, allowed %.6f\n", name, mean, error, exact, off, allowed
      exit !(off <= allowed && off >= -allowed && NF == 8) }' || fail "$name"
}

scene=furnace
check path 1 0
check path-interleaved 1 0 --integrator path:interleaved=true
check path-single 1 0 --integrator path:packets=false
check path-random 1 0 --sampler random
check path-bright 5 0 -D albedo=0.9
# L = E + a E where only two edges are allowed, and the same by gathering from the lights alone: exact but for rounding.
check path-two 0.75 0 --integrator path:max_depth=2
check gather-two 0.75 0 --integrator finalgather-lab:direct=gather,incident=emitters,density=same --spp 4
# Patterns that are only turned have an error of quadrature that turning does not average out: 0.2 %.
check gather-adaptive-two 0.75 0 --spp 4 \
  --integrator finalgather-lab:direct=gather,incident=emitters,density=same,adaptive=true,diffuse_samples=8
check gather 1 0.002 --integrator finalgather:photons=50000,diffuse_samples=64 --spp 4
check gather-bright 5 0.004 -D albedo=0.9 --integrator finalgather:photons=50000 --spp 4
check gather-sobol 1 0.002 --integrator finalgather:photons=50000,pattern=sobol --spp 4
scene=sky
check sky-path 0.8 0
check sky-interleaved 0.8 0 --integrator path:interleaved=true
check sky-gather 0.8 0.002 --integrator finalgather:photons=20000
check sky-gather-all 0.8 0 --integrator finalgather-lab:direct=gather,incident=emitters,density=same --spp 4
exit $((failures > 0))

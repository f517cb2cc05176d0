#!/usr/bin/env bash
# Furnaces with a closed form (furnace_faces.xml, furnace.xml): every material with every integrator and every sampler with
# both, as far as the three can meet; with a third argument `full` every combination of all three, and more samplers.
#
# Every pixel has the same exact radiance and randomisations of its own, so the 256 pixels of one picture are independent
# estimates: t of their mean must stay below 4.5, the quantile at 1 - (1 - 0.001)^(1/90) for the 88 cases of the pairwise
# cover, so a program that is right fails once in 1000 (5.5 in the full product: once in 10,000 for 3000 cases). Beside it
# a part in a million for rounding, and the bias that is stated: what single scattering on rough facets loses, and the
# patterns of final gathering, which are turned but not moved.
. "$(dirname "$0")/common.sh.inc"
full=${3:-}
quantile=4.5
samplers=(random sobol halton larcher-pillichshammer fibonacci-lattice r2)
if [ -n "$full" ]; then
  quantile=5.5
  samplers+=(lcg icg jittered hammersley faure niederreiter rank1 golden-set)
fi
integrators=(path finalgather:direct=gather,incident=emitters aov:aovs=v:variance direct ao:samples=16
  finalgather:direct=gather,incident=emitters,pattern=sobol,rotations=0)

# constant OCTAL-BYTES FILE: a picture whose every value is a float given by its bytes.
constant() {
  { printf 'PF\n16 16\n-1.0\n'; for _ in {1..256}; do printf "$1$1$1"; done; } >"$2"
}
constant '\0\0\200\077' 1.pfm
constant '\0\0\0\077' 0.5.pfm
constant '\0\0\100\077' 0.75.pfm
constant '\0\0\240\100' 5.pfm

# check SCENE EXACT BIAS SAMPLER INTEGRATOR [OPTIONS...]
cases=0
check() {
  local scene=$1 exact=$2 bias=$3 sampler=$4 integrator=$5
  shift 5
  cases=$((cases + 1))
  "$aureole" render "$source/tests/render/$scene.xml" -q --sampler $sampler --integrator "$integrator" --width 16 --height 16 \
    --seed $cases -o case.pfm "$@" || { fail "$scene $* $sampler $integrator"; return; }
  "$aureole" compare $exact.pfm case.pfm --metric mse --format csv --tolerance inf |
    awk -F, -v name="$scene $* $sampler $integrator" -v exact="$exact" -v bias="$bias" -v t=$quantile '
      NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
      NR == 2 { mean = $column["mean_r"]; off = mean - exact; variance = $column["mse"] - off * off
        if (variance < 0) variance = 0
        allowed = t * sqrt(variance / 255) + (bias + 1e-6) * exact
        if (off <= allowed && off >= -allowed) { good = 1; exit }
        printf "%s: %.6f, not %g: off %+.6f, allowed %.6f\n", name, mean, exact, off, allowed }
      END { exit !good }' || fail "case $cases"
}

# Whether an integrator sees all of a material's light: direct stops at the first surface, and final gathering from the lights
# alone at the second, of which there are more behind a veil.
meets() { # MATERIAL INTEGRATOR
  case $2:$1 in direct:glass | direct:pane | direct:frosted | direct:veil | finalgather*:veil) return 1 ;; esac
}

row=0
for material in white gray both mirror satin phong lobe plastic eggshell glass pane frosted veil; do
  exact=1 bias=0
  case $material in gray) exact=0.5 ;; satin | eggshell | frosted) bias=0.01 ;; esac
  for s in "${!samplers[@]}"; do
    chosen=$(((row + s) % ${#integrators[@]}))
    for i in "${!integrators[@]}"; do
      integrator=${integrators[$i]}
      [ -n "$full" ] || [ $i -eq $chosen ] || continue
      meets $material "$integrator" || continue
      # Ambient occlusion sees no material.
      case $integrator in ao:*) check furnace_faces 1 0 "${samplers[$s]}" "$integrator" -D material=$material ;;
      finalgather*) check furnace_faces $exact $(awk -v b=$bias 'BEGIN { print b + 0.002 }') "${samplers[$s]}" "$integrator" -D material=$material ;;
      *) check furnace_faces $exact $bias "${samplers[$s]}" "$integrator" -D material=$material ;; esac
    done
  done
  row=$((row + 1))
done
# The closed box, 0.5 / (1 - albedo), with every sampler.
for s in "${!samplers[@]}"; do
  check furnace 1 0 "${samplers[$s]}" path --spp 4
  check furnace 5 0 "${samplers[$s]}" aov:aovs=v:variance --spp 4 -D albedo=0.9
  check furnace 0.75 0 "${samplers[$s]}" direct --spp 4
done
echo "$cases cases, $failures failed"
exit $((failures > 0))

#!/usr/bin/env bash
# Furnaces with a closed form (furnace_faces.xml, furnace.xml): every material with every integrator and every sampler with
# both, as far as the three can meet; with a third argument `full` every combination of all three, and more samplers.
#
# Every pixel has the same exact radiance and randomisations of its own, so the 256 pixels of one image are independent
# estimates: t of their mean must stay below 4.6, the quantile at 1 - (1 - 0.001)^(1/181) for the 181 cases of the pairwise
# cover, so a program that is right fails once in 1000 (5.5 in the full product: once in 10,000 for 3000 cases). Beside it
# a part in a million for rounding, and the bias that is stated: what single scattering on rough facets loses, and the
# patterns of final gathering, which are turned but not moved.
. "$(dirname "$0")/common.sh.inc"
full=${3:-}
quantile=4.6
samplers=(random sobol halton larcher-pillichshammer fibonacci-lattice r2)
if [ -n "$full" ]; then
  quantile=5.5
  samplers+=(lcg icg jittered hammersley faure niederreiter rank1 golden-set)
fi
integrators=(path finalgather-lab:direct=gather,incident=emitters aov:aovs=v:variance direct ao:samples=16
  finalgather-lab:direct=gather,incident=emitters,pattern=sobol,rotations=0)

{ printf 'PF\n16 16\n-1.0\n'; for _ in {1..256}; do printf '\0\0\200\077\0\0\200\077\0\0\200\077'; done; } >one.pfm

# check SCENE EXACT BIAS SAMPLER INTEGRATOR [OPTIONS...]
cases=0
check() {
  local scene=$1 exact=$2 bias=$3 sampler=$4 integrator=$5
  shift 5
  cases=$((cases + 1))
  "$aureole" render "$source/tests/render/driver/$scene.xml" -q --sampler $sampler --integrator "$integrator" --width 16 --height 16 \
    --seed $cases -o case.pfm "$@" || { fail "$scene $* $sampler $integrator"; return; }
  "$aureole" compare one.pfm case.pfm --metric mse --format csv --tolerance inf |
    awk -F, -v name="$scene $* $sampler $integrator" -v exact="$exact" -v bias="$bias" -v t=$quantile '
      NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
      NR == 2 { mean = $column["mean_r"]; off = mean - exact; variance = $column["mse"] - (mean - 1) ^ 2
        if (variance < 0) variance = 0
        allowed = t * sqrt(variance / 255) + (bias + 1e-6) * exact
        if (off <= allowed && off >= -allowed) { good = 1; exit }
        printf "%s: %.6f, not %g: off %+.6f, allowed %.6f\n", name, mean, exact, off, allowed }
      END { exit !good }' || fail "case $cases"
}

# Whether an integrator sees all of a material's light: direct stops at the first surface, and final gathering from the lights
# alone at the second, of which there are more behind a veil.
meets() { # MATERIAL INTEGRATOR
  case $2:$1 in
  direct:glass | direct:pane | direct:sheet | direct:frosted | direct:vellum | direct:crystal | direct:foil | direct:parchment) return 1 ;;
  direct:veil | direct:nothing | direct:polarizer | direct:retarder | direct:circular | finalgather*:veil | finalgather*:vellum) return 1 ;;
  esac
}

# Every material of the table stands in the scenes.
scenes=("$source/tests/render/driver/"furnace_{faces,coats}.xml)
"$aureole" help bsdf --format csv >materials.csv || fail "the list of materials"
for material in $(sed '1d; s/,.*//' materials.csv); do
  grep -q "<bsdf type=\"$material\"" "${scenes[@]}" || fail "furnace_faces.xml has no $material"
done
# And every one of the scenes is checked here.
materials=$(sed -n 's/^ *<bsdf type="[a-z_]*" id="\([a-z]*\)".*/\1/p' "${scenes[@]}")

# What "lacquer" and "glaze" show, by midpoints: F of an index of 1.5 (Fresnel 1823). Under a glaze the base sends 1 / 1.5^2 of its light
# out at once, and the rest is left out.
read -r lacquer glaze < <(awk 'function f(c,   d, p, s) { d = sqrt(1 - (1 - c * c) / 2.25); s = (c - 1.5 * d) / (c + 1.5 * d)
    p = (d - 1.5 * c) / (d + 1.5 * c); return (s * s + p * p) / 2 }
  BEGIN { for (i = 0; i < 1000; ++i) { c = (i + 0.5) / 1000; mean += 2 * c * f(c) / 1000 }
    through = (1 - f(1)) * (1 - mean); print f(1) + through, f(1) + through / 2.25 }')

row=0
for material in $materials; do
  exact=1 bias=0 scene=furnace_faces
  case $material in
  gray) exact=0.5 ;;
  polarizer | circular) exact=0.25 ;;
  tilted) exact=0.9 ;;
  raised) exact=$(awk 'BEGIN { print (1 + 2 / sqrt(5)) / 2 }') ;;
  # Oren and Nayar's facets seen straight on are the same from all sides: C1 + C4 of equations 27 to 29 for a variance of .5.
  clay) exact=$(awk 'BEGIN { print 1 - 0.25 / 0.83 + 0.17 * 0.5 / 0.63 }') ;;
  lacquer) exact=$lacquer bias=0.01 ;;
  # Ward's lobe of alpha a seen straight on mirrors 1 - a^2 (1 - exp(-1 / a^2)) of its reflectance.
  enamel) exact=$(awk 'BEGIN { a = 0.25; print 0.4 + 0.6 * (1 - a * (1 - exp(-1 / a))) }') ;;
  glaze) exact=$glaze ;;
  wax) exact=$glaze bias=0.01 scene=furnace_coats ;;
  eggshell) bias=0.01 scene=furnace_coats ;;
  satin | frosted | metal | crystal | foil) bias=0.01 ;;
  esac
  for s in "${!samplers[@]}"; do
    chosen=$(((row + s) % ${#integrators[@]}))
    for i in "${!integrators[@]}"; do
      integrator=${integrators[$i]}
      [ -n "$full" ] || [ $i -eq $chosen ] || continue
      meets $material "$integrator" || continue
      # Ambient occlusion sees no material.
      case $integrator in
      ao:*) check $scene 1 0 "${samplers[$s]}" "$integrator" -D material=$material ;;
      finalgather*) check $scene $exact $(awk -v b=$bias 'BEGIN { print b + 0.002 }') "${samplers[$s]}" "$integrator" -D material=$material ;;
      *) check $scene $exact $bias "${samplers[$s]}" "$integrator" -D material=$material ;;
      esac
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

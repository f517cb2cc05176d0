# The experiments on weights reproduce their figures (200 scramblings; four standard errors).
weights=$results/marques-2018
# FIGURE MEAN TOLERANCE, of Sobol.
while IFS=';' read -r figure mean tolerance; do
  awk -F, -v f="$figure" -v m="$mean" -v t="$tolerance" '
    $1 == "sobol" && $2 == f { d = $4 - m; found = 1; if (d > t || d < -t) { print f ": " $4 ", not " m; bad = 1 } }
    END { exit bad || !found }' "$weights-gains/marques-2018-gains.csv" || fail "gains"
done <<'FIGURES'
OSW diffuse;5.6;0.3
OSW glossy;7.3;0.6
OSWA against OSW;16.8;0.3
OSWA against QMC;22.2;0.4
FIGURES
# Random samples gain a rate, Sobol a constant.
grep "^# random" "$weights-slopes/marques-2018-slopes.csv" | awk '{ if ($7 > -0.45 || $7 < -0.55 || $11 > -0.70 || $11 < -0.79) exit 1 }' || fail "slopes"
# The published regularisation is worse than equal weights at m = 200.
awk -F, '$2 == 200 && $5 == 0.5 { n++; if ($6 > 0) exit 1 } END { exit n != 2 }' \
  "$weights-sensitivity/marques-2018-sensitivity.csv" || fail "sensitivity"
# GGX lobes: optimal weights have the least worst-case error, those of a coarse table little more.
awk -F, '$2 == "smooth" && $8 != "nan" { worst[$4 "/" $5] = $8; rows++ }
  END { for (view in worst) { split(view, at, "/"); least = worst[at[1] "/optimal"]
          if (!(worst[view] >= 0.9999 * least)) bad = 1
          if (at[2] == "table" && !(worst[view] < 1.1 * least)) bad = 1 }
        exit bad || rows < 10 }' "$weights-ggx/marques-2018-ggx.csv" || fail "GGX lobes"
awk -F, '$1 == "indirect" { rows++; if (!($4 > 0 && $6 <= $5 && $5 <= $7 && $8 < 5 && $8 > -5)) bad = 1 }
  END { exit bad || rows != 2 }' "$weights-metal/marques-2018-metal.csv" || fail "rough metals"
# Weights in pictures, few pixels and scramblings: every row is there, and weights help random samples.
awk -F, '$1 == "Cornell box" && $2 == "random" { rows++; if (!($5 > 0)) bad = 1; rmse[$4] = $5 }
  END { exit bad || rows != 6 || !(rmse["OSWA"] < rmse["equal"] && rmse["OSW"] < rmse["equal"]) }' \
  "$weights-table1/marques-2018-table1.csv" || fail "weights in pictures"

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
# Weights in images, few pixels and scramblings: every row is there, and weights help random samples.
awk -F, '$1 == "Cornell box" && $2 == "random" { rows++; if (!($5 > 0)) bad = 1; rmse[$4] = $5 }
  END { exit bad || rows != 6 || !(rmse["OSWA"] < rmse["equal"] && rmse["OSW"] < rmse["equal"]) }' \
  "$weights-table1/marques-2018-table1.csv" || fail "weights in images"
# Figures 2 to 5: errors are below their bounds, and what the paper says of five samples holds.
awk -F, '!/^#/ && NR > 1 { rows++; if (!($3 <= $4 && $5 <= $6 && $6 < $4)) bad = 1 } END { exit bad || rows != 12 }' \
  "$weights-functions/marques-2018-functions.csv" || fail "functions of norm 1"
awk -F, '/^# .*fig\. 3/ { said++; if (/does not hold/) bad = 1 }
  $1 == "3a: p = 1" { five++; if ($8 < 0.999999 || $8 > 1.000001) bad = 1 }
  $1 ~ /^4a/ { if ($2 != "below .8" && $8 < 0.8) bad = 1; diffuse++ } $1 ~ /^5b/ { all++ }
  END { exit bad || said != 4 || five != 5 || diffuse != 128 || all != 192 }' \
  "$weights-weights/marques-2018-weights.csv" || fail "weights of samples"
# One light for both lobes gives the sum of two errors less to gain.
awk -F, '$1 == "sobol" { gain[$2] = $4 } END { exit !(gain["OSWA against OSW by ||h_d + h_g||"] > 0 && gain["OSWA against OSW by ||h_d + h_g||"] < 0.5 * gain["OSWA against OSW"]) }' \
  "$weights-gains/marques-2018-gains.csv" || fail "the error of the sum"
# The constraint of the sum costs little, the optimal density gains more than weights, clipping most at grazing views, and
# finer tables lose less.
awk -F, '!/^#/ && NR > 1 { over[$4 " " $3] = $6 }
  END { exit !(over["1 optimal weights of free sum"] < over["1 optimal weights of sum 1"] && over["1 optimal weights of sum 1"] - over["1 optimal weights of free sum"] < 0.3 &&
               over["20 optimal density and p/q"] < over["20 optimal weights of free sum"] && over["20 75 degrees: clipped"] < -5 &&
               over["20 45 degrees: clipped"] > -0.1 && over["20 128 angles"] < 0.1 * over["20 32 angles"] &&
               over["20 32 angles"] < 0.1 && over["20 32 angles clipped"] < 0.1) }' \
  "$weights-beyond/marques-2018-beyond.csv" || fail "beyond the paper"
# Images against N: every method falls, and optimal weights leave less of Sobol samples' error.
for figure in 7:9 8:2; do
  awk -F, -v want="${figure#*:}" 'NR > 1 && !/^#/ { rmse[$1 $2 "," $3] = $4; if ($3 > most) most = $3; name[$1 $2]
                       if (!($5 <= $4 && $4 <= $6)) bad = 1 }
    END { for (n in name) { ++count; if (!(rmse[n "," most] < rmse[n ",24"])) bad = 1 } exit bad || count != want }' \
    "$weights-fig${figure%:*}/marques-2018-fig${figure%:*}-rmse.csv" || fail "figure ${figure%:*}"
done
# Regression has no error where its basis holds the light; and what solves a system is below MIS under smooth light.
awk -F, '/^# claim: .*regression.*: holds$/ { exact++ } $2 == "smooth" { rmse[$1 $3 $4] = $(NF - 1); if ($4 == "MIS balance") keys[$1 $3] }
  END { for (k in keys) { ++views; if (!(rmse[k "optimal MIS"] < rmse[k "MIS balance"] && rmse[k "regression of degree 2"] < rmse[k "MIS balance"])) bad = 1 }
        exit bad || exact != 2 || views != 4 }' "$weights-rivals/marques-2018-rivals.csv" || fail "control variates"
# A box of the paper's lobes that are not given: six rows, each with the interval of one set about its mean.
awk -F, '!/^#/ && NR > 1 { ++rows; if (!($8 <= $5 * 1.001 && $9 >= $5 * 0.8 && $10 > 1)) bad = 1 } END { exit bad || rows != 6 }' \
  "$weights-box/marques-2018-box.csv" || fail "the box of any lobes"
# Points that move with their weights are below the best weights of given points, and below points that move for equal weights.
awk -F, '!/^#/ && NR > 1 { ++rows; over[$3] = $5 }
  END { exit !(rows == 6 && over["points and weights"] < 0.99 * over["optimal density and weights"] &&
               over["points and weights"] < over["points for equal weights"] && over["optimal density and weights"] < over["optimal weights"]) }' \
  "$weights-joint/marques-2018-joint.csv" || fail "points and weights together"
# Merged weights of three lobes, GGX among them, and of levels of one grid leave less than half of p/q's error under smooth light.
awk -F, '!/^#/ && NR > 1 { ++rows; if ($4 == "p/q" && $6 != 1) bad = 1; if ($3 == "smooth" && $4 == "OSWA") { ++merged; if (!($6 < 0.5)) bad = 1 } }
  END { exit !(rows == 32 && merged == 4 && !bad) }' "$weights-lobes/marques-2018-lobes.csv" || fail "merged lobes"
# In images too, for two glossy lobes over a diffuse one: merged weights below every other kind.
awk -F, '!/^#/ && NR > 1 { ++rows; if ($4 == "OSWA") merged[$3] = $5; else if (!($3 in others) || $5 < others[$3]) others[$3] = $5 }
  END { for (light in merged) if (!(merged[light] < others[light])) bad = 1; exit !(rows == 8 && !bad) }' \
  "$weights-coats/marques-2018-coats.csv" || fail "merged lobes in images"
# Smooth light has a larger s than light with edges, and gains from it; no s is below the best one.
awk -F, '!/^#/ && NR > 1 { ++rows; over[$2 $3 $4] = $6; if ($4 == "s learned") s[$2 $3] = $9; sets[$2] }
  END { for (k in sets) if (!(s[k "smooth"] > s[k "hard edges"] && over[k "smooths learned"] < 0.9 && over[k "smoothbest s of each light"] <= over[k "smooths learned"])) bad = 1
        exit bad || rows != 16 }' "$weights-learned/marques-2018-learned.csv" || fail "s learned"

# Extensible spherical Fibonacci grids: figures that are known from elsewhere.
grids=$results/marques-2019
# The paper's grid of 64 points with three extensions (tests/points/sphere/test_grid.c has the same figures).
awk -F, '/first-shift=paper/ { scd = $(NF - 2); n = $(NF - 3)
           if (n == 64 && (scd / 2.99270e-2 - 1) ^ 2 < 1e-10) ++good
           if (n == 128 && (scd / 1.83645e-2 - 1) ^ 2 < 1e-10) ++good
           if (n == 256 && (scd / 1.07787e-2 - 1) ^ 2 < 1e-10) ++good }
         END { exit good != 3 }' "$grids-discrepancy/marques-2019-discrepancy.csv" || fail "the discrepancy of E-SFG"
[ "$(grep -c '^# claim: .*: holds' "$grids-discrepancy/marques-2019-discrepancy.csv")" -eq 10 ] || fail "claims on E-SFG's discrepancy"
# The best of three shifts is never worse than the paper's, and each size centred by itself is spherical Fibonacci's but for 1 %.
awk -F, '/^#/ || $1 == "step" { next }
         { ++rows; if ($5 > $4 + 1e-9 && $1 == "x2" && $3 == 2 * $2) bad = 1; if ($1 == "x4" && !($6 < 1 && $6 > -1)) bad = 1 }
         END { exit bad || rows != 10 }' "$grids-shifts/marques-2019-shifts.csv" || fail "E-SFG's shifts"
# Identities hold; what the paper has too narrow does not, at the sizes that are known.
awk -F, '/^#/ || $1 == "item" { next } { ++rows; if ($(NF - 1) != 0) wrong = wrong $1 ";" }
         END { exit rows != 22 || wrong != "eq. 23;eq. 24;eq. 40;" }' "$grids-lattice/marques-2019-lattice.csv" || fail "statements on the lattice"
grep -q '^# eq. 23 is not the shortest at N = 5 34 233 1597 10946$' "$grids-lattice/marques-2019-lattice.csv" || fail "the errata of eq. 23"
awk -F, '/^#/ || $1 == "figure" { next } { ++rows; if ($1 == "1c" && $(NF - 5) != 256) bad = 1 } END { exit bad || rows != 5 }' \
  "$grids-grids/marques-2019-grids.csv" || fail "grids that keep their points"
[ -s "$grids-grids/marques-2019-grids-sphere-E-SFG,_256_points.png" ] || fail "no image of a grid"
# Three sizes, two lobes and five sets, and the image of both lobes; the error of Faure's sequence in base 3 is above
# spherical Fibonacci's over all sizes of the diffuse lobe, by two thirds in full; base 2 has the published row.
awk -F, '/^#/ || $1 == "figure" { next }
         { ++rows; n = NF - 8; if (!($(n + 1) <= $n && $n <= $(n + 2) && $n > 0)) bad = 1
           if ($1 == 11 && $2 == "diffuse" && /faure:base=3/) sum += log($(n + 3)) }
         END { exit bad || rows != 35 || !(sum > 0) }' "$grids-statue/marques-2019-statue.csv" || fail "the figure of 2019"
# Shares of the levels add up, and doubling in place of fewer levels is left to the full form.
awk -F, '/^#/ || $1 == "lobe" { next } /share/ { sum[$1 $2] += $4; ++rows }
         END { for (way in sum) if ((sum[way] - 1) ^ 2 > 1e-20) bad = 1; exit bad || rows != 24 }' \
  "$grids-adaptive/marques-2019-adaptive.csv" || fail "shares of the levels"
awk -F, 'NR > 1 { ++rows; if (!($12 <= $11 && $11 <= $13 && $7 > 20 && $14 < 1 && $15 > 0)) bad = 1; nets += $2 == "sobol" } END { exit bad || rows != 10 || nets != 2 }' \
  "$grids-adaptive/marques-2019-adaptive-ways.csv" || fail "ways of adaptive gathering"

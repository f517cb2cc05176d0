# Extensible spherical Fibonacci grids: figures that are known from elsewhere.
grids=$results/marques-2019
# The paper's grid of 64 points with three extensions (tests/sphere/test_grid.c has the same figures).
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
[ -s "$grids-grids/marques-2019-grids-sphere-E-SFG,_256_points.png" ] || fail "no picture of a grid"

# Weights for any points: what docs/choosing.md says holds by a wide margin, and intervals hold about as often as they say.
awk -F, '!/^#/ && NR > 1 { ++rows
    if ($2 == 256 && $3 == "smooth" && !($7 < $4 / 10 && $5 < $4 / 5 && $6 < $4)) bad = 1
    if ($2 == 256 && $3 == "smooth" && $1 != "random" && !($9 < $5 / 2 && $10 < $9 / 2)) bad = 1
    if ($3 == "discontinuous" && $1 != "random" && !($5 < 1.2 * $4 && $5 > 0.8 * $4)) bad = 1 }
  END { exit bad || rows != 24 }' "$results/weights-choosing/weights-choosing.csv" ||
  fail "choosing weights"
# 20 runs of .95: fewer than 14 come once in 10^5 rows. A sun that is not declared, over a sky that varies, is seen by the default
# resolution only (column 5: 0; 2 runs).
awk -F, '!/^#/ && NR > 1 { ++rows; seen = $2 != "sun over a cosine sky" || $5 == 0
    if ($10 != 0 || (seen && ($9 != 0 || ($3 == "finite" && $6 > 2 && $7 < 0.65)))) { bad = 1; print } } END { exit bad || rows < 100 }' \
  "$results/integrate-coverage/integrate-coverage.csv" || fail "intervals of integrals"

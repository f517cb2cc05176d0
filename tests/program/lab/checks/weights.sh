# Weights for any points: what docs/choosing.md says holds by a wide margin, and intervals hold about as often as they say
# (50 runs of .95: fewer than 40 come once in 10^4 rows).
awk -F, '!/^#/ && NR > 1 { ++rows
    if ($2 == 256 && $3 == "smooth" && !($7 < $4 / 10 && $5 < $4 / 5 && $6 < $4)) bad = 1
    if ($2 == 256 && $3 == "smooth" && $1 != "random" && !($9 < $5 / 2 && $10 < $9 / 2)) bad = 1
    if ($3 == "discontinuous" && $1 != "random" && !($5 < 1.2 * $4 && $5 > 0.8 * $4)) bad = 1 }
  END { exit bad || rows != 24 }' "$results/weights-choosing/weights-choosing.csv" ||
  fail "choosing weights"
awk -F, '!/^#/ && NR > 1 { ++rows; if (!($5 >= 0.8 && $7 >= $5 && $9 < 1)) bad = 1 } END { exit bad || rows != 8 }' \
  "$results/integrate-coverage/integrate-coverage.csv" || fail "intervals of integrals"
